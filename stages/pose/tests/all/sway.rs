//! What is not sure of a lens is adjusted though the subject sways.

use crate::turn::{calibrated_by, rig, tracks, truth};
use pose::CalibrateParams;

#[test]
fn a_focal_length_that_is_not_sure_is_adjusted_though_the_subject_sways() {
    let truth = truth(1.0);
    // 8 % too short, as of a photo that was cropped.
    let rig = rig(Some(0.92 * 2670.0 / 2400.0 * 36.0 / 1.004), Some(20.0));
    let of = |focal_sigma: f64| {
        let p = CalibrateParams {
            focal_sigma,
            ..CalibrateParams::default()
        };
        let found = calibrated_by(&p, &truth, tracks(&truth, 8.0), rig.clone()).unwrap();
        let lens = found.views.values().next().unwrap().camera.lens;
        lens.focal[0] / 2670.0 - 1.0
    };
    let [unsure, sure] = [0.1, 0.001].map(of);
    assert!(unsure.abs() < 0.04, "{unsure}");
    assert!((sure + 0.08).abs() < 0.005, "{sure}");
}
