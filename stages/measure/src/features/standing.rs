//! A body on its ground: what every level hangs on, or why there is none.

use crate::features::body::{Body, body};
use crate::features::ground::{GivenGround, Ground, LOST_SHARE, ground};
use crate::features::upright::unfit;
use shape::{Cameras, Mesh, Scale};
use stage::Message;

/// A body on its ground; without one above its lowest point.
pub(crate) struct Standing {
    /// The body.
    pub(crate) body: Body,
    /// What of it touches the ground.
    pub(crate) footing: Footing,
    /// What is odd about the ground.
    pub(crate) word: Option<Message>,
}

/// What of a body touches its ground.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Footing {
    /// Whether its surface reaches down to it, but for lost feet.
    pub(crate) reaches_ground: bool,
    /// Whether feet show on it.
    pub(crate) feet: bool,
}

/// The ground that cameras tell: of a mat or a disk, or taken at its word.
fn reported(cameras: &Cameras) -> GivenGround {
    let (firm, sigma_mm) = match cameras.scale {
        Scale::Given => (false, 0.0),
        Scale::Mat => (true, 2.0),
        _ => (true, 5.0),
    };
    GivenGround {
        height_mm: cameras.ground_mm,
        firm,
        sigma_mm,
        unit: cameras.scale.unit(),
    }
}

/// Puts a body on its ground. `None` if the surface is empty or is below it.
pub(crate) fn standing(mesh: &Mesh, cameras: Option<&Cameras>) -> Option<Standing> {
    let found = ground(mesh, cameras.map(reported).as_ref());
    let lowest = mesh.bounds()?.0.z;
    let mut body = body(mesh, found.as_ref().map_or(lowest, |g| g.height_mm))?;
    // Without legs that is reported, not that there are no feet.
    let nowhere = found.as_ref().err().filter(|_| body.crotch.is_some());
    // A surface from elsewhere is taken at its word.
    let scale = cameras.map_or(Some(0.0), |c| c.scale_sigma);
    let crown = 0.5 * mesh.mean_edge();
    let below = found.as_ref().map_or(0.0, |g| g.sigma_mm);
    let reaches = |g: &Ground| lowest - g.height_mm < LOST_SHARE * body.stature;
    let footing = Footing {
        reaches_ground: found.as_ref().is_ok_and(reaches),
        feet: found.as_ref().is_ok_and(|g| g.feet),
    };
    body.unit = cameras.map_or(mesh.unit, |c| c.scale.unit());
    body.carved = cameras.is_some();
    body.refused = unfit(mesh, &body).or(nowhere.copied());
    body.grounded = found.is_ok();
    body.stature_sigma = scale.map(|s| libm::hypot(libm::hypot(below, crown), s * body.stature));
    Some(Standing {
        word: found
            .ok()
            .filter(|_| body.refused.is_none())
            .and_then(|g| g.word),
        footing,
        body,
    })
}
