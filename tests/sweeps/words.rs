//! Sweeps of the product that cannot be are refused; which nodes a param reaches.

use super::methods::Place;
use tailor::engine;

#[test]
fn a_sweep_that_cannot_be_is_refused_before_anything_runs() {
    let place = Place::new();
    let huge = "sweep body --sweep hull.voxel_mm=1..10/1000 --sweep photos.fewest=3..1000/998";
    for (line, what) in [
        ("sweep body nosuch", "no sweep `nosuch`"),
        ("sweep body", "name a sweep"),
        (
            "sweep body --sweep hull.voxl_mm=2,3",
            "did you mean `voxel_mm`",
        ),
        (
            "sweep body --sweep hul.voxel_mm=2,3",
            "there is no node `hul`",
        ),
        ("sweep body --sweep hull.voxel_mm=2,-3", "out of range"),
        ("sweep body --sweep hull.voxel_mm", "give NODE.PARAM=2,3,4"),
        (
            "sweep body --sweep hull.voxel_mm=2 --tell error.WC",
            "give --truth",
        ),
        (
            "sweep body --sweep hull.voxel_mm=2 --tell hull.volum",
            "`--tell hull.volum`: `hull` (hull.carve) has no `volum`; did you mean `volume`?",
        ),
        (
            "sweep body cells --tell girths.WC.contours",
            "`--tell girths.WC.contours`: `girths` (measure.girths) has no `WC.contours`; did you mean `WC.contour`?",
        ),
        (huge, "998000 points"),
        (huge, "give --yes"),
        ("impact nosuch_mm", "no param `nosuch_mm`"),
    ] {
        let text = place.tailor(line, 2);
        assert!(text.contains(what), "{line}: {text}");
    }
    assert_eq!(engine::runs(&place.path("cache")).count(), 0);
}

#[test]
fn a_param_reaches_what_reads_it_and_nothing_else() {
    let place = Place::new();
    let text = place.tailor("plan body --reach hull.voxel_mm --json", 0);
    let list: serde_json::Value = serde_json::from_str(&text).unwrap();
    let reaches = list[0]["reaches"].as_array().unwrap();
    assert_eq!(reaches[0], "hull");
    let has = |node: &str| reaches.iter().any(|n| n == node);
    assert!(
        has("girths") && !has("masks") && !has("photos"),
        "{reaches:?}"
    );
    let all = place.tailor("impact", 0);
    assert!(
        all.lines().count() > 20 && all.contains("photos.fewest"),
        "{all}"
    );
}
