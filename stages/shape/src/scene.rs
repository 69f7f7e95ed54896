//! The scene without the body, with what of it is unknown.

use crate::aligned::{picture, tones};
use crate::runs::{from_sides, pixels, runs, sides};
use crate::{ByPhoto, Image, PhotoId, Rgb, Tones};
use stage::{Artifact, Corrupt, Hash, Packer, Unpacker};

/// A picture of the scene, and how sure it is.
#[derive(Debug, Clone, PartialEq)]
pub struct Seen {
    /// The colours; of no meaning where nothing shows them.
    pub image: Rgb,
    /// How many photos show each pixel without the body, 255 for more: 0 is *unknown*.
    pub shown_by: Image<u8>,
}

impl Seen {
    /// One photo that shows all of it.
    pub fn whole(image: Rgb) -> Self {
        let shown_by = Image::filled(image.width, image.height, 1);
        Seen { image, shown_by }
    }

    fn nothing() -> Self {
        Seen::whole(Rgb::filled(0, 0, [0; 3]))
    }
}

/// How the picture of the scene comes to what a photo would show of it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct InPhoto {
    /// What each level of the picture is on the photo; `None` where they are alike.
    pub tones: Option<Tones>,
    /// By how much the disk on the picture is turned against the photo; `None` where no disk is known. \[rad\]
    pub disk_turn: Option<f64>,
}

/// The scene without the body: what does not move, and the top of the disk, which turns.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// What does not move, at full size, where photos are aligned; without pixels where nothing is known.
    pub still: Seen,
    /// A map of the disk's top: the square around it in the turntable frame. `None` where `still` shows the disk, and
    /// where there is none.
    pub disk: Option<Seen>,
    /// How `still` comes to what each photo would show.
    pub views: ByPhoto<InPhoto>,
    /// The body on each reduced photo, true is body, where scene and body were found together.
    pub bodies: ByPhoto<Image<bool>>,
}

impl Scene {
    /// Nothing is known.
    pub fn unknown() -> Self {
        Scene {
            still: Seen::nothing(),
            disk: None,
            views: ByPhoto::default(),
            bodies: ByPhoto::default(),
        }
    }

    /// Hash of all that a photo's background follows from, but for the photo itself: for [`stage::Ctx::part`].
    pub fn content_for(&self, picture: Hash, id: PhotoId) -> Hash {
        let body = self.bodies.get(id);
        let body = body.map(|body| stage::hash(&sides(&body.data)));
        let text = format!("{picture} {:?} {body:?}", self.views.get(id));
        stage::hash(text.as_bytes())
    }

    /// Hash of what is the same for all photos.
    pub fn picture_content(&self) -> Hash {
        stage::content(&Scene {
            still: self.still.clone(),
            disk: self.disk.clone(),
            views: ByPhoto::default(),
            bodies: ByPhoto::default(),
        })
    }

    /// Whether nothing is known.
    pub fn is_unknown(&self) -> bool {
        self.still.image.data.is_empty()
    }
}

type Size = [u32; 2];

fn size<T>(image: &Image<T>) -> Size {
    [image.width as u32, image.height as u32]
}

/// Photo, has tones, the disk's turn.
type ViewRow = (u32, bool, Option<f64>);
/// Size of the still picture, side of the disk's map, views, bodies.
type Meta = (Size, Option<Size>, Vec<ViewRow>, Vec<(u32, Size)>);

impl Artifact for Scene {
    const KIND: &'static str = "scene";
    const FORMAT: u32 = 3;

    fn pack(&self, to: &mut Packer) {
        let views = self.views.iter();
        let views = views.map(|(id, v)| (id.0, v.tones.is_some(), v.disk_turn));
        let bodies = self.bodies.iter().map(|(id, body)| (id.0, size(body)));
        let meta: Meta = (
            size(&self.still.image),
            self.disk.as_ref().map(|disk| size(&disk.image)),
            views.collect(),
            bodies.collect(),
        );
        to.meta(&meta);
        for (name, seen) in [("still", Some(&self.still)), ("disk", self.disk.as_ref())] {
            if let Some(Seen { image, shown_by }) = seen {
                to.section(name, &image.data);
                to.section(format!("{name} shown by"), &runs(&shown_by.data));
            }
        }
        for (id, view) in self.views.iter() {
            if let Some(tones) = &view.tones {
                to.section(format!("tones {}", id.0), tones.as_flattened());
            }
        }
        for (id, body) in self.bodies.iter() {
            to.section(format!("body {}", id.0), &sides(&body.data));
        }
    }

    fn unpack(from: &Unpacker<'_>) -> Result<Self, Corrupt> {
        let (still, disk, views, bodies): Meta = from.meta()?;
        let view = |(id, toned, disk_turn): ViewRow| {
            let tones = toned.then(|| tones(from, &format!("tones {id}")));
            let tones = tones.transpose()?;
            Ok((PhotoId(id), InPhoto { tones, disk_turn }))
        };
        let body = |(id, size): (u32, Size)| {
            let body = from_sides(&from.section(&format!("body {id}"))?, count(&size))?;
            Ok((PhotoId(id), picture(size, body, "a body")?))
        };
        Ok(Scene {
            still: seen(from, "still", still)?,
            disk: disk.map(|side| seen(from, "disk", side)).transpose()?,
            views: views
                .into_iter()
                .map(view)
                .collect::<Result<_, Corrupt>>()?,
            bodies: bodies
                .into_iter()
                .map(body)
                .collect::<Result<_, Corrupt>>()?,
        })
    }
}

/// So many pixels or cells.
fn count(along: &[u32]) -> usize {
    let product = |so_far: usize, n: &u32| so_far.saturating_mul(*n as usize);
    along.iter().fold(1, product)
}

fn seen(from: &Unpacker<'_>, name: &str, size: Size) -> Result<Seen, Corrupt> {
    let shown_by = pixels(&from.section(&format!("{name} shown by"))?, count(&size))?;
    Ok(Seen {
        image: picture(size, from.section(name)?, name)?,
        shown_by: picture(size, shown_by, name)?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene() -> Scene {
        let mut still = Seen::whole(Rgb::filled(3, 2, [10, 20, 30]));
        still.shown_by.data[4] = 0;
        let body = Image {
            width: 2,
            height: 1,
            data: vec![true, false],
        };
        let view = InPhoto {
            tones: Some([[7; 256]; 3]),
            disk_turn: Some(0.25),
        };
        Scene {
            still,
            disk: Some(Seen::whole(Rgb::filled(2, 2, [1; 3]))),
            views: [(PhotoId(3), view)].into_iter().collect(),
            bodies: [(PhotoId(3), body)].into_iter().collect(),
        }
    }

    #[test]
    fn a_scene_comes_back_and_names_what_is_unknown() {
        let scene = scene();
        let bytes = stage::to_bytes(&scene);
        assert_eq!(stage::from_bytes::<Scene>(&bytes).unwrap(), scene);
        assert!(!scene.is_unknown());
        let unknown = Scene::unknown();
        let bytes = stage::to_bytes(&unknown);
        assert!(stage::from_bytes::<Scene>(&bytes).unwrap().is_unknown());
    }
}
