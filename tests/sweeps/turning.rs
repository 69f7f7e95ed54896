//! A sweep of somebody who turns on the spot: what photos and noise do to azimuths, by joints alone, tiny.

use super::methods::Place;
use serde_json::Value;

/// How far azimuths are off before outlines are asked: seconds for a point.
const BY_JOINTS: &str = r#"extends = "turning-synth.toml"
goal = "by_joints"
[node.by_joints]
stage = "turning.score"
from = { cameras = "turned", truth = "truth" }
[sweep.photos_and_noise]
over.ring = { views = [8, 10] }
over.photos = { noise_levels = [0.0, 8.0] }
goal = "by_joints"
tell = ["photos.photos", "by_joints.azimuth"]
"#;

#[test]
fn photos_and_noise_reach_the_azimuths_of_somebody_who_turns_on_the_spot() {
    let place = Place::new();
    place.write("turning.toml", BY_JOINTS);
    let body = concat!(env!("CARGO_MANIFEST_DIR"), "/samples/person/truth");
    let sets =
        "--set true_body.unit=m --set ring.width=216 --set ring.height=384 --set photos.rays=1";
    let sweep = format!("sweep turning.toml photos_and_noise --input surface={body} --out out");
    place.tailor(&format!("{sweep} {sets} --set photos.contrast=0.3"), 0);
    let sweep: Value = serde_json::from_str(&place.read("out/sweep.json")).unwrap();
    let number = |point: usize, name: &str| {
        let metrics = sweep["points"][point]["metrics"].as_array().unwrap();
        let metric = metrics.iter().find(|m| m["name"] == name);
        metric.and_then(|m| m["value"].as_f64())
    };
    let photos = [0, 1, 2, 3].map(|point| number(point, "photos.photos"));
    assert_eq!(photos, [8.0, 8.0, 10.0, 10.0].map(Some));
    let azimuths = [0, 1, 2, 3].map(|point| number(point, "by_joints.azimuth").unwrap());
    // Joints alone see a body of 100 pixels to some degrees; noise changes what they see.
    assert!(
        azimuths.iter().all(|a| (0.1..6.0).contains(a)),
        "{azimuths:?}"
    );
    assert!(azimuths[0] != azimuths[1] && azimuths[2] != azimuths[3]);
}
