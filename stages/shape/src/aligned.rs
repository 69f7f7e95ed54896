//! Photos made comparable: where each is in one common place, and how its levels are brought to one exposure.

use crate::{ByPhoto, Camera, Cameras, Image, PhotoId, Photos, Placed, Rgb};
use stage::{Artifact, Corrupt, Packer, Unpacker};

/// What each level of a picture is on another, by channel.
pub type Tones = [[u8; 256]; 3];

/// A picture with its levels changed.
pub fn toned(picture: &Rgb, tones: &Tones) -> Rgb {
    picture.map(|p| [0, 1, 2].map(|c| tones[c][p[c] as usize]))
}

/// Where a photo is in the common place, and its levels there.
#[derive(Debug, Clone, PartialEq)]
pub struct Alignment {
    /// Where it is.
    pub placed: Placed,
    /// What its levels are there; `None` where they stay.
    pub tones: Option<Tones>,
}

impl Alignment {
    /// A photo that is where and as it should be.
    pub const NONE: Alignment = Alignment {
        placed: Placed::SAME,
        tones: None,
    };

    /// The photo, brought there.
    pub fn brought(&self, photo: Rgb) -> Rgb {
        let photo = if self.placed.is_identity() {
            photo
        } else {
            self.placed.brought(&photo)
        };
        self.exposed(photo)
    }

    /// A photo that is there already, as it is exposed there.
    pub fn exposed(&self, photo: Rgb) -> Rgb {
        match &self.tones {
            Some(tones) => toned(&photo, tones),
            None => photo,
        }
    }

    /// Its camera, brought there.
    pub fn camera(&self, camera: &Camera) -> Camera {
        if self.placed.is_identity() {
            *camera
        } else {
            self.placed.brought_camera(camera)
        }
    }
}

/// The photos of a turn made comparable, with what all later steps ask of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Aligned {
    /// Place and levels of each photo; a photo that is not here is where and as it should be.
    pub views: ByPhoto<Alignment>,
    /// Photos are looked at with so many million pixels at most; all else here is in pixels of these.
    pub most_mpx: f64,
    /// The cameras, of the photos as they were taken.
    pub cameras: Option<Cameras>,
    /// Longest side of a reduced photo at most. \[px\]
    pub coarse_px: u32,
    /// A rectangle that holds the body on every photo, left, top, right, bottom; empty for none. \[px\]
    pub box_px: Vec<f64>,
}

impl Aligned {
    /// Place and levels of a photo.
    pub fn of(&self, id: PhotoId) -> &Alignment {
        self.views.get(id).unwrap_or(&Alignment::NONE)
    }

    /// The photos as they are looked at here.
    pub fn photos(&self, photos: &Photos) -> Photos {
        photos.within(self.most_mpx)
    }

    /// Its camera, as it was taken.
    pub fn taken(&self, id: PhotoId) -> Option<&Camera> {
        Some(&self.cameras.as_ref()?.views.get(id)?.camera)
    }

    /// Its camera, where all photos are aligned.
    pub fn camera(&self, id: PhotoId) -> Option<Camera> {
        self.taken(id).map(|camera| self.of(id).camera(camera))
    }

    /// The disk's radius, where it is known. \[mm\]
    pub fn disk_radius_mm(&self) -> Option<f64> {
        self.cameras.as_ref()?.disk_radius_mm
    }
}

/// The numbers of [`Placed`].
type Row = (u32, [f64; 5], bool);

impl Artifact for Aligned {
    const KIND: &'static str = "aligned";
    const FORMAT: u32 = 2;

    fn pack(&self, to: &mut Packer) {
        let row = |(id, view): (PhotoId, &Alignment)| -> Row {
            let Placed {
                shift: [x, y],
                roll,
                gain,
                bias,
            } = view.placed;
            (id.0, [x, y, roll, gain, bias], view.tones.is_some())
        };
        let rows: Vec<Row> = self.views.iter().map(row).collect();
        to.meta(&(
            rows,
            self.most_mpx,
            &self.cameras,
            self.coarse_px,
            &self.box_px,
        ));
        for (id, view) in self.views.iter() {
            if let Some(tones) = &view.tones {
                to.section(format!("tones {}", id.0), tones.as_flattened());
            }
        }
    }

    fn unpack(from: &Unpacker<'_>) -> Result<Self, Corrupt> {
        let (rows, most_mpx, cameras, coarse_px, box_px): (Vec<Row>, _, _, _, _) = from.meta()?;
        let view = |(id, [x, y, roll, gain, bias], toned): Row| {
            let placed = Placed {
                shift: [x, y],
                roll,
                gain,
                bias,
            };
            let tones = toned.then(|| tones(from, &format!("tones {id}")));
            let tones = tones.transpose()?;
            Ok((PhotoId(id), Alignment { placed, tones }))
        };
        Ok(Aligned {
            views: rows.into_iter().map(view).collect::<Result<_, Corrupt>>()?,
            most_mpx,
            cameras,
            coarse_px,
            box_px,
        })
    }
}

/// A section of tones.
pub(crate) fn tones(from: &Unpacker<'_>, section: &str) -> Result<Tones, Corrupt> {
    let levels: Vec<u8> = from.section(section)?;
    let (whole, rest) = levels.as_chunks::<256>();
    let tones: Tones = whole
        .try_into()
        .map_err(|_| Corrupt(format!("`{section}` is not three times 256 levels")))?;
    match rest {
        [] => Ok(tones),
        _ => Err(Corrupt(format!("`{section}` has levels too many"))),
    }
}

/// A picture from its size and its pixels.
pub(crate) fn picture<T>(
    [width, height]: [u32; 2],
    data: Vec<T>,
    what: &str,
) -> Result<Image<T>, Corrupt> {
    let (width, height) = (width as usize, height as usize);
    if width.checked_mul(height) != Some(data.len()) {
        return Err(Corrupt(format!("{what} does not fill its size")));
    }
    Ok(Image {
        width,
        height,
        data,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn alignments_come_back_and_a_photo_without_one_stays() {
        let mut tones = [[0; 256]; 3];
        tones[1][7] = 9;
        let moved = Alignment {
            placed: Placed {
                shift: [1.5, -2.0],
                roll: 0.01,
                gain: 1.1,
                bias: 3.0,
            },
            tones: Some(tones),
        };
        let aligned = Aligned {
            views: [(PhotoId(1), Alignment::NONE), (PhotoId(4), moved)]
                .into_iter()
                .collect(),
            most_mpx: 6.0,
            cameras: None,
            coarse_px: 800,
            box_px: vec![1.0, 2.0, 3.0, 4.0],
        };
        let bytes = stage::to_bytes(&aligned);
        assert_eq!(stage::from_bytes::<Aligned>(&bytes).unwrap(), aligned);
        assert_eq!(aligned.of(PhotoId(0)), &Alignment::NONE);
        let dark = aligned.of(PhotoId(4)).exposed(Rgb::filled(1, 1, [7; 3]));
        assert_eq!(dark.data, [[0, 9, 0]]);
    }
}
