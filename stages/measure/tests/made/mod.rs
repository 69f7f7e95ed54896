//! Bodies given by formula, and what is measured on a surface.

use measure::{BodyInput, FindBody, FindLandmarks, GirthInput, LandmarkInput, Measure};
use shape::{BodyFeatures, Cameras, Girths, Landmarks, Mesh, Solid};
use stage::{Ctx, Stage};
use std::collections::HashMap;
use std::sync::{Arc, LazyLock, Mutex};
use synth::{Build, body_solid, bounds, surface};

/// Surfaces that a test has made, by what they are of: many ask for the same body.
static MADE: LazyLock<Mutex<HashMap<String, Mesh>>> = LazyLock::new(Mutex::default);

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
    let known = MADE.lock().unwrap().get(&of).cloned();
    known.unwrap_or_else(|| {
        let (low, high) = bounds(solid);
        let mesh = surface(solid, low, high, cell_mm);
        MADE.lock().unwrap().insert(of, mesh.clone());
        mesh
    })
}

/// What a surface shows of its body, on the ground of cameras if they are given.
pub(crate) fn features(mesh: &Arc<Mesh>, cameras: Option<&Arc<Cameras>>) -> Arc<BodyFeatures> {
    let input = BodyInput {
        mesh: mesh.clone(),
        cameras: cameras.cloned(),
        levels: None,
    };
    Arc::new(FindBody::run(&(), input, &Ctx::alone()).unwrap())
}

/// Landmarks and girths of a surface alone, without cameras and photos.
pub(crate) fn measured(mesh: Mesh) -> (Landmarks, Girths) {
    let mesh = Arc::new(mesh);
    let input = LandmarkInput {
        mesh: mesh.clone(),
        features: features(&mesh, None),
        levels: None,
    };
    let landmarks = FindLandmarks::run(&Default::default(), input, &Ctx::alone()).unwrap();
    let input = GirthInput {
        features: features(&mesh, None),
        mesh,
        landmarks: Arc::new(landmarks.clone()),
        cameras: None,
        photos: None,
        masks: None,
        person: None,
        lost_parts: None,
    };
    let girths = Measure::run(&Default::default(), input, &Ctx::alone()).unwrap();
    (landmarks, girths)
}
