//! A surface before its pictures, and the rules by which they are compared on it.

use crate::evidence::patch::{Pairing, Window};
use crate::pictures::depth::DepthMap;
use crate::pictures::picture::Picture;
use nalgebra::Vector3;
use rayon::prelude::*;
use shape::{Adjacency, Mesh};

/// What decides whether a picture is compared at a vertex.
#[derive(Debug, Clone, Copy)]
pub struct VisibilityRules {
    /// Greatest angle between the normal and the line of sight. \[rad\]
    pub most_tilt: f64,
    /// Distance of a patch's points in pixels of the nearest picture. \[px\]
    pub spacing_px: f64,
    /// Which pictures are compared with each other.
    pub pairing: Pairing,
    /// Brightness varies at least this many times as much as noise does before it counts in full.
    pub noise_gain: f64,
}

impl VisibilityRules {
    /// A patch's points a pixel apart; the greatest tilt in degrees.
    pub fn new(tilt_deg: f64, pairing: Pairing, noise_gain: f64) -> Self {
        VisibilityRules {
            most_tilt: tilt_deg.to_radians(),
            spacing_px: 1.0,
            pairing,
            noise_gain,
        }
    }
}

/// Pixels of a picture for one of its depth map (structural: samples). \[px\]
pub const DEPTH_STEP_PX: f64 = 2.0;

/// A surface before its pictures.
pub struct Scene<'a> {
    /// The surface.
    pub mesh: &'a Mesh,
    /// Its neighbourhoods.
    pub around: &'a Adjacency,
    /// Unit normals, one a vertex.
    pub normals: Vec<Vector3<f64>>,
    /// The pictures.
    pub pictures: &'a [Picture],
    /// How far the surface is, seen from each picture.
    pub maps: Vec<DepthMap>,
    /// The patch.
    pub window: &'a Window,
    /// Which pictures are compared.
    pub rules: &'a VisibilityRules,
}

impl<'a> Scene<'a> {
    /// Draws the surface's depth in every picture.
    pub fn new(
        mesh: &'a Mesh,
        around: &'a Adjacency,
        pictures: &'a [Picture],
        window: &'a Window,
        rules: &'a VisibilityRules,
    ) -> Self {
        let map = |p| DepthMap::new(mesh, p, DEPTH_STEP_PX);
        let maps = pictures.par_iter().map(map).collect();
        Self::drawn(mesh, around, pictures, maps, window, rules)
    }

    /// With depth maps that were drawn before.
    pub fn drawn(
        mesh: &'a Mesh,
        around: &'a Adjacency,
        pictures: &'a [Picture],
        maps: Vec<DepthMap>,
        window: &'a Window,
        rules: &'a VisibilityRules,
    ) -> Self {
        Scene {
            mesh,
            around,
            normals: mesh.normals_among(around),
            pictures,
            maps,
            window,
            rules,
        }
    }
}
