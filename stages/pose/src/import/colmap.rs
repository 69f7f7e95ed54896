//! COLMAP models, text and binary. COLMAP puts the centre of the top-left pixel at (0.5, 0.5).

use crate::import::foreign::{Foreign, ForeignError, Model, unread};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use shape::Pose;
use std::collections::BTreeMap;

/// Size, focal length, centre, k1 and k2.
type Lens = ([u32; 2], [f64; 2], [f64; 2], [f64; 2]);

/// Models of lenses and how many numbers each has (structural: COLMAP's own numbers and names).
const MODELS: [(&str, usize); 5] = [
    ("SIMPLE_PINHOLE", 3),
    ("PINHOLE", 4),
    ("SIMPLE_RADIAL", 4),
    ("RADIAL", 5),
    ("OPENCV", 8),
];

fn lens(file: &str, model: &str, size: [u32; 2], p: &[f64]) -> Result<Lens, ForeignError> {
    let unknown = || ForeignError::Lens {
        file: file.to_owned(),
        model: model.to_owned(),
    };
    let count = MODELS.iter().find(|m| m.0 == model).ok_or_else(unknown)?.1;
    if p.len() != count {
        return Err(unread(
            file,
            format!("a {model} lens has {count} params, not {}", p.len()),
        ));
    }
    let (focal, centre, radial) = match model {
        "SIMPLE_PINHOLE" => ([p[0]; 2], [p[1], p[2]], [0.0; 2]),
        "PINHOLE" => ([p[0], p[1]], [p[2], p[3]], [0.0; 2]),
        "SIMPLE_RADIAL" => ([p[0]; 2], [p[1], p[2]], [p[3], 0.0]),
        "RADIAL" => ([p[0]; 2], [p[1], p[2]], [p[3], p[4]]),
        _ if p[6].abs().max(p[7].abs()) > 1e-9 => return Err(unknown()),
        _ => ([p[0], p[1]], [p[2], p[3]], [p[4], p[5]]),
    };
    Ok((size, focal, centre.map(|c| c - 0.5), radial))
}

fn foreign(
    file: &str,
    name: String,
    q: [f64; 4],
    t: [f64; 3],
    lens: Option<&Lens>,
) -> Result<Foreign, ForeignError> {
    let Some(&(size, focal, centre, radial)) = lens else {
        return Err(unread(
            file,
            format!("{name} has a camera that is nowhere given"),
        ));
    };
    let q = Quaternion::new(q[0], q[1], q[2], q[3]);
    if q.norm().is_nan() || q.norm() < 1e-6 || t.iter().any(|x| !x.is_finite()) {
        return Err(unread(file, format!("{name} has no rotation")));
    }
    let rotation = UnitQuaternion::from_quaternion(q).to_rotation_matrix();
    Ok(Foreign {
        name,
        size: Some(size),
        focal,
        centre,
        radial,
        pose: Pose {
            rotation,
            translation: Vector3::from(t),
        },
    })
}

/// `cameras.txt`, `images.txt` and `points3D.txt`; the last may be empty.
///
/// # Errors
///
/// A line that is not of the format, an image without a camera, or a lens model that is not known here.
pub fn from_colmap_text(cameras: &str, images: &str, points: &str) -> Result<Model, ForeignError> {
    let file = "cameras.txt";
    let mut lenses = BTreeMap::new();
    for line in cameras
        .lines()
        .filter(|l| !l.starts_with('#') && !l.trim().is_empty())
    {
        let words: Vec<&str> = line.split_whitespace().collect();
        let bad = || unread(file, format!("cannot be read here: {line}"));
        if words.len() < 5 {
            return Err(bad());
        }
        let p: Vec<f64> = words[4..].iter().map_while(|w| w.parse().ok()).collect();
        let size = [
            words[2].parse().map_err(|_| bad())?,
            words[3].parse().map_err(|_| bad())?,
        ];
        lenses.insert(words[0].to_owned(), lens(file, words[1], size, &p)?);
    }
    let file = "images.txt";
    let mut found = Vec::new();
    // Two lines a photo; the second, of features, may be empty.
    let lines: Vec<&str> = images.lines().filter(|l| !l.starts_with('#')).collect();
    for line in lines.iter().step_by(2).filter(|l| !l.trim().is_empty()) {
        let words: Vec<&str> = line.split_whitespace().collect();
        let n: Vec<f64> = words
            .iter()
            .skip(1)
            .take(7)
            .map_while(|w| w.parse().ok())
            .collect();
        let &[qw, qx, qy, qz, x, y, z] = &n[..] else {
            return Err(unread(file, format!("cannot be read here: {line}")));
        };
        if words.len() < 10 {
            return Err(unread(file, format!("has no name here: {line}")));
        }
        let name = words[9..].join(" ");
        found.push(foreign(
            file,
            name,
            [qw, qx, qy, qz],
            [x, y, z],
            lenses.get(words[8]),
        )?);
    }
    let point = |line: &str| -> Option<[f64; 3]> {
        let n: Vec<f64> = line
            .split_whitespace()
            .skip(1)
            .take(3)
            .map_while(|w| w.parse().ok())
            .collect();
        n.try_into().ok()
    };
    Ok(Model {
        cameras: found,
        points: points
            .lines()
            .filter(|l| !l.starts_with('#'))
            .filter_map(point)
            .collect(),
        ..Model::default()
    })
}

/// Little-endian bytes, read from the front.
struct Bytes<'a> {
    file: &'static str,
    left: &'a [u8],
}

impl Bytes<'_> {
    fn take<const N: usize>(&mut self) -> Result<[u8; N], ForeignError> {
        let (head, left) = self
            .left
            .split_first_chunk::<N>()
            .ok_or_else(|| unread(self.file, "ends too early"))?;
        self.left = left;
        Ok(*head)
    }

    fn whole(&mut self) -> Result<u64, ForeignError> {
        self.take().map(u64::from_le_bytes)
    }

    fn small(&mut self) -> Result<u32, ForeignError> {
        self.take().map(u32::from_le_bytes)
    }

    fn real(&mut self) -> Result<f64, ForeignError> {
        self.take().map(f64::from_le_bytes)
    }

    fn reals<const N: usize>(&mut self) -> Result<[f64; N], ForeignError> {
        let mut all = [0.0; N];
        for x in &mut all {
            *x = self.real()?;
        }
        Ok(all)
    }

    fn skip(&mut self, count: u64) -> Result<(), ForeignError> {
        let count = usize::try_from(count).unwrap_or(usize::MAX);
        self.left = self
            .left
            .get(count..)
            .ok_or_else(|| unread(self.file, "ends too early"))?;
        Ok(())
    }
}

/// `cameras.bin`, `images.bin` and `points3D.bin`; the last may be empty.
///
/// # Errors
///
/// A file that ends early, an image without a camera, or a lens model that is not known here.
pub fn from_colmap_binary(
    cameras: &[u8],
    images: &[u8],
    points: &[u8],
) -> Result<Model, ForeignError> {
    let mut from = Bytes {
        file: "cameras.bin",
        left: cameras,
    };
    let mut lenses = BTreeMap::new();
    for _ in 0..from.whole()? {
        let (id, model) = (from.small()?, from.small()?);
        let size = [from.whole()?, from.whole()?].map(|s| u32::try_from(s).unwrap_or(0));
        let Some((name, count)) = MODELS.get(model as usize) else {
            return Err(ForeignError::Lens {
                file: from.file.to_owned(),
                model: model.to_string(),
            });
        };
        let p: Vec<f64> = (0..*count).map(|_| from.real()).collect::<Result<_, _>>()?;
        lenses.insert(id, lens(from.file, name, size, &p)?);
    }
    let mut from = Bytes {
        file: "images.bin",
        left: images,
    };
    let mut found = Vec::new();
    for _ in 0..from.whole()? {
        from.small()?;
        let (q, t, id) = (from.reals::<4>()?, from.reals::<3>()?, from.small()?);
        let end = from.left.iter().position(|b| *b == 0);
        let end = end.ok_or_else(|| unread("images.bin", "holds a name without end"))?;
        let name = String::from_utf8_lossy(&from.left[..end]).into_owned();
        from.skip(end as u64 + 1)?;
        let features = from.whole()?;
        from.skip(features.saturating_mul(24))?;
        found.push(foreign(from.file, name, q, t, lenses.get(&id))?);
    }
    let mut all = Vec::new();
    if !points.is_empty() {
        let mut from = Bytes {
            file: "points3D.bin",
            left: points,
        };
        for _ in 0..from.whole()? {
            from.whole()?;
            all.push(from.reals::<3>()?);
            from.skip(3 + 8)?;
            let track = from.whole()?;
            from.skip(track.saturating_mul(8))?;
        }
    }
    Ok(Model {
        cameras: found,
        points: all,
        ..Model::default()
    })
}
