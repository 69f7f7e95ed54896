//! What the photos show of a surface, and where they need not be read again: where it has hardly moved
//! since, what was read goes on by its slope and stiffness.

use crate::evidence::agreement::{Agreement, compared};
use crate::evidence::contours::{Pull, pulls};
use crate::evidence::outside::outside;
use crate::evidence::patch::{MOST_VIEWS, Window};
use crate::evidence::scene::{DEPTH_STEP_PX, Scene, VisibilityRules};
use crate::evidence::visibility::{Known, Visibility};
use crate::pictures::depth::DepthMap;
use crate::pictures::picture::Picture;
use crate::surface::params::OptimizeSurfaceParams;
use nalgebra::Vector3;
use rayon::prelude::*;
use shape::{Adjacency, Mesh};

/// A surface before its pictures, and how it is looked at.
pub(crate) struct Looker<'a> {
    /// The params.
    pub p: &'a OptimizeSurfaceParams,
    /// Neighbourhoods of the surface, whose faces stay.
    pub around: &'a Adjacency,
    /// The pictures.
    pub pictures: &'a [Picture],
    /// The patch.
    pub window: &'a Window,
    /// Which pictures are compared.
    pub rules: &'a VisibilityRules,
    /// What a pixel covers on the surface. \[mm\]
    pub footprint: f64,
}

/// What the photos show of a surface.
pub(crate) struct Sight {
    /// Where the vertices are. \[mm\]
    pub x: Vec<Vector3<f64>>,
    /// Their unit normals.
    pub normals: Vec<Vector3<f64>>,
    /// Who sees whom.
    pub visible: Visibility,
    /// How the pictures agree at each vertex, with derivatives.
    pub seen: Vec<Agreement>,
    /// How far out of where photos were read each vertex has come since. \[mm\]
    pub off: Vec<f64>,
    /// What silhouettes pull.
    pub pulls: Vec<Pull>,
    /// How far inward vertices have to go until they show inside of all silhouettes \[mm\]; may be empty.
    pub outside: Vec<f64>,
    /// Where photos were read, and what came of it.
    read: Vec<(Vector3<f64>, Agreement)>,
    /// How far inward vertices had to go there.
    read_outside: Vec<f64>,
    /// Depth maps, and where the vertices were when they were drawn.
    drawn: (Vec<DepthMap>, Vec<Vector3<f64>>),
}

/// How far inward vertices have to go once they have come `off` mm outward; those that had nowhere to go stay.
fn farther(outside: &[f64], off: &[f64]) -> Vec<f64> {
    let one = |(gap, off): (&f64, &f64)| match *gap > 0.0 {
        true => (gap + off).max(0.0),
        false => 0.0,
    };
    outside.iter().zip(off).map(one).collect()
}

impl Looker<'_> {
    /// A vertex that came less far since photos were read there counts as one that is at rest. \[mm\]
    pub(crate) fn near(&self) -> f64 {
        self.p.still_px * self.footprint
    }

    /// Looks at a surface; what an earlier look found at vertices at rest is kept.
    pub(crate) fn look(&self, mesh: &Mesh, before: Option<Sight>) -> Sight {
        let vertices = 0..mesh.positions.len() as u32;
        let x: Vec<_> = vertices.map(|v| mesh.point(v).coords).collect();
        let (before, drawn) = match before {
            Some(Sight {
                visible,
                read,
                read_outside,
                drawn,
                ..
            }) => (Some((visible, read, read_outside)), Some(drawn)),
            None => (None, None),
        };
        // Maps that were left behind go before new ones are drawn: they are as large as all photos.
        let drawn = drawn.filter(|(_, at)| !self.left_behind(&x, at));
        let (maps, drawn) = drawn.unwrap_or_else(|| (self.depths(mesh), x.clone()));
        let scene = Scene::drawn(
            mesh,
            self.around,
            self.pictures,
            maps,
            self.window,
            self.rules,
        );
        let still: Vec<Option<f64>> = match &before {
            Some((_, read, _)) => self.still(&x, &scene.normals, read),
            None => vec![None; x.len()],
        };
        let (visible, agreements) = self.read(&scene, |v| {
            let ((visible, read, _), _) = (before.as_ref()?, still[v]?);
            Some(Known {
                spacing: visible.frame(v).spacing,
                visible: visible.of(v),
                result: read[v].1,
            })
        });
        let outside = match self.p.hull_weight > 0.0 {
            true => outside(
                mesh,
                &scene.normals,
                self.pictures,
                self.p.slack_px,
                self.footprint,
                |v| still[v].and(Some(before.as_ref()?.2[v])),
            ),
            false => vec![],
        };
        let pulls = pulls(&scene, 3.0);
        let from = |v: usize| match (&before, still[v]) {
            (Some((_, read, _)), Some(_)) => read[v].0,
            _ => x[v],
        };
        let off: Vec<f64> = still.iter().map(|s| s.unwrap_or(0.0)).collect();
        Sight {
            seen: agreements
                .iter()
                .zip(&off)
                .map(|(a, o)| a.ahead(*o))
                .collect(),
            read: (0..x.len()).map(|v| (from(v), agreements[v])).collect(),
            outside: farther(&outside, &off),
            read_outside: outside,
            off,
            pulls,
            visible,
            normals: scene.normals,
            drawn: (scene.maps, drawn),
            x,
        }
    }

    /// Who sees whom, and how the pictures agree at each vertex, with derivatives.
    fn read<'a>(
        &self,
        scene: &Scene<'_>,
        known: impl Fn(usize) -> Option<Known<'a, Agreement>> + Sync,
    ) -> (Visibility, Vec<Agreement>) {
        let all = [true; MOST_VIEWS];
        Visibility::with(
            scene,
            known,
            |frame, _| [frame.normal],
            #[inline(always)]
            |_, visible, looks| {
                compared::<1>(visible, looks, &all, self.window.len(), self.rules.pairing)
            },
        )
    }

    /// The depth of the surface in every picture.
    fn depths(&self, mesh: &Mesh) -> Vec<DepthMap> {
        let draw = |picture| DepthMap::new(mesh, picture, DEPTH_STEP_PX);
        self.pictures.par_iter().map(draw).collect()
    }

    /// Whether more than one vertex of a hundred has left its pixel of the depth maps.
    fn left_behind(&self, x: &[Vector3<f64>], drawn: &[Vector3<f64>]) -> bool {
        let pixel = DEPTH_STEP_PX * self.footprint;
        let far = x
            .iter()
            .zip(drawn)
            .filter(|(x, d)| (*x - *d).norm() > pixel);
        far.count() * 100 > x.len()
    }

    /// How far out of where photos were read each vertex has come, of those at rest: no farther than
    /// [`Self::near`], half a pixel to a side, and no neighbour three times as far, so that its patch hardly
    /// tilts. \[mm\]
    fn still(
        &self,
        x: &[Vector3<f64>],
        normals: &[Vector3<f64>],
        read: &[(Vector3<f64>, Agreement)],
    ) -> Vec<Option<f64>> {
        let (near, side) = (self.near(), 0.5 * self.footprint);
        let out: Vec<f64> = (0..x.len())
            .map(|v| (x[v] - read[v].0).dot(&normals[v]))
            .collect();
        let one = |v: usize| {
            let across = (x[v] - read[v].0).norm_squared() - out[v] * out[v];
            let ring = self.around.vertices(v as u32);
            let rests = out[v].abs() <= near
                && across <= side * side
                && ring.iter().all(|j| out[*j as usize].abs() <= 3.0 * near);
            rests.then_some(out[v])
        };
        (0..x.len())
            .into_par_iter()
            .with_min_len(4096)
            .map(one)
            .collect()
    }
}
