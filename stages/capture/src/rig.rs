//! `capture.toml`: what the user knows of the capture.

use crate::date::{Day, read_day};
use crate::facts::Facts;
use crate::keys::{Keys, RigError};
use crate::person_keys::pass_over;
use crate::rig_tags::{read_mat, read_rim};
use shape::{Reference, Rig, SeenEnds};
use stage::{Message, message};
use toml::{Table, Value};

stage::messages! {
    TWO_ENDS = "rig-two-ends": "`reference.kind` is \"points\", whose two ends must be seen in two photos at least: `reference.seen = {example}`, or --seen";
    POINTS_ONLY = "rig-points-only": "`reference.seen`, or --seen, is where the two ends of a length are seen, and goes with `reference.kind` \"points\" only: give --reference points=297mm, or leave it out";
    ENDS = "rig-ends": "photos with the two ends in each, {example}";
    PIXEL = "rig-pixel": "a pixel, [x, y]";
}

/// A `capture.toml` in our units, and what else it has.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RigFile {
    /// What is known.
    pub rig: Rig,
    /// Whether the day is that of the photos.
    pub(crate) by_exif: bool,
    /// How many photos there should be.
    pub views: Option<usize>,
    /// The plate's file, relative to the folder.
    pub plate: Option<String>,
    /// Which files are the turn: names or patterns, relative to the folder; empty where none are given.
    pub images: Vec<String>,
    /// Keys that nobody reads.
    pub unknown: Vec<Message>,
}

/// Reads a `capture.toml`, and what is given beside it, which wins.
///
/// # Errors
///
/// Text that is no TOML, a value of the wrong type or beyond its range, tables that contradict each other.
pub fn read_rig(text: &str, facts: &Facts) -> Result<RigFile, RigError> {
    facts.read_over(text, read_table)
}

/// Reads the tables of a `capture.toml`.
pub(crate) fn read_table(table: Table) -> Result<RigFile, RigError> {
    let mut root = Keys::root(table);
    let mut file = RigFile::default();
    let rig = &mut file.rig;
    // Nobody else's matter, as what a person weighs: `capture.person` reads them.
    root.take("name");
    file.by_exif = read_day(&mut root)? == Some(Day::Exif);
    rig.step = root.known("step_deg")?.map(f64::to_radians);
    file.views = root.known("views")?.map(|x| x as usize);
    file.plate = root.text("plate")?;
    file.images = root.texts("images")?;
    if let Some(mut camera) = root.inner("camera")? {
        rig.focal_35mm = camera.known("focal_35mm")?;
        rig.focal_px = camera.known("focal_px")?;
        rig.centre_px = read_pixel(&mut camera, "centre_px")?;
        ["make", "model"]
            .iter()
            .for_each(|key| drop(camera.take(key)));
        camera.rest(&mut file.unknown);
    }
    if let Some(mut subject) = root.inner("subject")? {
        rig.stature_mm = subject.known("height_cm")?.map(|cm| cm * 10.0);
        pass_over(&mut subject);
        subject.rest(&mut file.unknown);
    }
    if let Some(mut disk) = root.inner("disk")? {
        rig.disk_diameter_mm = disk.known("diameter_cm")?.map(|cm| cm * 10.0);
        disk.take("top");
        disk.rest(&mut file.unknown);
    }
    if let Some(mut mat) = root.inner("mat")? {
        (rig.mat, rig.tag_mm) = read_mat(&mut mat)?;
        mat.rest(&mut file.unknown);
    }
    if let Some(mut rim) = root.inner("rim")? {
        rig.rim = Some(read_rim(&mut rim, rig)?);
        rim.rest(&mut file.unknown);
    }
    if let Some(mut reference) = root.inner("reference")? {
        let kind = reference.text("kind")?.unwrap_or_default();
        let length = reference.number("length_mm", 0.1, 100_000.0)?;
        let length_mm = length.ok_or_else(|| reference.lacks("length_mm"))?;
        let seen = read_seen(&mut reference)?;
        if kind == POINTS && seen.len() < 2 {
            let ends = message!(TWO_ENDS, example = SEEN);
            return Err(RigError::missing(ends));
        }
        if kind != POINTS && !seen.is_empty() {
            return Err(RigError::missing(message!(POINTS_ONLY)));
        }
        rig.reference = Some(Reference {
            kind,
            length_mm,
            seen,
        });
        reference.rest(&mut file.unknown);
    }
    root.rest(&mut file.unknown);
    Ok(file)
}

/// The kind of a reference length between two points that are seen in photos.
const POINTS: &str = "points";

/// How its ends are given.
const SEEN: &str = r#"{ "IMG_1.jpg" = [x1, y1, x2, y2], … }"#;

/// By photo the two ends of a length, `[x1, y1, x2, y2]`.
fn read_seen(keys: &mut Keys<'_>) -> Result<Vec<SeenEnds>, RigError> {
    let Some(value) = keys.take("seen") else {
        return Ok(vec![]);
    };
    let ends = |(photo, value): (&String, &Value)| {
        let [a, b, c, d] = numbers(value)?;
        let px = [[a, b], [c, d]];
        let photo = photo.clone();
        Some(SeenEnds { photo, px })
    };
    let all = value
        .as_table()
        .and_then(|t| t.iter().map(ends).collect::<Option<Vec<_>>>());
    let wants = message!(ENDS, example = SEEN);
    all.ok_or_else(|| keys.wrong("seen", wants, &value))
}

/// A pixel, `[x, y]`.
fn read_pixel(keys: &mut Keys<'_>, key: &'static str) -> Result<Option<[f64; 2]>, RigError> {
    let Some(value) = keys.take(key) else {
        return Ok(None);
    };
    match numbers(&value) {
        Some(pixel) => Ok(Some(pixel)),
        None => Err(keys.wrong(key, message!(PIXEL), &value)),
    }
}

/// A list of just so many finite numbers.
fn numbers<const N: usize>(value: &Value) -> Option<[f64; N]> {
    let number = |v: &Value| v.as_float().or(v.as_integer().map(|i| i as f64));
    let list: Option<Vec<f64>> = value.as_array()?.iter().map(number).collect();
    let list: [f64; N] = list?.try_into().ok()?;
    list.iter().all(|x| x.is_finite()).then_some(list)
}

#[cfg(test)]
mod tests {
    use super::*;
    use shape::Mat;

    fn read(text: &str) -> Result<RigFile, RigError> {
        read_rig(text, &Facts::default())
    }

    #[test]
    fn the_ends_of_a_length_are_read_by_photo() {
        let text = "[reference]\nkind = \"points\"\nlength_mm = 297\n[reference.seen]\n\"a.jpg\" = [1, 2, 3.5, 4]\n\"b.jpg\" = [5, 6, 7, 8]";
        let known = read(text).unwrap().rig.reference.unwrap();
        let first = SeenEnds {
            photo: "a.jpg".into(),
            px: [[1.0, 2.0], [3.5, 4.0]],
        };
        assert_eq!((known.seen.len(), &known.seen[0]), (2, &first));
        for (text, part) in [
            ("kind = \"points\"\nlength_mm = 297", "two photos at least"),
            (
                "kind = \"subject_height\"\nlength_mm = 1700\nseen.a = [1, 2, 3, 4]",
                "\"points\" only",
            ),
            (
                "length_mm = 297\nseen = [1, 2]",
                "`reference.seen` wants photos",
            ),
            (
                "length_mm = 297\nseen.a = [1, 2, 3]",
                "`reference.seen` wants photos",
            ),
        ] {
            let error = read(&format!("[reference]\n{text}")).unwrap_err();
            assert!(error.to_string().contains(part), "{error}");
        }
    }

    #[test]
    fn what_is_given_is_read_in_our_units() {
        let text = "step_deg = 20.0\n[disk]\ndiameter_cm = 45\n[mat]\ntag_size_mm = 60.0\n\
                    ids = [0, 11]\ncount = 12\nring_radius_mm = 187.0";
        let file = read(text).unwrap();
        proof::near(file.rig.step.unwrap(), std::f64::consts::PI / 9.0, 1e-12);
        assert_eq!(file.rig.disk_diameter_mm, Some(450.0));
        let mat = Mat {
            tag_mm: 60.0,
            first_id: 0,
            count: 12,
            ring_mm: 187.0,
        };
        assert_eq!(file.rig.mat, Some(mat));
        let lens = read("[camera]\nfocal_px = 3346.7\ncentre_px = [804.8, 1191]").unwrap();
        assert_eq!(lens.rig.focal_px, Some(3346.7));
        assert_eq!(lens.rig.centre_px, Some([804.8, 1191.0]));
    }

    #[test]
    fn a_slip_is_a_warning_and_nonsense_is_an_error() {
        let file = read("stepdeg = 20.0").unwrap();
        assert!(
            file.unknown[0].contains("did you mean `step_deg`"),
            "{:?}",
            file.unknown
        );
        for (text, part) in [
            ("step_deg = \"twenty\"", "`step_deg` wants a number"),
            (
                "[subject]\nheight_cm = 1758",
                "`subject.height_cm` wants a number from 10 to 300",
            ),
            (
                "[mat]\ntag_size_mm = 60\nring_radius_mm = 1\ncount = 3\nids = [0, 9]",
                "of 3 ids",
            ),
            (
                "[camera]\ncentre_px = [1.0]",
                "`camera.centre_px` wants a pixel",
            ),
            ("a = [", "capture.toml"),
        ] {
            let error = read(text).unwrap_err().to_string();
            assert!(error.contains(part), "{error}");
        }
    }
}
