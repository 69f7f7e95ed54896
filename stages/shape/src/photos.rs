//! The photos of a turn, as the files they came in: decoded when somebody looks.
//!
//! Eighteen photos of 24 megapixels are 1.3 GB of pixels and 80 MB of files; a stage decodes
//! the photo it works on and lets it go.

use crate::{PhotoFile, PhotoId, Rgb, Rig};
use serde::{Deserialize, Serialize};
use stage::{Artifact, Coded, Corrupt, Hash, Message, Packer, Unpacker, message};

/// Fewer photos are no turn: one every 45°. By hand: not on record.
pub const LEAST_OF_TURN: usize = 8;

/// One photo.
#[derive(Debug, Clone, PartialEq)]
pub struct Photo {
    /// Its file name, without folders.
    pub name: String,
    /// Width, upright. \[px\]
    pub width: u32,
    /// Height, upright. \[px\]
    pub height: u32,
    /// EXIF orientation, 1..=8: how to turn the decoded pixels upright.
    pub orientation: u8,
    /// Focal length as if taken on 36 × 24 mm film, from EXIF. \[mm\]
    pub focal_35mm: Option<f64>,
    /// Camera and lens, from EXIF; empty where unknown.
    pub device: String,
    /// When it was taken, from EXIF, seconds since the first photo. \[s\]
    pub time_s: Option<f64>,
    /// The file.
    pub file: PhotoFile,
}

stage::messages! {
    NOT_DECODED = "fail-not-decoded": "{name} cannot be decoded: {why}; export it again as JPEG, PNG or TIFF";
}

/// A photo that cannot be decoded.
#[derive(Debug)]
pub struct PhotoError {
    /// Its file name.
    pub name: String,
    /// The decoder's message.
    pub why: String,
}

impl Coded for PhotoError {
    fn message(&self) -> Message {
        message!(NOT_DECODED, name = &self.name, why = &self.why)
    }
}

impl std::fmt::Display for PhotoError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.message())
    }
}

impl std::error::Error for PhotoError {}

impl Photo {
    /// A file of pixels that are upright, of which nothing else is known; its width and height. \[px\]
    pub fn of(
        name: impl Into<String>,
        [width, height]: [u32; 2],
        file: impl Into<PhotoFile>,
    ) -> Photo {
        Photo {
            name: name.into(),
            width,
            height,
            orientation: 1,
            focal_35mm: None,
            device: String::new(),
            time_s: None,
            file: file.into(),
        }
    }

    /// The pixels, upright.
    ///
    /// # Errors
    ///
    /// The file cannot be decoded, or is of another size than named.
    pub fn decode(&self) -> Result<Rgb, PhotoError> {
        let error = |why: String| PhotoError {
            name: self.name.clone(),
            why,
        };
        let mut image = image::load_from_memory(&self.file).map_err(|e| error(e.to_string()))?;
        let turn = image::metadata::Orientation::from_exif(self.orientation);
        image.apply_orientation(turn.unwrap_or(image::metadata::Orientation::NoTransforms));
        let rgb = image.into_rgb8();
        if rgb.dimensions() != (self.width, self.height) {
            return Err(error(format!(
                "it is {}×{} pixels",
                rgb.width(),
                rgb.height()
            )));
        }
        let (width, height) = (self.width as usize, self.height as usize);
        Ok(Rgb {
            width,
            height,
            data: bytemuck::cast_vec(rgb.into_raw()),
        })
    }

    /// Hash of all that [`decode`](Self::decode) depends on: for [`stage::Ctx::part`].
    pub fn content(&self) -> Hash {
        let mut bytes = vec![self.orientation];
        bytes.extend_from_slice(stage::hash(&self.file).as_bytes());
        stage::hash(&bytes)
    }
}

/// The photos of one turn, in turning order, all upright and of one size.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Photos {
    /// In turning order; a photo's place is its [`PhotoId`].
    pub photos: Vec<Photo>,
    /// The same scene without the subject.
    pub plate: Option<Photo>,
    /// What the user knows of the capture.
    pub rig: Rig,
}

impl Photos {
    /// The photos with their ids.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (PhotoId, &Photo)> + Clone {
        self.photos
            .iter()
            .enumerate()
            .map(|(i, photo)| (PhotoId(i as u32), photo))
    }

    /// The photo.
    pub fn get(&self, id: PhotoId) -> Option<&Photo> {
        self.photos.get(id.0 as usize)
    }

    /// The pixels of the largest photo; 0 without any.
    pub fn most_pixels(&self) -> u64 {
        let pixels = |photo: &Photo| u64::from(photo.width) * u64::from(photo.height);
        self.photos.iter().map(pixels).max().unwrap_or(0)
    }
}

#[derive(Serialize, Deserialize)]
struct Meta {
    name: String,
    size: [u32; 2],
    orientation: u8,
    focal_35mm: Option<f64>,
    device: String,
    time_s: Option<f64>,
}

impl Artifact for Photos {
    const KIND: &'static str = "photos";
    const FORMAT: u32 = 7;

    fn pack(&self, to: &mut Packer) {
        let meta = |p: &Photo| Meta {
            name: p.name.clone(),
            size: [p.width, p.height],
            orientation: p.orientation,
            focal_35mm: p.focal_35mm,
            device: p.device.clone(),
            time_s: p.time_s,
        };
        let photos: Vec<_> = self.photos.iter().map(meta).collect();
        to.meta(&(photos, self.plate.as_ref().map(meta), &self.rig));
        for (i, photo) in self.photos.iter().enumerate() {
            to.section(format!("photo {i}"), &photo.file);
        }
        if let Some(plate) = &self.plate {
            to.section("plate", &plate.file);
        }
    }

    fn unpack(from: &Unpacker<'_>) -> Result<Self, Corrupt> {
        let (photos, plate, rig): (Vec<Meta>, Option<Meta>, Rig) = from.meta()?;
        let photo = |m: Meta, section: &str| -> Result<Photo, Corrupt> {
            Ok(Photo {
                name: m.name,
                width: m.size[0],
                height: m.size[1],
                orientation: m.orientation,
                focal_35mm: m.focal_35mm,
                device: m.device,
                time_s: m.time_s,
                file: from.section::<u8>(section)?.into(),
            })
        };
        let numbered = photos.into_iter().enumerate();
        let photos = numbered
            .map(|(i, m)| photo(m, &format!("photo {i}")))
            .collect::<Result<_, _>>()?;
        Ok(Photos {
            photos,
            plate: plate.map(|m| photo(m, "plate")).transpose()?,
            rig,
        })
    }
}
