//! The plane of the neck's girth: square to the neck's axis, at an estimated level, never on jaw or shoulders.

use crate::features::neck::NeckFeatures;
use crate::features::neck_tube::{around, leaning};
use nalgebra::Point3;
use shape::{Plane, Refusal};

/// A section whose tape is longer than the tightest by more than this share is none of the tube: jaw or shoulders.
/// Bases of necks are 1.104 ± 0.032 times as long as necks (ANSUR II).
const LONGEST_SHARE: f64 = 0.12;
/// Steps in which a plane slides towards the tightest section, as a share of the diameter (structural: samples).
const SLIDE: f64 = 0.01;

/// A tube shorter than this, as a share of its diameter, is a groove, where a tape comes to rest at its tightest. At the
/// estimated level tapes err there by a tenth in the middle, elsewhere by less than a fortieth (a test, on `models/tables/neck.csv`).
const TUBE: f64 = 0.27;

/// A plane across a neck.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NeckPlane {
    /// The plane, its point in the middle of the section.
    pub plane: Plane,
    /// Its offset along the axis from the tightest section, as a share of the diameter.
    pub share: f64,
    /// The tape around the section. \[mm\]
    pub tape_mm: f64,
    /// Standard deviation of that offset beside what the level's is; all of it where the neck is a groove.
    pub(crate) off: Off,
}

/// How far from the estimated level a plane is, as a share of the neck's diameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Off {
    /// It slid so far.
    Slid(f64),
    /// The neck is a groove: anywhere in it, so far in standard deviations.
    Groove(f64),
}

impl Off {
    /// Standard deviation of the plane's offset, of a level that is so sure.
    pub(crate) fn with(self, level: f64) -> f64 {
        match self {
            Off::Slid(far) => libm::hypot(level, far),
            Off::Groove(sigma) => sigma,
        }
    }
}

/// Whether a neck is a groove: too short for a tape to be anywhere but at its tightest.
pub fn is_groove(f: &NeckFeatures) -> bool {
    long(f) < TUBE
}

/// How long the tube is, as a share of its diameter.
fn long(f: &NeckFeatures) -> f64 {
    let (up, low) = f.tube.ends;
    (up - low) / f.diameter_mm()
}

/// The plane square to the neck's axis at an offset from its tightest section (a share of its diameter),
/// or the nearest to it that goes around the neck alone and passes under the chin; of a groove the tightest section.
///
/// # Errors
/// [`Refusal::NeckGroove`] for a groove without a section, [`Refusal::NoSection`] where no plane goes around the neck.
pub fn plane_at(f: &NeckFeatures, share: f64) -> Result<NeckPlane, Refusal> {
    if is_groove(f) {
        // The standard deviation of what is anywhere in it.
        let off = Off::Groove(long(f) / 12f64.sqrt());
        let tightest = across(f, 0.0).ok_or(Refusal::NeckGroove)?;
        return Ok(NeckPlane { off, ..tightest });
    }
    let angle = f.throat.angle.0 / f.diameter_mm();
    let want = if share > 0.0 {
        share.min(angle.max(0.0))
    } else {
        share
    };
    let steps = (want.abs() / SLIDE).ceil() as i32;
    (0..=steps)
        .map(|k| want - want.signum() * (f64::from(k) * SLIDE).min(want.abs()))
        .find_map(|s| across(f, s))
        .map(|at| NeckPlane {
            off: Off::Slid((at.share - share).abs()),
            ..at
        })
        .ok_or(Refusal::NoSection)
}

/// The section of the tube at an offset.
fn across(f: &NeckFeatures, share: f64) -> Option<NeckPlane> {
    let tube = &f.tube;
    let ring = tube.ring(share * f.diameter_mm())?;
    let fits = ring.tape <= (1.0 + LONGEST_SHARE) * tube.girth;
    fits.then(|| NeckPlane {
        plane: Plane {
            point_mm: ring.centre.into(),
            normal: tube.axis().into(),
        },
        share,
        tape_mm: ring.tape,
        off: Off::Slid(0.0),
    })
}

/// The plane turned forward by an angle about the middle of its section. \[rad\]
///
/// # Errors
/// [`Refusal::NoSection`] where the turned plane leaves the neck.
pub(crate) fn tilted(f: &NeckFeatures, at: NeckPlane, more: f64) -> Result<NeckPlane, Refusal> {
    if more == 0.0 {
        return Ok(at);
    }
    let normal = leaning(&f.tube.front, f.tube.lean + more);
    let ring = around(&f.tube.part, &Point3::from(at.plane.point_mm), &normal);
    let ring = ring.ok_or(Refusal::NoSection)?;
    Ok(NeckPlane {
        plane: Plane {
            point_mm: ring.centre.into(),
            normal: normal.into(),
        },
        tape_mm: ring.tape,
        ..at
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::file::LevelModel;
    use crate::model::larynx::larynx;
    use crate::model::law::Place;
    use crate::model::necks::necks;
    use crate::model::table::Table;

    /// Medians of the tape's error of necks with a tube of some lengths: at the estimated level, and at the tightest section.
    fn middles(from: f64, to: f64) -> [f64; 2] {
        let table = Table::checked_in("neck.csv");
        let model = LevelModel::built_in();
        let column = |name: &str| table.optional(name).unwrap();
        let features: Vec<_> = NeckFeatures::NAMES
            .map(|f| column(&format!("f.{f}")))
            .into();
        let necks = necks(&table).unwrap();
        let of = |row: usize, name: &str| {
            let at = NeckFeatures::NAMES.iter().position(|n| *n == name)?;
            features[at][row]
        };
        let errors = |row: usize| {
            let read = Place::Notch.features().into_iter().map(|f| of(row, f));
            let read: Option<Vec<f64>> = read.collect();
            let reported = model.law(Place::Notch).estimate(&read?)?;
            let reported = larynx(reported, of(row, "angle")?).value;
            let tape = |at: f64| necks[row].tapes.at(at);
            let own = tape(necks[row].larynx?)?;
            Some([tape(reported)?, tape(0.0)?].map(|t| (t / own - 1.0).abs()))
        };
        let long = |row: &usize| {
            let tube = of(*row, "up").unwrap() - of(*row, "low").unwrap();
            (from..to).contains(&tube)
        };
        let all: Vec<[f64; 2]> = (0..table.len()).filter(long).filter_map(errors).collect();
        assert!(all.len() > 10);
        [0, 1].map(|k| shape::upper_median(all.iter().map(|e| e[k])).unwrap())
    }

    #[test]
    fn a_groove_is_taken_at_its_tightest_and_a_tube_at_its_level() {
        let (groove, tube) = (middles(0.0, TUBE), middles(TUBE, 9.0));
        assert!(groove[0] > 0.08 && groove[1] < 0.05, "{groove:?}");
        assert!(tube[0] < 0.025 && tube[1] > tube[0], "{tube:?}");
    }
}
