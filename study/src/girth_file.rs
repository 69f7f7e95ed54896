//! A `girths.json` as other captures are compared with it.

use crate::score::RELATIVE;
use serde_json::Value;
use shape::Unit;
use std::path::{Path, PathBuf};

/// Its name in a folder of results.
pub const GIRTHS: &str = "girths.json";

/// A girth as `girths.json` has it, lengths in the unit of its file.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadGirth {
    /// Short name.
    pub name: String,
    /// What people call it.
    pub label: String,
    /// Where on the body, by the table of girths; older files do not have it.
    pub part: Option<String>,
    /// Along the contour.
    pub contour: f64,
    /// By tape.
    pub tape: f64,
    /// Holds the tape's truth nine times in ten; `None` where that is unknown.
    pub interval: Option<[f64; 2]>,
    /// Nine in ten measurements of the same person are within this of their mean; without the scale.
    pub repeat: Option<f64>,
    /// Standard deviation of the tape by the unit of length.
    pub scale: Option<f64>,
    /// Standard deviation of the tape by the surface, and by what was parted from the section.
    pub surface: Option<f64>,
    /// The plane: a point of it, and its normal.
    pub plane: Option<([f64; 3], [f64; 3])>,
}

/// All that is read of such a file.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct GirthFile {
    /// What lengths are in: centimetres (planes in millimetres), or relative.
    pub unit: Unit,
    /// The girths.
    pub girths: Vec<ReadGirth>,
    /// What the capture is called, where that is given.
    pub capture: Option<String>,
    /// The day of the capture, `YYYY-MM-DD`, where it is given.
    pub date: Option<String>,
    /// Crown above the ground.
    pub stature: Option<f64>,
    /// Its standard deviation.
    pub stature_sigma: Option<f64>,
    /// Volume of the body. \[l\]
    pub volume_l: Option<f64>,
}

impl GirthFile {
    /// The girth of a name.
    pub fn get(&self, name: &str) -> Option<&ReadGirth> {
        self.girths.iter().find(|g| g.name == name)
    }

    /// Reads the text of a file.
    ///
    /// # Errors
    ///
    /// What is wrong with it, in words.
    pub fn read(text: &str) -> Result<GirthFile, String> {
        let file: Value = serde_json::from_str(text).map_err(|e| e.to_string())?;
        let unit = match file["unit"] == RELATIVE {
            true => Unit::Relative,
            false => Unit::Metric,
        };
        let suffix = suffix(unit);
        let list = file["girths"].as_array().ok_or("it has no list `girths`")?;
        let whole = |girth: &Value| {
            let why = || format!("a girth has no `name`, `label`, `{suffix}` or `tape_{suffix}`");
            one(girth, suffix).ok_or_else(why)
        };
        Ok(GirthFile {
            unit,
            girths: list.iter().map(whole).collect::<Result<_, _>>()?,
            capture: file["capture"].as_str().map(str::to_owned),
            date: file["date"].as_str().map(str::to_owned),
            stature: file[format!("stature_{suffix}")].as_f64(),
            stature_sigma: file[format!("stature_sigma_{suffix}")].as_f64(),
            volume_l: file["volume_l"].as_f64(),
        })
    }
}

fn one(girth: &Value, suffix: &str) -> Option<ReadGirth> {
    let text = |key: &str| girth[key].as_str().map(str::to_owned);
    let length = |key: &str| &girth[format!("{key}_{suffix}")];
    let sigma = |part: &str| length("sigma")[part].as_f64();
    let three = |v: &Value| -> Option<[f64; 3]> {
        let v = v.as_array()?;
        Some([
            v.first()?.as_f64()?,
            v.get(1)?.as_f64()?,
            v.get(2)?.as_f64()?,
        ])
    };
    let at = match suffix {
        "cm" => &girth["plane"]["point_mm"],
        _ => &girth["plane"]["point_rel"],
    };
    let ends = length("interval").as_array();
    let surface = sigma("surface").map(|s| libm::hypot(s, sigma("split").unwrap_or(0.0)));
    Some(ReadGirth {
        name: text("name")?,
        label: text("label")?,
        part: text("part"),
        contour: girth[suffix].as_f64()?,
        tape: length("tape").as_f64()?,
        interval: ends.and_then(|e| Some([e.first()?.as_f64()?, e.get(1)?.as_f64()?])),
        repeat: length("repeat").as_f64(),
        scale: sigma("scale"),
        surface,
        plane: three(at).zip(three(&girth["plane"]["normal"])),
    })
}

/// What keys end in.
pub(crate) fn suffix(unit: Unit) -> &'static str {
    match unit {
        Unit::Metric => "cm",
        Unit::Relative => "rel",
    }
}

/// The `girths.json` that a path means: the file itself, a folder of results, or a capture whose
/// results are beside it (`DIR-out`, as `measure` writes them).
///
/// # Errors
///
/// There is none, with what to do.
pub fn find(path: &Path) -> Result<PathBuf, String> {
    if path.is_file() && path.extension().is_some_and(|e| e == "json") {
        return Ok(path.to_owned());
    }
    let within = path.join(GIRTHS);
    if within.is_file() {
        return Ok(within);
    }
    let whole = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let beside = whole.file_name().map(|name| {
        let name = format!("{}-out", name.to_string_lossy());
        whole.with_file_name(name).join(GIRTHS)
    });
    if let Some(beside) = beside.filter(|b| b.is_file()) {
        return Ok(beside);
    }
    let path = path.display();
    Err(match whole.exists() {
        true => format!(
            "{path}: there is no {GIRTHS} in it or beside it: run `tailor measure {path}` first"
        ),
        false => format!("{path} is not there"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_of_results_and_a_capture_beside_it_mean_the_same_file() {
        let place = tempfile::tempdir().unwrap();
        let (capture, out) = (place.path().join("anna"), place.path().join("anna-out"));
        std::fs::create_dir(&capture).unwrap();
        assert!(find(&capture).unwrap_err().contains("tailor measure"));
        std::fs::create_dir(&out).unwrap();
        std::fs::write(out.join(GIRTHS), "{}").unwrap();
        for path in [&capture, &out, &out.join(GIRTHS)] {
            let found = find(path).unwrap().canonicalize().unwrap();
            assert_eq!(found, out.join(GIRTHS).canonicalize().unwrap());
        }
        let gone = find(&place.path().join("bert")).unwrap_err();
        assert!(gone.ends_with("is not there"), "{gone}");
    }

    #[test]
    fn intervals_sigmas_and_planes_are_read() {
        let text = r#"{"unit":"cm","stature_cm":175.2,"girths":[{"name":"WC","label":"waist","part":"waist","cm":90.1,"tape_cm":90.0,
            "interval_cm":[89.0,91.5],"repeat_cm":0.4,"sigma_cm":{"level":0.3,"surface":0.03,"scale":0.1,"split":0.04,"cover":0.0},
            "plane":{"point_mm":[1.0,2.0,3.0],"normal":[0.0,0.0,1.0]}}]}"#;
        let file = GirthFile::read(text).unwrap();
        let waist = file.get("WC").unwrap();
        assert_eq!(
            (waist.interval, waist.repeat, waist.scale),
            (Some([89.0, 91.5]), Some(0.4), Some(0.1))
        );
        proof::near(waist.surface.unwrap(), 0.05, 1e-12);
        assert_eq!(waist.plane, Some(([1.0, 2.0, 3.0], [0.0, 0.0, 1.0])));
        assert_eq!(file.stature, Some(175.2));
        let error = GirthFile::read(r#"{"girths":[{"name":"WC"}]}"#).unwrap_err();
        assert!(error.contains("tape_cm"), "{error}");
    }
}
