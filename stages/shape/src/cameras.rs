//! The calibrated cameras of a turn, in the turntable frame, and how far to trust them.

use crate::{ByPhoto, Camera, PhotoId, Unit};
use serde::{Deserialize, Serialize};
use stage::{Artifact, Corrupt, Packer, Template, Unpacker};

stage::messages! {
    MAT = "length-mat": "the mat";
    TAGS = "length-tags": "the marker tags";
    REFERENCE = "length-reference": "the reference length";
    DISK = "length-disk": "the disk's diameter";
    STATURE = "length-stature": "the stature";
}

/// Where the millimetres come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Scale {
    /// A marker mat of known size.
    Mat,
    /// A reference length that the user gave.
    Reference,
    /// The disk's diameter.
    Disk,
    /// The subject's stature.
    Stature,
    /// Cameras that came from elsewhere, taken at their word.
    Given,
    /// Nothing: lengths are relative to the camera ring's radius, called 1000 mm.
    Nothing,
    /// Marker tags of known size, in cameras that were found without them. Results are written with its place.
    Tags,
    /// Known lengths that contradict each other: relative as with nothing. Last: results are written with its place.
    Disputed([Length; 2]),
}

/// A known length that cameras are brought to millimetres by.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Length {
    /// A marker mat.
    Mat,
    /// Marker tags.
    Tags,
    /// A reference length.
    Reference,
    /// The disk's diameter.
    Disk,
    /// The subject's stature.
    Stature,
}

impl Length {
    /// The reference, where that is what the scale would come from.
    #[must_use]
    pub fn or_reference(self, scale: Scale) -> Length {
        match scale {
            Scale::Reference => Length::Reference,
            _ => self,
        }
    }

    /// What messages call it.
    pub fn word(self) -> &'static str {
        self.template().english
    }

    /// The same with its code.
    pub fn template(self) -> Template {
        match self {
            Length::Mat => MAT,
            Length::Tags => TAGS,
            Length::Reference => REFERENCE,
            Length::Disk => DISK,
            Length::Stature => STATURE,
        }
    }
}

impl Scale {
    /// Its word in files.
    pub fn word(self) -> &'static str {
        match self {
            Scale::Mat => "mat",
            Scale::Reference => "reference",
            Scale::Disk => "disk",
            Scale::Stature => "stature",
            Scale::Given => "given",
            Scale::Nothing => "nothing",
            Scale::Tags => "tags",
            Scale::Disputed(_) => "disputed",
        }
    }

    /// What lengths are in.
    pub fn unit(self) -> Unit {
        match self {
            Scale::Nothing | Scale::Disputed(_) => Unit::Relative,
            _ => Unit::Metric,
        }
    }
}

/// One photo's camera.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct View {
    /// The photo's file name.
    pub name: String,
    /// The camera, world = turntable frame.
    pub camera: Camera,
    /// Standard deviation of the camera's centre, by bundle adjustment; `None` where unknown. \[mm\]
    pub sigma_mm: Option<f64>,
    /// Root mean square of its reprojection errors; `None` where unknown. \[px\]
    pub rms_px: Option<f64>,
    /// How many points hold it.
    pub points: u32,
}

/// Calibrated cameras.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Cameras {
    /// The photos that have a camera.
    pub views: ByPhoto<View>,
    /// Where the millimetres come from.
    pub scale: Scale,
    /// Relative standard deviation of the scale; `None` where unknown.
    pub scale_sigma: Option<f64>,
    /// The disk's radius, where it is known. \[mm\]
    pub disk_radius_mm: Option<f64>,
    /// Height of the ground under the subject, in the turntable frame. \[mm\]
    pub ground_mm: f64,
    /// Points of the body and disk in the world, three numbers each. \[mm\] May be empty.
    pub points: Vec<[f32; 3]>,
}

impl View {
    /// A camera of which nothing else is known.
    pub fn of(name: impl Into<String>, camera: Camera) -> View {
        View {
            name: name.into(),
            camera,
            sigma_mm: None,
            rms_px: None,
            points: 0,
        }
    }
}

impl Cameras {
    /// Cameras of a scale, with the ground at 0, of which nothing else is known.
    pub fn of(views: impl IntoIterator<Item = (PhotoId, View)>, scale: Scale) -> Cameras {
        Cameras {
            views: views.into_iter().collect(),
            scale,
            scale_sigma: None,
            disk_radius_mm: None,
            ground_mm: 0.0,
            points: vec![],
        }
    }
}

impl Artifact for Cameras {
    const KIND: &'static str = "cameras";
    const FORMAT: u32 = 2;

    fn pack(&self, to: &mut Packer) {
        let Cameras {
            views,
            scale,
            scale_sigma,
            disk_radius_mm,
            ground_mm,
            points,
        } = self;
        to.meta(&(views, scale, scale_sigma, disk_radius_mm, ground_mm));
        to.section("points", points);
    }

    fn unpack(from: &Unpacker<'_>) -> Result<Self, Corrupt> {
        let (views, scale, scale_sigma, disk_radius_mm, ground_mm) = from.meta()?;
        let points = from.section("points")?;
        Ok(Cameras {
            views,
            scale,
            scale_sigma,
            disk_radius_mm,
            ground_mm,
            points,
        })
    }
}
