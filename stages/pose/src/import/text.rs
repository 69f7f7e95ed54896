//! Cameras from `cameras.json`, ours or a plain one, and from Middlebury's `_par.txt`.

use crate::import::foreign::{Foreign, ForeignError, Model, pose, unread};
use serde_json::Value;

/// All numbers of a JSON value, row by row.
fn numbers(value: &Value) -> Option<Vec<f64>> {
    match value {
        Value::Number(n) => Some(vec![n.as_f64()?]),
        Value::Array(all) => {
            let parts: Option<Vec<Vec<f64>>> = all.iter().map(numbers).collect();
            Some(parts?.concat())
        }
        _ => None,
    }
}

/// `cameras.json`: a list `views` or `cameras` of `{image or name, width, height, K, distortion, R, t}`.
///
/// # Errors
///
/// Text that is no JSON, a list that is not there, or a view without a key or with a matrix that is none.
pub fn from_json(file: &str, text: &str) -> Result<Model, ForeignError> {
    let whole: Value = serde_json::from_str(text).map_err(|e| unread(file, e.to_string()))?;
    let list = whole.get("views").or_else(|| whole.get("cameras"));
    let list = list.and_then(Value::as_array);
    let list = list.ok_or_else(|| unread(file, "has no list `views` or `cameras`"))?;
    let one = |(i, v): (usize, &Value)| -> Result<Foreign, ForeignError> {
        let lacks = |what: &str| unread(file, format!("camera {i} has no {what}"));
        let name = v.get("image").or_else(|| v.get("name"));
        let name = name.and_then(Value::as_str).ok_or_else(|| lacks("image"))?;
        let field = |key: &str, count: usize| {
            let all = v.get(key).and_then(numbers).filter(|n| n.len() == count);
            all.ok_or_else(|| lacks(&format!("{key} of {count} numbers")))
        };
        let k = field("K", 9)?;
        let radial = match v.get("distortion") {
            None | Some(Value::Null) => vec![],
            Some(d) => numbers(d).ok_or_else(|| lacks("readable distortion"))?,
        };
        if radial.iter().skip(2).any(|x| x.abs() > 1e-9) {
            return Err(ForeignError::Lens {
                file: file.to_owned(),
                model: format!("with {} coefficients", radial.len()),
            });
        }
        let size = |key: &str| Some(u32::try_from(v.get(key)?.as_u64()?).unwrap_or(0));
        Ok(Foreign {
            name: name.to_owned(),
            size: size("width").zip(size("height")).map(|(w, h)| [w, h]),
            focal: [k[0], k[4]],
            centre: [k[2], k[5]],
            radial: [
                radial.first().copied().unwrap_or(0.0),
                radial.get(1).copied().unwrap_or(0.0),
            ],
            pose: pose(file, &field("R", 9)?, &field("t", 3)?)?,
        })
    };
    let unit = whole.get("unit").and_then(Value::as_str);
    let turntable = whole.get("frame").and_then(Value::as_str);
    let turntable = turntable.is_some_and(|f| f.starts_with("turntable"));
    let ground = whole.get("ground_mm").or_else(|| whole.get("ground_rel"));
    let ground = ground.and_then(Value::as_f64);
    Ok(Model {
        cameras: list.iter().enumerate().map(one).collect::<Result<_, _>>()?,
        points: vec![],
        unit_mm: match unit {
            Some("mm") => Some(1.0),
            Some("cm") => Some(10.0),
            Some("m") => Some(1000.0),
            _ => None,
        },
        ground: turntable.then(|| ground.unwrap_or(0.0)),
    })
}

/// Middlebury's multi-view format: a count, then a line a photo: name, K, R, t row by row.
///
/// # Errors
///
/// A count that is missing or other than that of the lines, a line with other than a name and 21 numbers, or a matrix that is
/// no rotation.
pub fn from_middlebury(file: &str, text: &str) -> Result<Model, ForeignError> {
    let mut lines = text.lines().map(str::trim).filter(|l| !l.is_empty());
    let count = lines.next().and_then(|l| l.parse::<usize>().ok());
    let count = count.ok_or_else(|| unread(file, "does not begin with the number of cameras"))?;
    let one = |(i, line): (usize, &str)| -> Result<Foreign, ForeignError> {
        let mut words = line.split_whitespace();
        let name = words.next().unwrap_or_default().to_owned();
        let n: Vec<f64> = words.map_while(|w| w.parse().ok()).collect();
        if n.len() != 21 {
            return Err(unread(
                file,
                format!("line {} holds {} numbers, not 21", i + 2, n.len()),
            ));
        }
        Ok(Foreign {
            name,
            size: None,
            focal: [n[0], n[4]],
            centre: [n[2], n[5]],
            radial: [0.0; 2],
            pose: pose(file, &n[9..18], &n[18..21])?,
        })
    };
    let cameras: Vec<Foreign> = lines.enumerate().map(one).collect::<Result<_, _>>()?;
    if cameras.len() != count {
        let why = format!("announces {count} cameras and has {}", cameras.len());
        return Err(unread(file, why));
    }
    Ok(Model {
        cameras,
        ..Model::default()
    })
}
