//! The photos of a turn, as the files they came in: decoded when somebody looks.
//!
//! Eighteen photos of 24 megapixels are 1.3 GB of pixels and 80 MB of files; a stage decodes
//! the photo it works on and lets it go.

use crate::resize::MAX_KEPT_BYTES;
use crate::{PhotoFile, PhotoId, Rgb, Rig, within};
use serde::{Deserialize, Serialize};
use stage::{Artifact, Coded, Corrupt, Hash, Message, Packer, Unpacker, message};
use std::sync::Arc;

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

    /// The same photo, looked at with so many million pixels at most.
    pub fn within(&self, most_mpx: f64) -> Photo {
        let size = [self.width, self.height];
        let [width, height] = within(size, most_mpx);
        let mut photo = Photo {
            width,
            height,
            ..self.clone()
        };
        if size != [width, height] {
            photo.file.larger = Some(photo.file.larger.unwrap_or(size));
        }
        photo
    }

    /// The pixels, upright; of a photo that is looked at smaller, means of them. Those of [`Photos::within`] are kept
    /// beside the file for who looks next, until something else is, but for too many.
    ///
    /// # Errors
    ///
    /// The file cannot be decoded, or is of another size than named.
    pub fn decode(&self) -> Result<Rgb, PhotoError> {
        if self.file.larger.is_none() {
            return self.decode_file();
        }
        let (width, height) = (self.width as usize, self.height as usize);
        let by = stage::hash(format!("{width} {height}").as_bytes());
        if let Some(small) = self.file.kept::<Rgb>(by) {
            return Ok(Rgb::clone(&small));
        }
        let small = self.decode_file()?.shrunk(width, height);
        if self.file.keeps {
            self.file.keep(by, &Arc::new(small.clone()));
        }
        Ok(small)
    }

    /// All pixels of the file, upright.
    fn decode_file(&self) -> Result<Rgb, PhotoError> {
        let error = |why: String| PhotoError {
            name: self.name.clone(),
            why,
        };
        let mut image = image::load_from_memory(&self.file).map_err(|e| error(e.to_string()))?;
        let turn = image::metadata::Orientation::from_exif(self.orientation);
        image.apply_orientation(turn.unwrap_or(image::metadata::Orientation::NoTransforms));
        let rgb = image.into_rgb8();
        let size = [rgb.width(), rgb.height()];
        if size != self.file.larger.unwrap_or([self.width, self.height]) {
            return Err(error(format!("it is {}×{} pixels", size[0], size[1])));
        }
        Ok(Rgb {
            width: size[0] as usize,
            height: size[1] as usize,
            data: bytemuck::cast_vec(rgb.into_raw()),
        })
    }

    /// Hash of all that [`decode`](Self::decode) depends on: for [`stage::Ctx::part`].
    pub fn content(&self) -> Hash {
        let mut bytes = vec![self.orientation];
        bytes.extend_from_slice(stage::hash(&self.file).as_bytes());
        if self.file.larger.is_some() {
            bytes.extend(
                [self.width, self.height]
                    .map(u32::to_le_bytes)
                    .as_flattened(),
            );
        }
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

    /// The same photos, each looked at with so many million pixels at most.
    pub fn within(&self, most_mpx: f64) -> Photos {
        let mut photos: Vec<Photo> = self.photos.iter().map(|p| p.within(most_mpx)).collect();
        let bytes = |photo: &Photo| 3 * u64::from(photo.width) * u64::from(photo.height);
        let keeps = photos.iter().map(bytes).sum::<u64>() <= MAX_KEPT_BYTES;
        photos.iter_mut().for_each(|photo| photo.file.keeps = keeps);
        Photos {
            photos,
            plate: self.plate.as_ref().map(|p| p.within(most_mpx)),
            rig: self.rig.clone(),
        }
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
            size: p.file.larger.unwrap_or([p.width, p.height]),
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rgb_to_png;

    #[test]
    fn a_photo_that_is_looked_at_smaller_is_stored_as_it_was_taken() {
        let pixels = Rgb {
            width: 6,
            height: 4,
            data: (0..24).map(|i| [i * 10, 7, 0]).collect(),
        };
        let whole = Photo::of("a.png", [6, 4], rgb_to_png(&pixels));
        assert_eq!(whole.within(1.0), whole, "it has no more");
        let photos = Photos {
            photos: vec![whole.clone()],
            ..Photos::default()
        };
        let small = &photos.within(6e-6).photos[0];
        assert_eq!([small.width, small.height], [3, 2]);
        for _ in 0..2 {
            assert_eq!(small.decode().unwrap(), pixels.shrunk(3, 2), "and again");
        }
        assert_ne!(small.content(), whole.content());
        let bytes = stage::to_bytes(&photos.within(6e-6));
        assert_eq!(stage::from_bytes::<Photos>(&bytes).unwrap(), photos);
    }
}
