//! A learned sense of a person as evidence: how likely each pixel is body, by a network that saw other people.

use nalgebra::Point2;
use shape::{Found, People, PhotoId};

/// Log-odds of the body by those of the network: they are too sure, and the outline is wide. Fitted by
/// `models/person/calibrate.py` (logistic; Platt 1999). \[nats, and nats a nat\]
const CALIBRATED: [f32; 2] = [-1.31, 0.76];

/// Log-odds that are sure: 19 to 1 (derived: ln 19).
pub(crate) const SURE: f32 = 2.94;

/// Whether the network is sure that a pixel is no person's; `odds` are log-odds, row by row, and none where nobody is seen.
pub(crate) fn surely_nobody(odds: &[f32], i: usize) -> bool {
    odds.get(i).is_some_and(|odds| *odds < -SURE)
}

/// Log-odds that each pixel of a reduced photo of this size is body, row by row, of which so many pixels along a side became
/// one; empty where the turn shows no person. \[nats\]
pub(crate) fn sense(
    people: Option<&People>,
    id: PhotoId,
    [width, height]: [usize; 2],
    factor: usize,
) -> Vec<f32> {
    let Some(found) = people.and_then(|people| people.subject(id)) else {
        return Vec::new();
    };
    let middle = |i: usize| (i * factor) as f64 + (factor as f64 - 1.0) / 2.0;
    let at = |i: usize| Point2::new(middle(i % width), middle(i / width));
    let all = (0..width * height).map(|i| calibrated(found, at(i)));
    all.collect()
}

/// Where the network did not look nothing is known.
fn calibrated(found: &Found, at: Point2<f64>) -> f32 {
    let [base, slope] = CALIBRATED;
    found.log_odds(at).map_or(0.0, |odds| base + slope * odds)
}

/// What a pixel costs as background and as body, with a person's [`sense`] of it: log-odds
/// are added to the side that they speak against. \[nats\]
pub(crate) fn with_person(background: f64, body: f64, log_odds: f32) -> (f64, f64) {
    let odds = f64::from(log_odds);
    (background + odds.max(0.0), body + (-odds).max(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cut::least_cut::Known;
    use crate::label::color_cut::{Settings, coarse};
    use crate::likelihood::background::Noise;
    use crate::likelihood::prepared::Prepared;
    use crate::raster::raster;
    use shape::{Crop, Image};

    const SIDE: usize = 60;

    /// A body 20 pixels wide before a grey wall; between rows 25 and 40 it wears the wall's very colour.
    fn dressed(person: Vec<f32>) -> Prepared {
        let body = |i: usize| (20..40).contains(&(i % SIDE)) && (8..54).contains(&(i / SIDE));
        let garment = |i: usize| (25..40).contains(&(i / SIDE));
        let skin = |i: usize| body(i) && !garment(i);
        let all = 0..SIDE * SIDE;
        let color = |i| match skin(i) {
            true => [190, 130, 100],
            false => [128; 3],
        };
        let cost: Vec<f32> = all
            .clone()
            .map(|i| if skin(i) { 60.0 } else { 4.5 })
            .collect();
        Prepared {
            factor: 1,
            small: raster(SIDE, SIDE, all.map(color).collect()),
            cost,
            person,
            mirrored: Vec::new(),
            light: Vec::new(),
            unforeseen: None,
            known: vec![Known::Unknown; SIDE * SIDE],
            noise: Noise::even(1.8),
            floor: None,
        }
    }

    fn garment_kept(person: Vec<f32>) -> usize {
        let settings = Settings {
            gamma: 40.0,
            rounds: 2,
            clusters: 2,
            thinner: 0.0,
        };
        let (sides, _) = coarse(&dressed(person), &settings).unwrap();
        let garment = (25..40).flat_map(|y| (20..40).map(move |x| y * SIDE + x));
        garment.filter(|i| sides.data[*i]).count()
    }

    #[test]
    fn a_garment_of_the_walls_colour_is_body_where_a_person_is_seen() {
        assert_eq!(garment_kept(vec![]), 0);
        let seen = |i: usize| (19..41).contains(&(i % SIDE)) && (7..55).contains(&(i / SIDE));
        let odds = (0..SIDE * SIDE).map(|i| if seen(i) { 4.7 } else { -7.3 });
        assert!(garment_kept(odds.collect()) > 290, "of 300");
        // What the network is not sure of stays with the wall that it looks like.
        let unsure = (0..SIDE * SIDE).map(|i| if seen(i) { 1.0 } else { -1.0 });
        assert_eq!(garment_kept(unsure.collect()), 0);
    }

    #[test]
    fn log_odds_are_calibrated_within_the_square_and_nothing_beyond() {
        let found = |odds: f32| Found {
            crop: Crop {
                centre_px: [50.0, 50.0],
                side_px: 40.0,
                angle: 0.0,
            },
            body: Image::filled(8, 8, Found::kept(odds)),
            ..Found::default()
        };
        let people = |person: bool| People {
            views: [(PhotoId(0), vec![found(2.0)])].into_iter().collect(),
            person,
        };
        let on = |people: &People| sense(Some(people), PhotoId(0), [25, 25], 4);
        assert!(on(&people(false)).is_empty());
        assert!(sense(None, PhotoId(0), [25, 25], 4).is_empty());
        let odds = on(&people(true));
        let inside = CALIBRATED[0] + CALIBRATED[1] * 2.0;
        assert!((odds[12 * 25 + 12] - inside).abs() < 1e-6);
        assert_eq!(odds[0], 0.0);
    }
}
