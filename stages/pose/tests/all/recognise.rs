//! A mat that nobody described is recognised from its tags in photos.

use pose::{FindTags, TagsInput, TagsParams, mat_corners, mat_for};
use shape::{Photo, PhotoId, Photos};
use stage::{Ctx, Stage};
use std::sync::Arc;

/// A mat's tags as a camera sees them on some photos of a turn, corners off by a little noise.
fn seen(mat: &shape::Mat, noise_px: f64) -> shape::Tags {
    use nalgebra::{Rotation3, Vector3};
    let mut dice = proof::Dice(5);
    let view = |i: u32, dice: &mut proof::Dice| {
        let camera = shape::Camera {
            lens: shape::Intrinsics::simple(1600, 2400, 3300.0),
            pose: shape::Pose {
                rotation: Rotation3::from_euler_angles(1.85, 0.01, 0.0)
                    * Rotation3::from_euler_angles(0.0, 0.0, 0.35 * f64::from(i)),
                translation: Vector3::new(5.0, 340.0, 1770.0),
            },
        };
        let tag = |id: u32| {
            let corners = mat_corners(mat, id)?;
            // Behind the body no tag is seen.
            let middle = camera.pose.apply(&corners[0]);
            (middle.z < 1790.0).then_some(())?;
            let corners = corners.map(|c| {
                let at = camera.project(&c).unwrap();
                let mut off = || dice.within(-noise_px, noise_px);
                [at.x + off(), at.y + off()]
            });
            Some(shape::Tag { id, corners })
        };
        let ids = mat.first_id..mat.first_id + mat.count;
        (PhotoId(i), ids.filter_map(tag).collect())
    };
    shape::Tags {
        views: (0..18).map(|i| view(i, &mut dice)).collect(),
    }
}

#[test]
fn a_mat_of_ours_is_recognised_from_the_size_of_its_tags_and_another_is_not() {
    for (disk, tag, count, first) in [
        (450.0, 0.0, 0, 0),
        (700.0, 60.0, 16, 20),
        (500.0, 42.0, 12, 3),
    ] {
        let printed = mat_for(disk, tag, count, first).unwrap();
        // A printer that shrinks by 0.7 %.
        let mat = shape::Mat {
            tag_mm: printed.tag_mm * 0.993,
            ring_mm: printed.ring_mm * 0.993,
            ..printed
        };
        let tags = seen(&mat, 0.1);
        let found = pose::recognised(&tags, mat.tag_mm, Some(disk), |_| {}).unwrap();
        assert_eq!(
            (found.first_id, found.count),
            (first, printed.count),
            "{disk}"
        );
        proof::near(found.ring_mm, mat.ring_mm, 1e-9);
        // Without the disk the ring is warnings to whole millimetres, and that is reported.
        let warnings = std::cell::RefCell::new(String::new());
        let found = pose::recognised(&tags, mat.tag_mm, None, |w| {
            *warnings.borrow_mut() = w.into()
        });
        proof::near(found.unwrap().ring_mm, mat.ring_mm, 1.01);
        assert_eq!(
            warnings.borrow().contains("to within 1 mm"),
            printed.ring_mm > 200.0,
            "{}",
            warnings.borrow()
        );
    }
    let odd = shape::Mat {
        tag_mm: 60.0,
        first_id: 0,
        count: 12,
        ring_mm: 150.5,
    };
    let warnings = std::cell::RefCell::new(String::new());
    // Half a millimetre is 3.3 ‰ of this ring.
    assert_eq!(
        pose::recognised(&seen(&odd, 0.02), 60.0, None, |w| *warnings.borrow_mut() =
            w.into()),
        None
    );
    assert!(
        warnings.borrow().contains("with a radius of 150."),
        "{}",
        warnings.borrow()
    );
}

/// The sample's tags, though none are given.
fn sample() -> (shape::Tags, Vec<String>) {
    let folder =
        std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../samples/mannequin/images");
    let photo = |i: usize| {
        let name = format!("{i:04}.jpg");
        let file = std::fs::read(folder.join(&name)).unwrap();
        Photo::of(name, [800, 1200], file)
    };
    let photos = Photos {
        photos: (0..18).step_by(2).map(photo).collect(),
        ..Photos::default()
    };
    let input = TagsInput {
        photos: Arc::new(photos),
    };
    let heard = Heard::default();
    let nothing = stage::hash(b"");
    let tags = FindTags::run(
        &TagsParams::default(),
        input,
        &Ctx::new(&heard, nothing, nothing),
    );
    (tags.unwrap(), heard.0.into_inner().unwrap())
}

#[derive(Default)]
struct Heard(std::sync::Mutex<Vec<String>>);

impl stage::Host for Heard {
    fn warn(&self, text: &stage::Message) {
        self.0.lock().unwrap().push(text.into());
    }
}

#[test]
fn tags_that_were_not_given_are_reported_and_their_layout_follows_from_one_size() {
    let (tags, warnings) = sample();
    assert_eq!(warnings.len(), 1, "{warnings:?}");
    for part in [
        "numbers 0 to 11",
        "9 of 9 photos that were searched",
        "12 tags on a ring of 3.1",
        "--mat-tag",
    ] {
        assert!(warnings[0].contains(part), "{part}: {warnings:?}");
    }
    let ring = pose::ringed(&tags).unwrap();
    proof::near(ring.ring, 187.0 / 60.0, 0.002 * ring.ring);
    let mat = pose::recognised(&tags, 60.0, None, |_| {}).unwrap();
    assert_eq!((mat.first_id, mat.count, mat.ring_mm), (0, 12, 187.0));
}
