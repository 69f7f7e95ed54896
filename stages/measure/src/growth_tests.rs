//! The reference is whole and smooth, and gives the WHO's own numbers.

use super::*;
use proof::near;

/// All months of a sex.
fn months(sex: Sex) -> Vec<[Lms; 2]> {
    (60..=228).map(|m| month(sex, m)).collect()
}

#[test]
fn the_table_has_every_month_once_and_no_slip_of_a_digit() {
    let lines = TABLE.lines().filter(|l| l.contains("male,")).count();
    assert_eq!(lines, 2 * 169);
    // What is rounded to `unit` and smooth has third differences of a few units; a wrong digit before the last has tens.
    let smooth = |values: Vec<f64>, unit: f64, most: f64| {
        let mut d = values;
        for _ in 0..3 {
            d = d.windows(2).map(|w| w[1] - w[0]).collect();
        }
        let worst = d.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
        assert!(worst < (most + 0.5) * unit, "{worst} of {unit}");
    };
    for sex in [Sex::Female, Sex::Male] {
        let all = months(sex);
        smooth(all.iter().map(|[b, _]| b.l).collect(), 1e-4, 3.0);
        smooth(all.iter().map(|[b, _]| b.m).collect(), 1e-4, 4.0);
        smooth(all.iter().map(|[b, _]| b.s).collect(), 1e-5, 3.0);
        smooth(all.iter().map(|[_, h]| h.m).collect(), 1e-4, 14.0);
        smooth(all.iter().map(|[_, h]| h.s).collect(), 1e-5, 3.0);
    }
}

#[test]
fn standard_deviations_are_those_that_the_who_prints() {
    // WHO, "BMI-for-age 5 to 19 years (z-scores)" and "Height-for-age 5 to 19 years (z-scores)", at 10 years: -3 to 3 SD.
    let printed = [
        (
            Sex::Male,
            [12.8, 13.7, 14.9, 16.4, 18.5, 21.4, 26.1],
            [118.7, 125.0, 131.4, 137.8, 144.2, 150.5, 156.9],
        ),
        (
            Sex::Female,
            [12.4, 13.5, 14.8, 16.6, 19.0, 22.6, 28.4],
            [119.4, 125.8, 132.2, 138.6, 145.0, 151.4, 157.8],
        ),
    ];
    for (sex, bmi, height) in printed {
        let [b, h] = reference(sex, 120.0).unwrap();
        for (i, z) in (-3..=3).enumerate() {
            near(b.at(f64::from(z)), bmi[i], 0.051);
            near(h.at(f64::from(z)), height[i], 0.051);
        }
    }
}

#[test]
fn beyond_three_standard_deviations_steps_stay_as_long() {
    let [b, _] = reference(Sex::Male, 120.0).unwrap();
    near(b.z_of_skewed(b.at(1.5)), 1.5, 1e-9);
    let (two, three) = (b.at(2.0), b.at(3.0));
    near(b.z_of_skewed(three + 0.5 * (three - two)), 3.5, 1e-9);
    let (two, three) = (b.at(-2.0), b.at(-3.0));
    near(b.z_of_skewed(three - 0.25 * (two - three)), -3.25, 1e-9);
}

#[test]
fn an_age_between_months_is_between_and_one_outside_is_not_given() {
    let [a, b, c] = [100.0, 100.5, 101.0].map(|m| reference(Sex::Female, m).unwrap()[1].m);
    near(b, (a + c) / 2.0, 1e-9);
    for none in [60.9, 228.1, -1.0, f64::NAN] {
        assert_eq!(reference(Sex::Female, none), None, "{none}");
    }
    assert!(reference(Sex::Male, 228.0).is_some() && reference(Sex::Male, 61.0).is_some());
}

#[test]
fn only_a_child_with_stature_and_sex_has_growth() {
    let child = Girths {
        sex: Some(Sex::Male),
        age_months: Some(120.0),
        bmi: Some(16.4433),
        ..Girths::default()
    };
    let reported = growth(&child, Some(1377.795)).unwrap();
    for score in [reported.bmi.unwrap(), reported.height.unwrap()] {
        near(score.z, 0.0, 1e-9);
        near(score.centile, 50.0, 1e-6);
    }
    near(
        growth(&child, Some(1377.795 * (1.0 + 0.04626 * 1.96)))
            .unwrap()
            .height
            .unwrap()
            .centile,
        97.5,
        0.01,
    );
    assert_eq!(growth(&child, None), None);
    let light = Girths {
        bmi: None,
        ..child.clone()
    };
    assert_eq!(growth(&light, Some(1400.0)).unwrap().bmi, None);
    let adult = Girths {
        age_months: Some(300.0),
        ..child.clone()
    };
    assert_eq!(growth(&adult, Some(1780.0)), None);
    let unknown = Girths { sex: None, ..child };
    assert_eq!(growth(&unknown, Some(1400.0)), None);
}
