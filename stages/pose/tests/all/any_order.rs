//! Cameras of a turn whose photos are in any order: from two photos on, one more at a time.

use crate::turn::{at, calibrated_by, error, rig, tracks};
use pose::{CalibrateParams, Motion};

/// Places in the turn of photos that follow each other by no step: each third or so one, then those between.
const PLACES: [i32; 18] = [0, 7, 14, 3, 10, 17, 6, 13, 2, 9, 16, 5, 12, 1, 8, 15, 4, 11];

fn params(motion: Motion) -> CalibrateParams {
    CalibrateParams {
        motion,
        most_tracks: 400,
        ..CalibrateParams::default()
    }
}

#[test]
fn photos_in_any_order_have_the_cameras_that_took_them() {
    let truth = at(1.0, &PLACES);
    let rig = || rig(Some(2670.0 / 2400.0 * 36.0 / 1.004), None);
    let mut tracks = tracks(&truth, 0.0);
    tracks.points.truncate(500);
    let found = calibrated_by(&params(Motion::Any), &truth, tracks.clone(), rig()).unwrap();
    assert_eq!(found.views.len(), PLACES.len());
    let off = error(&found, &truth);
    assert!(off < 0.004, "{off} of the radius");
    // They are in no order: by that of their names there are no such cameras.
    let in_order = calibrated_by(&params(Motion::Auto), &truth, tracks, rig());
    assert!(in_order.is_err_and(|why| !why.is_empty()));
}
