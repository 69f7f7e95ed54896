//! A child's height and body mass index beside the WHO's growth reference of 2007, 5 to 19 years. No diagnosis.
//!
//! de Onis M, Onyango AW, Borghi E, Siyam A, Nishida C, Siekmann J: Development of a WHO growth reference for school-aged
//! children and adolescents. Bull World Health Organ 2007;85:660-667. `models/tables/who2007.csv` holds it.

use shape::{Girths, Growth, Score, Sex};
use std::f64::consts::FRAC_1_SQRT_2;

const TABLE: &str = include_str!("../../../models/tables/who2007.csv");

/// Ages that the reference is of (of the table, models/tables/who2007.csv). \[months\]
const AGES: std::ops::RangeInclusive<f64> = 61.0..=228.0;

/// The distribution of a number at an age: Box–Cox power, median, coefficient of variation.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Lms {
    l: f64,
    m: f64,
    s: f64,
}

impl Lms {
    /// The number that is `z` standard deviations from the median.
    fn at(self, z: f64) -> f64 {
        self.m * libm::pow(1.0 + self.l * self.s * z, 1.0 / self.l)
    }

    /// Standard deviations from the median.
    fn z(self, x: f64) -> f64 {
        (libm::pow(x / self.m, self.l) - 1.0) / (self.l * self.s)
    }

    /// As [`z`](Lms::z); beyond three standard deviations in steps as long as that from the second to the third, as the WHO counts
    /// where a distribution is skewed.
    fn z_of_skewed(self, x: f64) -> f64 {
        let z = self.z(x);
        if z.abs() <= 3.0 {
            return z;
        }
        let side = z.signum();
        let (two, three) = (self.at(2.0 * side), self.at(3.0 * side));
        side * (3.0 + (x - three) / (three - two))
    }

    fn towards(self, next: Lms, share: f64) -> Lms {
        let between = |a: f64, b: f64| a + share * (b - a);
        Lms {
            l: between(self.l, next.l),
            m: between(self.m, next.m),
            s: between(self.s, next.s),
        }
    }
}

/// A month's lines of the table: body mass index \[kg/m²\], height \[cm\].
fn month(sex: Sex, month: u32) -> [Lms; 2] {
    let word = match sex {
        Sex::Female => "female",
        Sex::Male => "male",
    };
    let begin = format!("{word},{month},");
    let line = TABLE.lines().find_map(|line| line.strip_prefix(&begin));
    let line = line.expect("bug: a month that the table of growth has not");
    let numbers: Vec<f64> = line.split(',').filter_map(|x| x.parse().ok()).collect();
    let [l, m, s, height, spread] = numbers[..] else {
        panic!("bug: a line of the table of growth: {line}");
    };
    let height = Lms {
        l: 1.0,
        m: height,
        s: spread,
    };
    [Lms { l, m, s }, height]
}

/// The distributions at an age, straight between months; `None` outside of the reference. Body mass index, height.
fn reference(sex: Sex, months: f64) -> Option<[Lms; 2]> {
    if !AGES.contains(&months) {
        return None;
    }
    let (whole, share) = (months.floor(), months.fract());
    let here = month(sex, whole as u32);
    if share == 0.0 {
        return Some(here);
    }
    let next = month(sex, whole as u32 + 1);
    Some([0, 1].map(|i| here[i].towards(next[i], share)))
}

/// With how many of a hundred below, by the normal distribution.
fn score(z: f64) -> Score {
    Score {
        z,
        centile: 50.0 * libm::erfc(-z * FRAC_1_SQRT_2),
    }
}

/// Where stature and body mass index are, where sex, age, and the stature that was given show. The body mass index is given
/// where the weight was given, too.
pub(crate) fn growth(girths: &Girths, stature_mm: Option<f64>) -> Option<Growth> {
    let (sex, months, mm) = (girths.sex?, girths.age_months?, stature_mm?);
    let [bmi, height] = reference(sex, months)?;
    Some(Growth {
        bmi: girths.bmi.map(|x| score(bmi.z_of_skewed(x))),
        height: Some(score(height.z(mm / 10.0))),
    })
}

#[cfg(test)]
#[path = "growth_tests.rs"]
mod tests;
