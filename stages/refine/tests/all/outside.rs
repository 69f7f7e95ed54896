//! The visual hull as a bound: what shows outside of a silhouette is drawn back, and nothing else.

use crate::turn;

use nalgebra::Vector3;
use refine::evidence::outside::outside;
use refine::pictures::fixed::STEP;
use refine::pictures::picture::Picture;
use refine::pictures::prepare::{footprint, pictures};
use shape::{Masks, Mesh, SHOWN};
use stage::Stop;
use turn::{RADIUS, ball, camera, turn};

/// The ball's photos, masks changed by `change`.
fn scene(change: impl Fn(&mut Masks)) -> Vec<Picture> {
    let (photos, cameras, mut masks) = turn(18.0, &[]);
    change(&mut masks);
    pictures::<Stop>(&photos, &cameras, Some(&masks), 0, 6.0, || Ok(())).unwrap()
}

/// How far inward each vertex is sent \[mm\], and the footprint of a pixel.
fn sent(mesh: &Mesh, pictures: &[Picture], slack_px: f64) -> (Vec<f64>, f64) {
    let footprint = footprint(mesh, pictures);
    let far = outside(mesh, &mesh.normals(), pictures, slack_px, footprint, |_| {
        None
    });
    (far, footprint)
}

#[test]
fn what_is_within_all_silhouettes_is_left_alone() {
    let pictures = scene(|_| ());
    let (far, footprint) = sent(&ball(RADIUS - 1.0), &pictures, 0.0);
    assert!(far.iter().all(|f| *f == 0.0));
    let (far, _) = sent(&ball(RADIUS + 1.0), &pictures, 1.5 / footprint);
    assert!(far.iter().all(|f| *f == 0.0), "less than the slack");
}

#[test]
fn what_sticks_out_is_sent_back_as_far_as_it_does() {
    let pictures = scene(|_| ());
    let mesh = ball(RADIUS + 3.0);
    let (far, footprint) = sent(&mesh, &pictures, 0.0);
    let round = mesh.positions.iter().zip(&far);
    // Twelve cameras look down by 12.7 degrees: about the equator each vertex is near to a contour.
    let belt: Vec<f64> = round
        .filter(|(p, _)| p[2].abs() < 10.0)
        .map(|(_, f)| *f)
        .collect();
    assert!(belt.len() > 20, "{} vertices", belt.len());
    let (least, most) = belt
        .iter()
        .fold((f64::MAX, 0f64), |r, f| (r.0.min(*f), r.1.max(*f)));
    assert!(most < 3.0 + footprint, "at most {most} mm of 3");
    assert!(least > 3.0 - 2.5 * footprint, "at least {least} mm of 3");
}

#[test]
fn a_gap_that_one_photo_looks_through_is_kept_open_on_both_sides() {
    // A slit through the silhouette of the first photo, seven pixels wide.
    let pictures = scene(|masks| {
        let kept = masks.views.get_mut(shape::PhotoId(0)).unwrap();
        let mut slit = kept.pixels();
        for y in 0..slit.height {
            for x in 77..84 {
                *slit.at_mut(x, y) = 0;
            }
        }
        *kept = slit.into();
    });
    let mesh = ball(RADIUS - 1.0);
    let (far, _) = sent(&mesh, &pictures, 1.0);
    let eye = camera(0).centre().coords.normalize();
    let shows = |v: usize| {
        let (at, _) = pictures[0].project(&mesh.point(v as u32)).unwrap();
        (at[0] - 80.0).abs() < 1.5
    };
    let side = |near: bool| -> Vec<f64> {
        (0..far.len())
            .filter(|v| shows(*v))
            .filter(|v| {
                let x: Vector3<f64> = mesh.point(*v as u32).coords;
                x.dot(&eye) * if near { 1.0 } else { -1.0 } > 20.0
            })
            .map(|v| far[v])
            .collect()
    };
    for (name, far) in [("near", side(true)), ("far", side(false))] {
        assert!(far.len() > 3, "{} vertices on the {name} side", far.len());
        assert!(far.iter().all(|f| *f > 0.0), "{name}: {far:?}");
    }
}

#[test]
fn an_outline_that_its_photo_does_not_show_bounds_less() {
    // The first photo's mask ends six pixels within the ball, where both sides have the ball's grey.
    let (photos, cameras, mut masks) = turn(1.0, &[]);
    let kept = masks.views.get_mut(shape::PhotoId(0)).unwrap();
    let mut bitten = kept.pixels();
    let depth = shape::signed_distance(&bitten);
    let within = bitten.data.iter_mut().zip(&depth.data);
    within.for_each(|(cover, depth)| *cover = if *depth > 6.0 { *cover } else { 0 });
    *kept = bitten.into();
    let pictures = pictures::<Stop>(&photos, &cameras, Some(&masks), 0, 6.0, || Ok(())).unwrap();
    let outline = |picture: &Picture| {
        let inside = picture.inside.as_ref().unwrap();
        let on = |i: &usize| (0.0..1.0).contains(&(f32::from(inside.data[*i]) * STEP));
        let at = (0..inside.data.len())
            .filter(on)
            .map(|i| [i % inside.width, i / inside.width]);
        at.map(|at| at.map(|v| v as f64)).collect::<Vec<_>>()
    };
    for at in outline(&pictures[0]) {
        assert!(pictures[0].border_sigma(at) > 4.0 * SHOWN * 110.0);
    }
    for at in outline(&pictures[1]) {
        assert!(pictures[1].border_sigma(at) < 1.01 * SHOWN * 122.0);
    }
}
