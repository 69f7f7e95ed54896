//! The neck, between head and shoulders: what a surface shows of it.

use crate::features::body::Body;
use crate::features::neck_tube::{Tube, tube};
use crate::features::throat::{NeckProfile, throat};
use shape::Mesh;

/// What tells where the girth of a neck is taken, and the surface that it is taken on.
///
/// Offsets are along the neck's axis from its tightest section, upward, in front; as shares of the neck's
/// mean diameter there (its tape by π), so that an infant's neck means the same as a man's.
#[derive(Debug, Clone)]
pub struct NeckFeatures {
    pub(crate) tube: Tube,
    pub(crate) throat: NeckProfile,
    /// Crown above the middle of the tightest section. \[mm\]
    pub(crate) head: f64,
}

impl NeckFeatures {
    /// The mean diameter at the tightest section, which lengths are shares of. \[mm\]
    pub fn diameter_mm(&self) -> f64 {
        self.tube.diameter()
    }

    /// The tightest tape across the axis. \[mm\]
    pub fn girth_mm(&self) -> f64 {
        self.tube.girth
    }

    /// How far forward the neck's axis leans. \[rad\]
    pub fn lean_rad(&self) -> f64 {
        self.tube.lean
    }

    /// The middle of the tightest section. \[mm\]
    pub fn origin_mm(&self) -> [f64; 3] {
        self.tube.origin.into()
    }

    /// The neck's axis: unit, upward.
    pub fn axis(&self) -> [f64; 3] {
        self.tube.axis().into()
    }

    /// The way the body faces: horizontal, unit.
    pub fn front(&self) -> [f64; 3] {
        self.tube.front.into()
    }

    /// The tape across the axis at an offset along it. \[mm\] `None` where no section goes around the
    /// axis.
    pub fn tape_mm(&self, offset_mm: f64) -> Option<f64> {
        self.tube.ring(offset_mm).map(|ring| ring.tape)
    }

    /// Names of [`NeckFeatures::values`].
    ///
    /// - `up`, `low`: offsets at which the tape is a tenth longer than the tightest; shares of the diameter.
    /// - `hollow`, `hollow_depth`: the deepest of the throat within the line from chin to chest, and how
    ///   deep; shares of the diameter.
    /// - `angle`, `angle_depth`: where the throat turns forward to the floor of the mouth, and how far that
    ///   is within the line from hollow to chin; shares of the diameter.
    /// - `nape`: the deepest of the nape; share of the diameter.
    /// - `lean`: how far forward the axis leans, radians.
    /// - `head`: crown above the tightest section; share of the diameter.
    pub const NAMES: [&'static str; 9] = [
        "up",
        "low",
        "hollow",
        "hollow_depth",
        "angle",
        "angle_depth",
        "nape",
        "lean",
        "head",
    ];

    /// What the neck shows, in the order of [`NeckFeatures::NAMES`].
    pub fn values(&self) -> [f64; 9] {
        let d = self.tube.diameter();
        [
            self.tube.ends.0 / d,
            self.tube.ends.1 / d,
            self.throat.hollow.0 / d,
            self.throat.hollow.1 / d,
            self.throat.angle.0 / d,
            self.throat.angle.1 / d,
            self.throat.nape / d,
            self.tube.lean,
            self.head / d,
        ]
    }

    /// One of [`NeckFeatures::NAMES`]. `None` for a name that there is not.
    pub fn get(&self, name: &str) -> Option<f64> {
        let at = NeckFeatures::NAMES.iter().position(|n| *n == name)?;
        Some(self.values()[at])
    }
}

/// A throat less deep than this, as a share of the diameter, is none: hair, a hood or a collar fills it. By hand:
/// looked at on made bodies, of which the least is 0.35.
const LEAST_DEPTH: f64 = 0.2;

/// Reads the neck. `None` without a tube that is narrower than head and shoulders, or without a throat
/// under a chin.
pub fn neck_features(mesh: &Mesh, body: &Body) -> Option<NeckFeatures> {
    let crown = body.ground + body.stature;
    let narrowest = body.trunk(body.neck?)?;
    let tube = tube(mesh, narrowest, body.front, crown)?;
    let throat = throat(&tube)?;
    let deep = throat.hollow.1 >= LEAST_DEPTH * tube.diameter();
    deep.then(|| NeckFeatures {
        head: crown - tube.origin.z,
        tube,
        throat,
    })
}
