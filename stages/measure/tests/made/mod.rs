//! Bodies given by formula, and what is measured on a surface.

use measure::{BodyInput, FindBody, FindLandmarks, GirthInput, GirthParams, LandmarkInput};
use measure::{LandmarkParams, Measure};
use shape::{BodyFeatures, Cameras, Girths, Landmarks, LostParts, Masks, Mesh, Person, Photos};
use shape::{Scale, Solid};
use stage::{Ctx, Hash, Host, Stage, Stop};
use std::collections::HashMap;
use std::sync::{Arc, LazyLock, Mutex, OnceLock};
use synth::{Build, body_solid, bounds, surface};

/// Surfaces that a test has made or is making, by what they are of: many ask for the same body.
static MADE: LazyLock<Mutex<HashMap<String, Arc<OnceLock<Mesh>>>>> = LazyLock::new(Mutex::default);

/// What was found and measured on surfaces alone, by what they are: many tests ask for the same.
static FOUND: LazyLock<Mutex<HashMap<Hash, Arc<Alone>>>> = LazyLock::new(Mutex::default);

/// What comes of a surface without cameras and photos.
#[derive(Default)]
struct Alone {
    features: OnceLock<Arc<BodyFeatures>>,
    measured: OnceLock<(Landmarks, Girths)>,
}

impl Alone {
    fn of(mesh: &Mesh) -> Arc<Alone> {
        let of = stage::content(mesh);
        FOUND.lock().unwrap().entry(of).or_default().clone()
    }
}

/// A standing body whose arms are so far from its sides.
pub(crate) fn built(stature: f64, stout: f64, arms_deg: f64) -> Solid {
    body_solid(&Build {
        stature,
        stout,
        furrow: 6.0,
        arms: arms_deg.to_radians(),
        exponent: 2.3,
    })
}

/// Its surface.
pub(crate) fn meshed(solid: &Solid, cell_mm: f64) -> Mesh {
    let of = format!("{solid:?} {cell_mm}");
    let made = MADE.lock().unwrap().entry(of).or_default().clone();
    let make = || {
        let (low, high) = bounds(solid);
        surface(solid, low, high, cell_mm)
    };
    made.get_or_init(make).clone()
}

/// Cameras without photos: what they know of the scale, and where their ground is.
pub(crate) fn cameras(scale: Scale, scale_sigma: Option<f64>, ground_mm: f64) -> Cameras {
    Cameras {
        views: std::iter::empty().collect(),
        scale,
        scale_sigma,
        disk_radius_mm: None,
        ground_mm,
        points: vec![],
    }
}

/// A surface, and what is given beside it; what was warned of.
#[derive(Default)]
pub(crate) struct Given {
    pub(crate) mesh: Arc<Mesh>,
    /// Those whose ground the body is on.
    pub(crate) on: Option<Arc<Cameras>>,
    pub(crate) cameras: Option<Arc<Cameras>>,
    pub(crate) photos: Option<Arc<Photos>>,
    pub(crate) masks: Option<Arc<Masks>>,
    pub(crate) person: Option<Arc<Person>>,
    pub(crate) lost_parts: Option<Arc<LostParts>>,
    pub(crate) warned: Heard,
    /// What is found on the surface, once it was asked for: landmarks and girths ask for the same.
    pub(crate) found: OnceLock<Arc<BodyFeatures>>,
}

/// What is warned of.
#[derive(Default)]
pub(crate) struct Heard(pub(crate) Mutex<Vec<String>>);

impl Host for Heard {
    fn warn(&self, text: &stage::Message) {
        self.0.lock().unwrap().push(text.to_string());
    }
}

impl Given {
    /// A surface alone.
    pub(crate) fn of(mesh: &Mesh) -> Given {
        Given {
            mesh: Arc::new(mesh.clone()),
            ..Given::default()
        }
    }

    /// The same on the ground of cameras, which are given for girths, too.
    pub(crate) fn on(mesh: &Mesh, cameras: Cameras) -> Given {
        let cameras = Some(Arc::new(cameras));
        Given {
            on: cameras.clone(),
            cameras,
            ..Given::of(mesh)
        }
    }

    pub(crate) fn features(&self) -> Arc<BodyFeatures> {
        let find = || {
            let input = BodyInput {
                mesh: self.mesh.clone(),
                cameras: self.on.clone(),
                levels: None,
            };
            Arc::new(FindBody::run(&(), input, &Ctx::alone()).unwrap())
        };
        let known = || match self.on {
            None => Alone::of(&self.mesh).features.get_or_init(find).clone(),
            Some(_) => find(),
        };
        self.found.get_or_init(known).clone()
    }

    /// Its landmarks, or why there are none at all.
    pub(crate) fn marked(&self, params: &LandmarkParams) -> Result<Landmarks, Stop> {
        let input = LandmarkInput {
            mesh: self.mesh.clone(),
            features: self.features(),
            levels: None,
        };
        let nothing = stage::hash(b"");
        FindLandmarks::run(params, input, &Ctx::new(&self.warned, nothing, nothing))
    }

    /// Its landmarks by default.
    pub(crate) fn landmarks(&self) -> Landmarks {
        self.marked(&LandmarkParams::default()).unwrap()
    }

    /// Its girths at landmarks.
    pub(crate) fn girths(&self, landmarks: &Landmarks, params: &GirthParams) -> Girths {
        let input = GirthInput {
            mesh: self.mesh.clone(),
            features: self.features(),
            landmarks: Arc::new(landmarks.clone()),
            cameras: self.cameras.clone(),
            photos: self.photos.clone(),
            masks: self.masks.clone(),
            person: self.person.clone(),
            lost_parts: self.lost_parts.clone(),
        };
        let nothing = stage::hash(b"");
        Measure::run(params, input, &Ctx::new(&self.warned, nothing, nothing)).unwrap()
    }

    /// Its girths, however wide their intervals: thighs of formulas are slenderer for their hips than people's.
    pub(crate) fn at_any_width(&self) -> Girths {
        let params = GirthParams {
            widest_pct: 100.0,
            ..GirthParams::default()
        };
        self.girths(&self.landmarks(), &params)
    }

    /// Landmarks and girths by default.
    pub(crate) fn measured(&self) -> (Landmarks, Girths) {
        let landmarks = self.landmarks();
        let girths = self.girths(&landmarks, &GirthParams::default());
        (landmarks, girths)
    }
}

/// Landmarks and girths of a surface alone, without cameras and photos.
pub(crate) fn measured(mesh: Mesh) -> (Landmarks, Girths) {
    let alone = Alone::of(&mesh);
    let measured = alone.measured.get_or_init(|| Given::of(&mesh).measured());
    measured.clone()
}
