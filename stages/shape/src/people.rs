//! People on photos, as networks that were trained elsewhere see them: where somebody is, never the outline.

use crate::runs::{pixels, runs};
use crate::{ByPhoto, Crop, Image, Mask, PhotoId};
use nalgebra::Point2;
use serde::{Deserialize, Serialize};
use stage::{Artifact, Corrupt, Packer, Unpacker};

/// Steps of a nat in which log-odds are kept (structural: a byte holds ± 8 nats).
const STEPS: f32 = 16.0;

/// A joint, or a mark of face, hand or foot.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Joint {
    /// Where. \[px\]
    pub at_px: [f32; 2],
    /// How sure it is that nothing hides it, 0 to 1.
    pub visibility: f32,
    /// How sure it is that it is within the photo, 0 to 1.
    pub presence: f32,
}

/// Somebody on a photo.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Found {
    /// How sure the detector is, 0 to 1.
    pub score: f32,
    /// How sure the second network is that its square shows a person, 0 to 1.
    pub presence: f32,
    /// The head's box as the detector has it: left, top, right, bottom. \[px\]
    pub head_px: [f32; 4],
    /// The square that the second network looked at.
    pub crop: Crop,
    /// By pixel of that square, how much more likely it is the body than not: sixteenths of a nat, at most ±127.
    /// As the network gives it, not calibrated; its outline is right to one or two of these pixels.
    pub body: Image<i8>,
    /// [`JOINTS`](Found::JOINTS), in this order.
    pub joints: Vec<Joint>,
}

impl Found {
    /// What the joints are. Left and right are the person's.
    pub const JOINTS: [&'static str; 33] = [
        "nose",
        "left eye, inner",
        "left eye",
        "left eye, outer",
        "right eye, inner",
        "right eye",
        "right eye, outer",
        "left ear",
        "right ear",
        "mouth, left",
        "mouth, right",
        "left shoulder",
        "right shoulder",
        "left elbow",
        "right elbow",
        "left wrist",
        "right wrist",
        "left little finger",
        "right little finger",
        "left index finger",
        "right index finger",
        "left thumb",
        "right thumb",
        "left hip",
        "right hip",
        "left knee",
        "right knee",
        "left ankle",
        "right ankle",
        "left heel",
        "right heel",
        "left toes",
        "right toes",
    ];

    /// Photo pixels of one pixel of the network: within one or two of these nothing is known of the outline.
    pub fn pixel_px(&self) -> f32 {
        self.crop.side_px / self.body.width.max(1) as f32
    }

    /// Log-odds that a point of the photo is body, between the network's pixels; `None` outside of its square. \[nat\]
    pub fn log_odds(&self, at_px: Point2<f64>) -> Option<f32> {
        let [u, v] = self.crop.of_photo([at_px.x as f32, at_px.y as f32]);
        let inside = (0.0..=1.0).contains(&u) && (0.0..=1.0).contains(&v);
        let (width, height) = (self.body.width, self.body.height);
        if !inside || width == 0 || height == 0 {
            return None;
        }
        let place = |t: f32, n: usize| {
            let at = (t * n as f32 - 0.5).clamp(0.0, (n - 1) as f32);
            let first = (at as usize).min(n.saturating_sub(2));
            (first, (first + 1).min(n - 1), at - first as f32)
        };
        let ((x0, x1, fx), (y0, y1, fy)) = (place(u, width), place(v, height));
        let value = |x: usize, y: usize| f32::from(self.body.at(x, y));
        let top = value(x0, y0) + fx * (value(x1, y0) - value(x0, y0));
        let bottom = value(x0, y1) + fx * (value(x1, y1) - value(x0, y1));
        Some((top + fy * (bottom - top)) / STEPS)
    }

    /// Log-odds as they are kept.
    pub fn kept(log_odds: f32) -> i8 {
        (log_odds * STEPS).round().clamp(-127.0, 127.0) as i8
    }

    /// The mask on a photo of this size: 255 times how likely each pixel is body, 0 outside of the square.
    pub fn mask(&self, width: usize, height: usize) -> Mask {
        let mut mask = Mask::filled(width, height, 0);
        for (i, pixel) in mask.data.iter_mut().enumerate() {
            let at = Point2::new((i % width) as f64, (i / width) as f64);
            if let Some(odds) = self.log_odds(at) {
                *pixel = (255.0 / (1.0 + libm::expf(-odds))).round() as u8;
            }
        }
        mask
    }
}

/// The people on each photo, and whether the turn shows one.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct People {
    /// By photo, every photo of the turn; first the one who is followed, then by score. Empty where nobody is seen.
    pub views: ByPhoto<Vec<Found>>,
    /// Whether what is turned is a person: given only where most photos agree. Where it is not, nothing here may be used.
    pub person: bool,
}

impl People {
    /// The one who is followed on a photo; nobody where the turn shows no person.
    pub fn subject(&self, id: PhotoId) -> Option<&Found> {
        self.views.get(id)?.first().filter(|_| self.person)
    }
}

#[derive(Serialize, Deserialize)]
struct Meta {
    score: f32,
    presence: f32,
    head_px: [f32; 4],
    crop: Crop,
    size: [u32; 2],
    joints: Vec<Joint>,
}

impl Artifact for People {
    const KIND: &'static str = "people";
    const FORMAT: u32 = 1;

    fn pack(&self, to: &mut Packer) {
        let meta = |f: &Found| Meta {
            score: f.score,
            presence: f.presence,
            head_px: f.head_px,
            crop: f.crop,
            size: [f.body.width as u32, f.body.height as u32],
            joints: f.joints.clone(),
        };
        let views: Vec<(PhotoId, Vec<Meta>)> = self
            .views
            .iter()
            .map(|(id, found)| (id, found.iter().map(meta).collect()))
            .collect();
        to.meta(&(self.person, views));
        for (id, found) in self.views.iter() {
            for (i, one) in found.iter().enumerate() {
                let bytes: Vec<u8> = one.body.data.iter().map(|v| *v as u8).collect();
                to.section(format!("body {} {i}", id.0), &runs(&bytes));
            }
        }
    }

    fn unpack(from: &Unpacker<'_>) -> Result<Self, Corrupt> {
        let (person, views): (bool, Vec<(PhotoId, Vec<Meta>)>) = from.meta()?;
        let one = |id: PhotoId, i: usize, m: Meta| -> Result<Found, Corrupt> {
            let [width, height] = m.size.map(|n| n as usize);
            if m.joints.len() != Found::JOINTS.len() {
                return Err(Corrupt("another number of joints".into()));
            }
            let bytes = from.section(&format!("body {} {i}", id.0))?;
            let bytes = pixels(&bytes, width.saturating_mul(height))?;
            Ok(Found {
                score: m.score,
                presence: m.presence,
                head_px: m.head_px,
                crop: m.crop,
                body: Image {
                    width,
                    height,
                    data: bytes.into_iter().map(|v| v as i8).collect(),
                },
                joints: m.joints,
            })
        };
        let view = |(id, all): (PhotoId, Vec<Meta>)| {
            let all = all.into_iter().enumerate().map(|(i, m)| one(id, i, m));
            Ok((id, all.collect::<Result<Vec<_>, Corrupt>>()?))
        };
        Ok(People {
            views: views
                .into_iter()
                .map(view)
                .collect::<Result<_, Corrupt>>()?,
            person,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found() -> Found {
        let mut body = Image::filled(256, 256, -127i8);
        for y in 64..192 {
            for x in 96..160 {
                *body.at_mut(x, y) = 127;
            }
        }
        *body.at_mut(3, 5) = 20;
        let joint = Joint {
            at_px: [310.0, 200.5],
            visibility: 0.75,
            presence: 1.0,
        };
        Found {
            score: 0.9,
            presence: 0.99,
            head_px: [280.0, 100.0, 320.0, 150.0],
            crop: Crop {
                centre_px: [300.0, 250.0],
                side_px: 512.0,
                angle: 0.0,
            },
            body,
            joints: vec![joint; 33],
        }
    }

    #[test]
    fn people_come_back_from_their_bytes() {
        let people = People {
            views: [(PhotoId(0), vec![found()]), (PhotoId(1), vec![])]
                .into_iter()
                .collect(),
            person: true,
        };
        let bytes = stage::to_bytes(&people);
        assert_eq!(stage::from_bytes::<People>(&bytes).unwrap(), people);
        assert!(bytes.len() < 8_000, "{}", bytes.len());
        let hash = "e892e7cdc51567a66c0e8912acaeda56fbaf1ca92cc8a3938a30c86240dc4078";
        assert_eq!(
            stage::hash(&bytes).to_hex().as_str(),
            hash,
            "another format"
        );
        for at in (0..bytes.len()).step_by(7) {
            let mut bytes = bytes.clone();
            bytes[at] ^= 0x55;
            let _ = stage::from_bytes::<People>(&bytes);
        }
    }

    #[test]
    fn the_mask_is_where_the_square_does() {
        let mut found = found();
        let at = |f: &Found, x: f64, y: f64| f.log_odds(Point2::new(x, y));
        // Two photo pixels a pixel: body from 96 · 2 + 44 to 160 · 2 + 44, less half a pixel.
        assert!(at(&found, 237.0, 250.0).unwrap() > 0.0 && at(&found, 234.0, 250.0).unwrap() < 0.0);
        assert_eq!(at(&found, 20.0, 250.0), None);
        let area = |f: &Found| f.mask(600, 500).area() as f64;
        assert!((area(&found) - 128.0 * 256.0).abs() < 400.0);
        found.crop.angle = 0.5;
        assert!((area(&found) - 128.0 * 256.0).abs() < 700.0);
    }
}
