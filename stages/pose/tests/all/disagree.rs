//! A length that is farther from another than photos can err is a warning with both numbers.

use crate::post::framed_and_warned;

use shape::{Rig, Scale};

#[test]
fn a_stature_that_is_off_by_more_than_can_be_seen_wrongly_is_named_with_both_numbers() {
    let warned = |stature_mm| {
        let rig = Rig {
            stature_mm: Some(stature_mm),
            ..Rig::default()
        };
        let (found, warned) = framed_and_warned(Scale::Mat, rig, None, None);
        assert_eq!(found.unwrap().scale, Scale::Mat);
        warned
    };
    // The post is 800 mm tall, and has no round head, which the stature allows for.
    assert_eq!(warned(815.0), [""; 0]);
    for (mm, given) in [(830.0, "83.0 cm"), (800.0, "80.0 cm")] {
        let all = warned(mm);
        let part = format!("the stature was given as {given}, but by the mat it is 81.");
        assert!(all.len() == 1 && all[0].contains(&part), "{all:?}");
    }
}
