//! The formula of a body: which ellipses and cones it is made of.

use nalgebra::Vector3;
use shape::{Furrow, Level, Solid, SolidPart};

/// What of a body may differ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Build {
    /// Crown above the ground. \[mm\]
    pub stature: f64,
    /// Girth of trunk and limbs, as a share of the usual.
    pub stout: f64,
    /// Depth of the furrow down the back. \[mm\]
    pub furrow: f64,
    /// Angle between arms and trunk. \[rad\]
    pub arms: f64,
    /// Exponent of the trunk's superellipses.
    pub exponent: f64,
}

/// The stature for which the numbers below are written (structural: the unit of what follows). \[mm\]
const STATURE: f64 = 1750.0;

/// A body with its soles on z = 0, which faces -y and has its left at +x. Its planes: WC, HC, CC and NC,
/// upper arms AC, thighs TC and calves CFC with `_L` and `_R`.
pub fn body(build: &Build) -> Solid {
    let s = build.stature / STATURE;
    let w = s * build.stout;
    let level = |z: f64, centre: [f64; 2], half: [f64; 2]| Level {
        z: z * s,
        centre: centre.map(|c| c * s),
        half: half.map(|h| h * w),
    };
    let trunk = vec![
        level(775.0, [0.0, 6.0], [142.0, 88.0]),
        level(820.0, [0.0, 10.0], [166.0, 108.0]),
        level(880.0, [0.0, 14.0], [172.0, 118.0]),
        level(960.0, [0.0, 8.0], [158.0, 108.0]),
        level(1060.0, [0.0, 0.0], [136.0, 98.0]),
        level(1170.0, [0.0, -2.0], [144.0, 104.0]),
        level(1280.0, [0.0, -2.0], [154.0, 112.0]),
        level(1370.0, [0.0, 4.0], [152.0, 98.0]),
        level(1440.0, [0.0, 8.0], [124.0, 76.0]),
        level(1492.0, [0.0, 8.0], [72.0, 60.0]),
    ];
    let furrow = (build.furrow > 0.0).then_some(Furrow {
        deep: build.furrow,
        wide: 30.0 * s,
        z: 1120.0 * s,
        long: 330.0 * s,
    });
    let mut parts = vec![SolidPart::Stack {
        levels: trunk,
        exponent: build.exponent,
        furrow,
        round: 30.0 * s,
    }];
    parts.push(SolidPart::Limb {
        from: [0.0, 6.0 * s, 1430.0 * s],
        to: [0.0, -10.0 * s, 1610.0 * s],
        half_from: [58.0 * w, 62.0 * w],
        half_to: [52.0 * w, 56.0 * w],
        round: 20.0 * s,
    });
    parts.push(SolidPart::Ellipsoid {
        centre: [0.0, -14.0 * s, 1632.0 * s],
        half: [76.0 * s, 96.0 * s, 118.0 * s],
    });
    let mut planes = vec![
        upright("WC", 0.0, 0.0, 1048.0 * s),
        upright("HC", 0.0, 14.0 * s, 880.0 * s),
        upright("CC", 0.0, -2.0 * s, 1280.0 * s),
        upright("NC", 0.0, -2.0 * s, 1510.0 * s),
    ];
    for (side, suffix) in [(1.0, "L"), (-1.0, "R")] {
        leg(side, suffix, s, w, &mut parts, &mut planes);
        arm(side, suffix, s, w, build.arms, &mut parts, &mut planes);
    }
    Solid {
        parts,
        blend_mm: 24.0 * s,
        planes,
    }
}

type Planes = Vec<(String, [f64; 3], [f64; 3])>;

fn upright(name: &str, x: f64, y: f64, z: f64) -> (String, [f64; 3], [f64; 3]) {
    (name.into(), [x, y, z], [0.0, 0.0, 1.0])
}

fn leg(side: f64, suffix: &str, s: f64, w: f64, parts: &mut Vec<SolidPart>, planes: &mut Planes) {
    let level = |z: f64, out: f64, back: f64, half: [f64; 2]| Level {
        z: z * s,
        centre: [side * out * s, back * s],
        half: half.map(|h| h * w),
    };
    parts.push(SolidPart::Stack {
        levels: vec![
            level(12.0, 104.0, 16.0, [34.0, 42.0]),
            level(110.0, 104.0, 14.0, [34.0, 40.0]),
            level(330.0, 103.0, 16.0, [53.0, 58.0]),
            level(480.0, 102.0, 4.0, [51.0, 56.0]),
            level(700.0, 98.0, 4.0, [70.0, 80.0]),
            level(790.0, 95.0, 6.0, [77.0, 88.0]),
            level(880.0, 86.0, 8.0, [72.0, 80.0]),
        ],
        exponent: 2.0,
        furrow: None,
        round: 16.0 * s,
    });
    parts.push(SolidPart::Ellipsoid {
        centre: [side * 108.0 * s, -50.0 * s, 34.0 * s],
        half: [43.0 * s, 122.0 * s, 33.0 * s],
    });
    planes.push(upright(
        &format!("TC_{suffix}"),
        side * 98.0 * s,
        4.0 * s,
        700.0 * s,
    ));
    planes.push(upright(
        &format!("CFC_{suffix}"),
        side * 103.0 * s,
        16.0 * s,
        330.0 * s,
    ));
}

fn arm(
    side: f64,
    suffix: &str,
    s: f64,
    w: f64,
    angle: f64,
    parts: &mut Vec<SolidPart>,
    planes: &mut Planes,
) {
    let shoulder = Vector3::new(side * 140.0, 6.0, 1398.0) * s;
    let down = Vector3::new(side * libm::sin(angle), 0.0, -libm::cos(angle));
    let bent = (down + Vector3::new(-0.1 * side, -0.14, 0.0)).normalize();
    let elbow = shoulder + down * (325.0 * s);
    let wrist = elbow + bent * (250.0 * s);
    let tip = wrist + bent * (170.0 * s);
    let limb = |from: Vector3<f64>, to: Vector3<f64>, half: [[f64; 2]; 2], round: f64| {
        let [half_from, half_to] = half.map(|h| h.map(|x| x * w));
        SolidPart::Limb {
            from: from.into(),
            to: to.into(),
            half_from,
            half_to,
            round: round * s,
        }
    };
    let over = down * (40.0 * s);
    parts.push(limb(
        shoulder,
        elbow + over,
        [[52.0, 54.0], [40.0, 42.0]],
        24.0,
    ));
    parts.push(limb(
        elbow - bent * (40.0 * s),
        wrist,
        [[41.0, 42.0], [28.0, 24.0]],
        16.0,
    ));
    parts.push(limb(
        wrist - bent * (20.0 * s),
        tip,
        [[26.0, 34.0], [12.0, 26.0]],
        14.0,
    ));
    parts.push(SolidPart::Ellipsoid {
        centre: (shoulder + Vector3::new(side * 8.0, 0.0, 2.0) * s).into(),
        half: [58.0, 58.0, 56.0].map(|h| h * w),
    });
    let middle = shoulder + down * (185.0 * s);
    planes.push((format!("AC_{suffix}"), middle.into(), down.into()));
}
