//! Whether a body is whole or cut off below, by the heights of its buttocks and neck: the odds of both, of the model's populations.

use super::file::LevelModel;
use crate::features::readings::{Reading, Readings};
use crate::model::crotch::no_lower;

/// Steps in which a cut is looked for, from the ground to the crown (structural).
const STEPS: u32 = 200;

impl LevelModel {
    /// How likely a body is whole, not cut off anywhere below, where either is as likely before anything is read: by the heights of
    /// buttocks and neck, and by where its legs join, which is the crotch or below it. Girths are no evidence of it.
    pub fn whole(&self, readings: &Readings, join: f64) -> f64 {
        let whole = self.as_cut(readings, join, 0.0);
        let cuts = (0..STEPS).map(|k| (f64::from(k) + 0.5) / f64::from(STEPS));
        let cut = cuts
            .map(|share| self.as_cut(readings, join, share))
            .sum::<f64>()
            / f64::from(STEPS);
        match whole + cut > 0.0 {
            true => whole / (whole + cut),
            false => 0.0,
        }
    }

    /// The density of heights of a body of which the lowest share is gone, given its stature.
    fn as_cut(&self, readings: &Readings, join: f64, gone: f64) -> f64 {
        let left = 1.0 - gone;
        let of_whole = |height: f64| gone + left * height;
        let at = |reading: Reading| {
            let k = self.readings.iter().position(|r| *r == reading)?;
            Some((k, readings.get(reading)?))
        };
        let tall = at(Reading::LnStature).map(|(k, ln)| (k, ln - libm::log(left)));
        let buttock = at(Reading::Buttock).map(|(k, z)| (k, of_whole(z)));
        let neck = at(Reading::Neck).map(|(k, z)| (k, of_whole(z)));
        let heights = [buttock, neck].into_iter().flatten().count();
        let size: Vec<_> = tall.into_iter().collect();
        let all: Vec<_> = [tall, buttock, neck].into_iter().flatten().collect();
        let density = |observed: &[(usize, f64)]| {
            let own = self.populations.iter().filter_map(|p| {
                let given = p.normal.given(observed, self.readings.len())?;
                Some(p.weight * libm::exp(given.log_density))
            });
            own.sum::<f64>()
        };
        let joins = buttock.map_or(1.0, |(_, z)| no_lower(z, of_whole(join)));
        match density(&size) {
            size if size > 0.0 => joins * left.powi(heights as i32) * density(&all) / size,
            _ => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::samples::made;
    use crate::model::table::Table;

    /// A body's readings where its lowest share is gone, and where its legs then join.
    fn cut(readings: &Readings, gone: f64, join: f64) -> (Readings, f64) {
        let left = |height: f64| (height - gone) / (1.0 - gone);
        let moved = [Reading::Buttock, Reading::Neck];
        let shorter = readings
            .get(Reading::LnStature)
            .map(|ln| ln + libm::log(1.0 - gone));
        let start = readings.clone().with(Reading::LnStature, shorter);
        let read = moved
            .into_iter()
            .fold(start, |all, r| all.with(r, readings.get(r).map(left)));
        (read, left(join))
    }

    #[test]
    fn whole_bodies_are_whole_however_low_their_legs_join_and_cut_ones_are_not() {
        let model = LevelModel::built_in();
        let all = made(&Table::checked_in("made-bodies.csv")).unwrap();
        let seen = all
            .iter()
            .filter(|m| m.readings.get(Reading::Buttock).is_some());
        let seen: Vec<_> = seen.step_by(5).collect();
        let share = |gone: f64, below: f64| {
            let whole = seen.iter().filter(|m| {
                let crotch = m.anatomy[1].unwrap_or(0.47);
                let (read, join) = cut(&m.readings, gone, crotch - below);
                model.whole(&read, join) > 0.5
            });
            whole.count() as f64 / seen.len() as f64
        };
        assert!(seen.len() > 150);
        let got = [
            (0.0, 0.0),
            (0.0, 0.15),
            (0.12, 0.0),
            (0.2, 0.0),
            (0.2, 0.15),
            (0.3, 0.0),
        ]
        .map(|(g, b)| share(g, b));
        assert!(got[0] > 0.97 && got[1] > 0.97, "{got:?}");
        assert!(
            got[2] < 0.2 && got[3..].iter().all(|s| *s < 0.02),
            "{got:?}"
        );
    }
}
