//! Limbs by their own lines: arms raised and bent, legs bent, against solids given by formula.

use crate::made;

use made::{Given, built, measured};
use measure::{LevelModel, Segment, arm_joints, body, limbs, share};
use nalgebra::{Point3, Vector3};
use shape::{Girths, Mesh, Refusal, Solid, SolidPart};
use synth::{contour, length, taut};

const STATURE: f64 = 1750.0;
const SHOULDER: [f64; 3] = [165.0, 6.0, 1415.0];
/// Lengths of upper arm, forearm and hand. \[mm\]
const ARM: [f64; 3] = [320.0, 255.0, 150.0];

/// How limbs hang. \[°\]
#[derive(Clone, Copy)]
struct Pose {
    arm: f64,
    elbow: f64,
    knee: f64,
}

fn limb(from: Vector3<f64>, to: Vector3<f64>, half: [[f64; 2]; 2], round: f64) -> SolidPart {
    SolidPart::Limb {
        from: from.into(),
        to: to.into(),
        half_from: half[0],
        half_to: half[1],
        round,
    }
}

/// Shoulder, elbow, wrist and fingertip of the left arm; forearms bend forward.
fn arm_line(pose: Pose) -> [Vector3<f64>; 4] {
    let shoulder = Vector3::from(SHOULDER);
    let (s, c) = libm::sincos(pose.arm.to_radians());
    let down = Vector3::new(s, 0.0, -c);
    let (s, c) = libm::sincos(pose.elbow.to_radians());
    let fore = down * c - Vector3::y() * s;
    let elbow = shoulder + down * ARM[0];
    let wrist = elbow + fore * ARM[1];
    [shoulder, elbow, wrist, wrist + fore * ARM[2]]
}

/// Hip, knee and ankle of the left leg; a bent knee goes forward.
fn leg_line(pose: Pose) -> [Vector3<f64>; 3] {
    let (s, c) = libm::sincos(pose.knee.to_radians() / 2.0);
    let hip = Vector3::new(95.0, 6.0, 880.0);
    let knee = hip + Vector3::new(8.0, -390.0 * s, -390.0 * c);
    [hip, knee, knee + Vector3::new(8.0, 400.0 * s, -400.0 * c)]
}

/// A body of ellipses and cones in a pose, on its soles.
fn posed(pose: Pose) -> Solid {
    let mut solid = built(STATURE, 1.0, 30.0);
    // Trunk, neck and head stay.
    solid.parts.truncate(3);
    for side in [1.0, -1.0] {
        let to = |v: Vector3<f64>| Vector3::new(v.x * side, v.y, v.z);
        let [shoulder, elbow, wrist, tip] = arm_line(pose).map(to);
        let [down, fore] = [(elbow - shoulder).normalize(), (wrist - elbow).normalize()];
        solid.parts.extend([
            limb(
                shoulder - down * 30.0,
                elbow + down * 15.0,
                [[56.0, 56.0], [40.0, 40.0]],
                24.0,
            ),
            limb(
                elbow - fore * 15.0,
                wrist,
                [[45.0, 45.0], [27.0, 27.0]],
                16.0,
            ),
            limb(wrist - fore * 20.0, tip, [[27.0, 38.0], [14.0, 26.0]], 14.0),
            SolidPart::Ellipsoid {
                centre: (to(Vector3::from(SHOULDER)) + Vector3::z() * -8.0).into(),
                half: [60.0, 58.0, 60.0],
            },
        ]);
        let [hip, knee, ankle] = leg_line(pose).map(to);
        let [thigh, shank] = [(knee - hip).normalize(), (ankle - knee).normalize()];
        let calf = knee + shank * 130.0;
        solid.parts.extend([
            limb(
                hip - thigh * 20.0,
                knee + thigh * 20.0,
                [[84.0, 88.0], [54.0, 54.0]],
                30.0,
            ),
            limb(
                knee - shank * 20.0,
                calf,
                [[50.0, 50.0], [60.0, 60.0]],
                20.0,
            ),
            limb(
                calf,
                ankle + shank * 30.0,
                [[60.0, 60.0], [33.0, 33.0]],
                20.0,
            ),
            SolidPart::Ellipsoid {
                centre: (ankle + Vector3::new(0.0, -55.0, -50.0)).into(),
                half: [42.0, 118.0, 34.0],
            },
        ]);
    }
    solid
}

/// A surface with its soles on the ground.
fn standing(solid: &Solid, cell_mm: f64) -> (Mesh, f64) {
    let mut mesh = made::meshed(solid, cell_mm);
    let low = mesh.bounds().unwrap().0.z;
    mesh.positions.iter_mut().for_each(|p| p[2] -= low as f32);
    (mesh, low)
}

/// The formula's tape of a limb alone at the plane of its girth, the solid lowered onto the ground.
fn formula(solid: &Solid, low: f64, girths: &Girths, name: &str) -> f64 {
    let mut plane = girths.get(name).unwrap().plane;
    plane.point_mm[2] += low;
    let first =
        if name.ends_with('L') { 3 } else { 11 } + if name.starts_with("AC") { 0 } else { 4 };
    let mut alone = solid.clone();
    alone.parts = solid.parts[first..first + 4].to_vec();
    length(&taut(&contour(&alone, &plane).unwrap(), &plane))
}

const POSES: [Pose; 10] = {
    const fn pose(arm: f64, elbow: f64, knee: f64) -> Pose {
        Pose { arm, elbow, knee }
    }
    [
        pose(15.0, 0.0, 0.0),
        pose(30.0, 0.0, 20.0),
        pose(30.0, 80.0, 0.0),
        pose(45.0, 40.0, 0.0),
        pose(45.0, 80.0, 20.0),
        pose(60.0, 0.0, 0.0),
        pose(60.0, 80.0, 20.0),
        pose(75.0, 40.0, 0.0),
        pose(90.0, 0.0, 20.0),
        pose(90.0, 80.0, 0.0),
    ]
};

#[test]
fn every_limbs_girth_is_its_own_in_every_pose() {
    let mut arms = Vec::new();
    for pose in POSES {
        let solid = posed(pose);
        let (mesh, low) = standing(&solid, 12.0);
        let (landmarks, girths) = measured(mesh);
        for (name, from, to) in [("AC", 0, 1), ("TC", 3, 4), ("CFC", 4, 5)] {
            for suffix in ["L", "R"] {
                let name = format!("{name}_{suffix}");
                let girth = girths.get(&name);
                let girth = girth.unwrap_or_else(|| panic!("{name}: {:?}", landmarks.missing));
                let truth = formula(&solid, low, &girths, &name);
                let at = format!(
                    "{name}, arms {}, elbows {}, knees {}",
                    pose.arm, pose.elbow, pose.knee
                );
                // What the trunk hides is estimated from farther down.
                let within = if girth.definition.contains("split") {
                    0.04
                } else {
                    0.01
                };
                assert!(
                    (girth.tape_mm / truth - 1.0).abs() < within,
                    "{at}: {} for {truth}",
                    girth.tape_mm
                );
                // On the right piece of the right limb.
                let side = if suffix == "L" { 1.0 } else { -1.0 };
                let line: Vec<Vector3<f64>> = arm_line(pose)
                    .into_iter()
                    .chain([leg_line(pose)].concat())
                    .collect();
                let line: Vec<Vector3<f64>> = line
                    .iter()
                    .map(|p| Vector3::new(side * p.x, p.y, p.z - low))
                    .collect();
                let (from, to) = match name.as_bytes()[0] {
                    b'A' => (from, to),
                    _ => (from + 1, to + 1),
                };
                let way = line[to] - line[from];
                let p = Vector3::from(girth.plane.point_mm) - line[from];
                let share = p.dot(&way) / way.norm_squared();
                let off = (p - way * share).norm();
                assert!(
                    (0.1..0.8).contains(&share) && off < 15.0,
                    "{at}: {share} of the way, {off} aside"
                );
                if name.starts_with("AC") {
                    arms.push((share, girth.tape_mm));
                }
            }
        }
    }
    let most = |f: fn(&(f64, f64)) -> f64| {
        let all: Vec<f64> = arms.iter().map(f).collect();
        let (low, high) = all
            .iter()
            .fold((f64::MAX, 0.0f64), |e, x| (e.0.min(*x), e.1.max(*x)));
        (low, high)
    };
    // However the arm hangs, near the same place of it: these cones show no elbow where they are straight.
    let (low, high) = most(|a| a.1);
    assert!(high / low < 1.09, "upper arms from {low} to {high} mm");
    let (low, high) = most(|a| a.0);
    assert!(low > 0.25 && high < 0.65, "{low} to {high} of the way down");
}

#[test]
fn shares_of_a_bent_limb_are_on_its_own_pieces() {
    let pose = POSES[4];
    let (mesh, low) = standing(&posed(pose), 12.0);
    let body = body(&mesh, 0.0).unwrap();
    let mut limbs = limbs(&mesh, &body);
    arm_joints(&mut limbs, &LevelModel::built_in());
    for side in [1.0, -1.0] {
        let to = |p: Vector3<f64>| Point3::new(side * p.x, p.y, p.z - low);
        let (arm, leg) = (arm_line(pose).map(to), leg_line(pose).map(to));
        for (limb, segment, ends) in [
            (limbs.arm(side), Segment::UpperArm, [arm[0], arm[1]]),
            (limbs.arm(side), Segment::Forearm, [arm[1], arm[2]]),
            (limbs.leg(side), Segment::Thigh, [leg[0], leg[1]]),
            (limbs.leg(side), Segment::Shank, [leg[1], leg[2]]),
        ] {
            let (plane, sigma) = share(limb.unwrap(), segment, 0.5).unwrap();
            let way = (ends[1] - ends[0]).normalize();
            let p = Point3::from(plane.point_mm) - ends[0];
            let (along, long) = (p.dot(&way), (ends[1] - ends[0]).norm());
            assert!((p - way * along).norm() < 15.0, "{segment:?} at {p}");
            assert!(
                (0.25..0.75).contains(&(along / long)),
                "{segment:?} {}",
                along / long
            );
            assert!(way.dot(&Vector3::from(plane.normal)) > 0.985, "{segment:?}");
            assert!(sigma.level_mm.is_some_and(|s| (2.0..40.0).contains(&s)));
        }
        let arm = limbs.arm(side).unwrap();
        assert_eq!(
            share(arm, Segment::Thigh, 0.5).unwrap_err(),
            Refusal::NoLimb
        );
        assert!(
            (arm.bent.to_degrees() - pose.elbow).abs() < 8.0,
            "{}",
            arm.bent.to_degrees()
        );
    }
}

#[test]
fn legs_under_a_long_skirt_are_none_and_arms_are_found_beside_it() {
    let mut solid = posed(POSES[3]);
    solid.parts.push(SolidPart::Limb {
        from: [0.0, 6.0, 1000.0],
        to: [0.0, 6.0, 60.0],
        half_from: [150.0, 110.0],
        half_to: [230.0, 230.0],
        round: 30.0,
    });
    let (mesh, _) = standing(&solid, 12.0);
    let body = body(&mesh, 0.0).unwrap();
    let limbs = limbs(&mesh, &body);
    for side in [1.0, -1.0] {
        assert_eq!(limbs.leg(side).unwrap_err(), Refusal::NoLegs);
        assert!(limbs.arm(side).is_ok());
    }
}

#[test]
fn thighs_that_touch_give_each_its_own_half() {
    let free = posed(POSES[1]);
    let (mesh, _) = standing(&free, 12.0);
    let own = Given::of(&mesh).at_any_width();
    let mut solid = free.clone();
    // Pressed together for some centimetres below the crotch.
    solid.parts.push(SolidPart::Ellipsoid {
        centre: [0.0, 6.0, 800.0],
        half: [34.0, 34.0, 60.0],
    });
    let (mesh, _) = standing(&solid, 12.0);
    let girths = Given::of(&mesh).at_any_width();
    for name in ["TC_L", "TC_R"] {
        let [got, own] = [&girths, &own].map(|g| g.get(name).unwrap().tape_mm);
        assert!((got / own - 1.0).abs() < 0.06, "{name}: {got} for {own}");
    }
}
