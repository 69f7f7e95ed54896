//! The slopes that the refinement follows, compared with central differences of what it minimises.

use crate::turn;

use nalgebra::Vector3;
use refine::evidence::agreement::{agreement, agreement_as_compiled};
use refine::evidence::contours::{Pull, pulls};
use refine::evidence::outside::outside;
use refine::evidence::patch::{Pairing, Window};
use refine::evidence::scene::{Scene, VisibilityRules};
use refine::evidence::visibility::Visibility;
use refine::geometry::curvature::Laplacian;
use refine::pictures::picture::Picture;
use refine::pictures::prepare::{footprint, pictures};
use refine::surface::energy::Forces;
use refine::surface::step::{DataTerm, Rest, displacements};
use shape::{Adjacency, Mesh};
use stage::Stop;
use turn::{RADIUS, ball, turn};

fn rules() -> VisibilityRules {
    VisibilityRules::new(65.0, Pairing::between(3.0, 50.0), 4.0)
}

/// The ball's photos.
fn looked_at() -> Vec<Picture> {
    let (photos, cameras, masks) = turn(18.0, &[]);
    pictures::<Stop>(&photos, &cameras, Some(&masks), 0, 6.0, || Ok(())).unwrap()
}

/// A bumpy ball, positions and normals.
fn bumpy() -> (Mesh, Vec<Vector3<f64>>) {
    let mut mesh = ball(RADIUS + 0.7);
    for p in &mut mesh.positions {
        let wave = 1.0 + 0.01 * libm::sinf(0.2 * p[0] + 0.13 * p[1]) * libm::cosf(0.17 * p[2]);
        *p = p.map(|x| x * wave);
    }
    let x = (0..mesh.positions.len() as u32)
        .map(|v| mesh.point(v).coords)
        .collect();
    (mesh, x)
}

/// Everything that [`Forces`] borrows.
struct Fixed {
    visible: Visibility,
    window: Window,
    rules: VisibilityRules,
    pulls: Vec<Pull>,
    outside: Vec<f64>,
    laplacian: Laplacian,
    rest: Rest,
    pictures: Vec<Picture>,
    footprint: f64,
    normals: Vec<Vector3<f64>>,
    x: Vec<Vector3<f64>>,
}

fn fixed_at(level: bool) -> Fixed {
    let (pictures, (mesh, x)) = (looked_at(), bumpy());
    let around = Adjacency::new(&mesh);
    let normals = mesh.normals();
    let (window, rules) = (Window::new(4, level), rules());
    let scene = Scene::new(&mesh, &around, &pictures, &window, &rules);
    let (visible, pulls) = (Visibility::new(&scene), pulls(&scene, 3.0));
    let laplacian = Laplacian::new(&mesh, &around);
    Fixed {
        visible,
        pulls,
        rest: Rest::new(&laplacian, &x, &normals, 5),
        outside: outside(
            &mesh,
            &normals,
            &pictures,
            0.2,
            footprint(&mesh, &pictures),
            |_| None,
        ),
        footprint: footprint(&mesh, &pictures),
        laplacian,
        window,
        rules,
        pictures,
        normals,
        x,
    }
}

impl Fixed {
    fn forces(&self, contour_weight: f64, hull_weight: f64, bending: f64) -> Forces<'_> {
        Forces {
            pictures: &self.pictures,
            visible: &self.visible,
            rules: &self.rules,
            window: &self.window,
            pulls: &self.pulls,
            outside: &self.outside,
            hull_weight,
            laplacian: &self.laplacian,
            footprint: self.footprint,
            contour_weight,
            rest: &self.rest,
            bending,
            anchor: 0.0,
        }
    }
}

/// ψ (eq. 4) at every vertex that is seen. Brightness is bilinear, so its slope jumps at pixels'
/// edges; a step is so short that few points cross one, and those few make single vertices differ.
#[test]
fn the_slope_of_consistency_is_its_derivative() {
    for level in [false, true] {
        let fixed = fixed_at(level);
        let (mut off, mut far, mut count) = (0.0, 0, 0);
        for v in 0..fixed.x.len() {
            let (visible, frame) = (fixed.visible.of(v), fixed.visible.frame(v));
            if visible.len() < 2 {
                continue;
            }
            let pairing = fixed.rules.pairing;
            let at = |d: f64| {
                let a = agreement::<0>(&fixed.pictures, visible, frame, d, &fixed.window, pairing);
                a.score
            };
            let given =
                agreement::<1>(&fixed.pictures, visible, frame, 0.0, &fixed.window, pairing);
            assert!((given.score - at(0.0)).abs() < 1e-6 * given.weight.max(1.0));
            assert!(given.stiffness >= 0.0 && given.score <= given.weight * 1.0001);
            let h = 4e-3;
            let want = (at(h) - at(-h)) / (2.0 * h);
            let scale = given.stiffness.max(1e-3).sqrt() * given.weight.max(1e-3).sqrt();
            let error = (given.slope - want).abs() / scale;
            off += error;
            far += usize::from(error > 0.05);
            count += 1;
        }
        assert!(count > 300, "{count} vertices are seen");
        assert!(off / f64::from(count) < 5e-3, "{}", off / f64::from(count));
        assert!(far * 100 < count as usize, "{far} of {count} are off");
    }
}

/// The pull on all vertices at once is minus the slope of the whole energy, contours, hull and bending term included.
#[test]
fn the_pull_on_the_surface_is_minus_the_slope_of_the_energy() {
    let fixed = fixed_at(true);
    assert!(fixed.pulls.len() > 100, "{} contours", fixed.pulls.len());
    let mut dice = proof::Dice(4);
    let out = fixed.outside.iter().filter(|o| **o > 0.0).count();
    assert!(out > 20, "{out} vertices show outside");
    for (contour_weight, hull_weight, bending) in [
        (0.0, 0.0, 0.0),
        (3.0, 0.0, 0.0),
        (0.0, 3.0, 0.0),
        (0.3, 10.0, 40.0),
    ] {
        let forces = fixed.forces(contour_weight, hull_weight, bending);
        let still = vec![0.0; fixed.x.len()];
        let data_term = forces.data_term(&forces.agreements::<1>(&still, |_| None));
        // Against very stiff data terms the step is the pull over the stiffness: bending included.
        let stiff = 1e9;
        let hard = DataTerm {
            pull: data_term.pull.clone(),
            stiffness: vec![stiff; still.len()],
        };
        let step = displacements(
            &hard,
            &fixed.laplacian,
            &fixed.x,
            &fixed.normals,
            &fixed.rest,
            bending,
            3,
        );
        for _ in 0..5 {
            let way: Vec<f64> = still.iter().map(|_| dice.normal()).collect();
            let energy = |h: f64| {
                let d: Vec<f64> = way.iter().map(|w| w * h).collect();
                forces.energy(&forces.agreements::<0>(&d, |_| None), &d, &fixed.x)
            };
            let h = 2e-3;
            let want = (energy(h) - energy(-h)) / (2.0 * h);
            let given: f64 = step.iter().zip(&way).map(|(s, w)| -s * stiff * w).sum();
            let size: f64 = step.iter().map(|s| (s * stiff).powi(2)).sum::<f64>().sqrt();
            assert!(
                (given - want).abs() < 0.02 * size,
                "contour_weight {contour_weight}, hull_weight {hull_weight}, bending {bending}: {given} against {want}, of {size}"
            );
        }
    }
}

/// A score goes on by slope and stiffness: over a tenth of a pixel to a tenth of what it changes by, on the whole.
#[test]
fn a_score_goes_on_by_its_slope_and_stiffness() {
    let fixed = fixed_at(true);
    let (mut off, mut change) = (0.0, 0.0);
    for v in 0..fixed.x.len() {
        let (visible, frame) = (fixed.visible.of(v), fixed.visible.frame(v));
        let (window, pairing) = (&fixed.window, fixed.rules.pairing);
        let read = |d: f64| agreement::<1>(&fixed.pictures, visible, frame, d, window, pairing);
        let (here, far) = (read(0.0), 0.1 * fixed.footprint);
        let there = read(far);
        let ahead = here.ahead(far);
        assert!(ahead.score <= ahead.weight && ahead.weight == here.weight);
        off += (ahead.score - there.score).powi(2);
        change += (here.score - there.score).powi(2);
    }
    assert!(
        change > 0.0 && off.sqrt() < 0.25 * change.sqrt(),
        "{off} of {change}"
    );
}

/// Mean curvature and a plain thin plate shrink what is round; the bending term must not: a tube of 100 mm
/// girth, and one of 1 m, bare of texture and contours, keep their girth within 0.02 % a step.
#[test]
fn the_bending_term_does_not_shrink_a_cylinder() {
    for radius in [16.0, 160.0] {
        let (around, along) = (60usize, 120usize);
        let edge = std::f64::consts::TAU * radius / around as f64;
        let mut mesh = Mesh::default();
        for (k, i) in (0..along).flat_map(|k| (0..around).map(move |i| (k, i))) {
            let angle = i as f64 / around as f64 * std::f64::consts::TAU;
            let z = (k as f64 - along as f64 / 2.0) * edge;
            let p = [radius * libm::cos(angle), radius * libm::sin(angle), z];
            mesh.positions.push(p.map(|x| x as f32));
        }
        let at = |k: usize, i: usize| (k * around + i % around) as u32;
        for (k, i) in (0..along - 1).flat_map(|k| (0..around).map(move |i| (k, i))) {
            let (a, b, c, d) = (at(k, i), at(k, i + 1), at(k + 1, i), at(k + 1, i + 1));
            mesh.faces.extend([[a, b, c], [b, d, c]]);
        }
        for (end, inward) in [(0, true), (along - 1, false)] {
            let middle = mesh.positions.len() as u32;
            let z = mesh.positions[end * around][2];
            mesh.positions.push([0.0, 0.0, z]);
            for i in 0..around {
                let (a, b) = (at(end, i), at(end, i + 1));
                let face = if inward {
                    [b, a, middle]
                } else {
                    [a, b, middle]
                };
                mesh.faces.push(face);
            }
        }
        mesh.validate_closed().unwrap();
        assert!(mesh.volume() > 0.0);
        let adjacency = Adjacency::new(&mesh);
        let (laplacian, normals) = (Laplacian::new(&mesh, &adjacency), mesh.normals());
        let x: Vec<_> = (0..mesh.positions.len() as u32)
            .map(|v| mesh.point(v).coords)
            .collect();
        let rest = Rest::new(&laplacian, &x, &normals, 20);
        let data_term = DataTerm {
            pull: vec![0.0; x.len()],
            stiffness: vec![1e-4 / (edge * edge); x.len()],
        };
        let bending = 10.0 * edge * edge;
        let d = displacements(&data_term, &laplacian, &x, &normals, &rest, bending, 100);
        let middle = &d[at(along / 2, 0) as usize..at(along / 2, 0) as usize + around];
        let mean = middle.iter().sum::<f64>() / around as f64;
        assert!(mean.abs() < 2e-4 * radius, "{mean} mm of {radius} mm");
        // The test sees shrinking where there is some: without a rest shape the tube gives way.
        let plain = Rest {
            wanted: vec![0.0; x.len()],
        };
        let d = displacements(&data_term, &laplacian, &x, &normals, &plain, bending, 100);
        assert!(d[at(along / 2, 0) as usize] < -1e-3 * radius);
    }
}

/// Wide registers change the time and not the bytes, nor does reading a picture once for two purposes.
#[test]
fn consistency_is_the_same_in_registers_of_any_width() {
    let fixed = fixed_at(true);
    let (window, pairing) = (&fixed.window, fixed.rules.pairing);
    for v in 0..fixed.x.len() {
        let (visible, frame) = (fixed.visible.of(v), fixed.visible.frame(v));
        for d in [0.0, 0.13] {
            let wide = agreement::<1>(&fixed.pictures, visible, frame, d, window, pairing);
            let plain =
                agreement_as_compiled::<1>(&fixed.pictures, visible, frame, d, window, pairing);
            assert_eq!(wide, plain, "vertex {v} moved by {d} mm");
            let score = agreement::<0>(&fixed.pictures, visible, frame, d, window, pairing).score;
            assert_eq!(wide.score, score);
        }
    }
}
