//! Small surfaces as strangers hand them over: bodies, parts of bodies, and what is none.

use shape::{Level, Mesh, Solid, SolidPart};
use synth::{Build, body_solid, bounds, surface};

/// Edge of the cells that surfaces are made of. \[mm\]
const CELL: f64 = 12.0;

pub(crate) fn meshed(solid: &Solid) -> Mesh {
    let (low, high) = bounds(solid);
    surface(solid, low, high, CELL)
}

/// A standing body, 170 cm tall, its arms away from it.
pub(crate) fn body() -> Solid {
    body_solid(&Build {
        stature: 1700.0,
        stout: 1.0,
        furrow: 6.0,
        arms: 30f64.to_radians(),
        exponent: 2.3,
    })
}

/// The same body with one arm alone.
pub(crate) fn one_arm() -> Mesh {
    let mut solid = body();
    solid.parts.retain(|part| match part {
        SolidPart::Limb { to, .. } => to[0] < 200.0,
        SolidPart::Ellipsoid { centre, .. } => centre[0] < 200.0,
        _ => true,
    });
    meshed(&solid)
}

fn limb(from: [f64; 3], to: [f64; 3], half: [f64; 2]) -> SolidPart {
    SolidPart::Limb {
        from,
        to,
        half_from: half,
        half_to: half,
        round: half[0] / 2.0,
    }
}

/// A block between two corners, its edges rounded.
fn block(low: [f64; 3], high: [f64; 3]) -> SolidPart {
    let middle = |k: usize| (low[k] + high[k]) / 2.0;
    let half = |k: usize| (high[k] - low[k]) / 2.0;
    let level = |z: f64| Level {
        z,
        centre: [middle(0), middle(1)],
        half: [half(0), half(1)],
    };
    SolidPart::Stack {
        levels: vec![level(low[2]), level(high[2])],
        exponent: 8.0,
        furrow: None,
        round: 8.0,
    }
}

fn joined(parts: Vec<SolidPart>) -> Solid {
    Solid {
        parts,
        blend_mm: 16.0,
        planes: vec![],
    }
}

/// Four legs and a seat; with a back it is a chair.
pub(crate) fn seat(back: bool) -> Mesh {
    let mut parts = vec![block([-220.0, -220.0, 430.0], [220.0, 220.0, 475.0])];
    for (x, y) in [
        (190.0, 190.0),
        (190.0, -190.0),
        (-190.0, 190.0),
        (-190.0, -190.0),
    ] {
        parts.push(limb([x, y, 450.0], [x, y, 15.0], [24.0; 2]));
    }
    if back {
        parts.push(block([-220.0, 190.0, 440.0], [220.0, 225.0, 950.0]));
    }
    meshed(&joined(parts))
}

/// A large dog, its head to -y.
pub(crate) fn dog() -> Mesh {
    let mut parts = vec![
        limb([0.0, -330.0, 600.0], [0.0, 330.0, 620.0], [120.0, 150.0]),
        limb([0.0, -330.0, 640.0], [0.0, -520.0, 850.0], [75.0; 2]),
        SolidPart::Ellipsoid {
            centre: [0.0, -580.0, 900.0],
            half: [80.0, 150.0, 80.0],
        },
        limb([0.0, 330.0, 650.0], [0.0, 620.0, 560.0], [24.0; 2]),
    ];
    for (x, y) in [
        (80.0, -290.0),
        (-80.0, -290.0),
        (80.0, 300.0),
        (-80.0, 300.0),
    ] {
        parts.push(limb([x, y, 560.0], [x, y, 25.0], [42.0; 2]));
        parts.push(SolidPart::Ellipsoid {
            centre: [x, y - 30.0, 25.0],
            half: [40.0, 70.0, 25.0],
        });
    }
    meshed(&joined(parts))
}

/// A ball, or a bottle.
pub(crate) fn ball(half: [f64; 3]) -> Mesh {
    let centre = [0.0, 0.0, half[2]];
    meshed(&joined(vec![SolidPart::Ellipsoid { centre, half }]))
}

/// Two people who hold hands: one piece.
pub(crate) fn pair() -> Mesh {
    let mut both = body();
    let mut other = body();
    let reach = both.parts.iter().filter_map(|p| match p {
        SolidPart::Limb { to, .. } => Some(to[0]),
        _ => None,
    });
    let away = 2.0 * reach.fold(0.0, f64::max);
    other.parts.iter_mut().for_each(|part| moved(part, away));
    both.parts.extend(other.parts);
    meshed(&both)
}

fn moved(part: &mut SolidPart, by: f64) {
    match part {
        SolidPart::Ellipsoid { centre, .. } | SolidPart::Torus { centre, .. } => centre[0] += by,
        SolidPart::Limb { from, to, .. } => {
            from[0] += by;
            to[0] += by;
        }
        SolidPart::Stack { levels, .. } => levels.iter_mut().for_each(|l| l.centre[0] += by),
    }
}

/// What of a surface is on one side of a plane across an axis, the rest pressed flat onto it.
pub(crate) fn half(mesh: &Mesh, axis: usize, at: f32, above: bool) -> Mesh {
    let press = |x: f32| if above { x.max(at) } else { x.min(at) };
    let mut half = mesh.clone();
    half.positions
        .iter_mut()
        .for_each(|p| p[axis] = press(p[axis]));
    half
}

/// The same without the rest: open.
pub(crate) fn open_half(mesh: &Mesh, axis: usize, at: f32, above: bool) -> Mesh {
    let inside = |v: &u32| (mesh.positions[*v as usize][axis] > at) == above;
    let faces: Vec<[u32; 3]> = mesh
        .faces
        .iter()
        .copied()
        .filter(|f| f.iter().all(&inside))
        .collect();
    Mesh::packed(&mesh.positions, &faces)
}

/// Several surfaces in one file.
pub(crate) fn together(all: &[Mesh]) -> Mesh {
    let mut both = Mesh::default();
    for mesh in all {
        let first = both.positions.len() as u32;
        both.positions.extend(&mesh.positions);
        both.faces
            .extend(mesh.faces.iter().map(|f| f.map(|v| v + first)));
    }
    both
}

pub(crate) fn changed(mesh: &Mesh, to: impl Fn([f32; 3]) -> [f32; 3]) -> Mesh {
    let mut changed = mesh.clone();
    changed.positions.iter_mut().for_each(|p| *p = to(*p));
    changed
}
