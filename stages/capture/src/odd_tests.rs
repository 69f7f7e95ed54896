//! What is odd about captures that were made for it.

use super::*;
use crate::glance::Together;
use shape::{Photo, Photos, Rig};

#[test]
fn a_shuffled_turn_is_no_camera_in_the_hand() {
    let photo = Photo::of(String::new(), [4, 4], Vec::new());
    let photos = Photos {
        photos: vec![photo; 12],
        plate: None,
        rig: Rig::default(),
    };
    let found = |reached| {
        let together = Together {
            still: 0.2,
            still_pixels: vec![],
            gains: vec![],
            exposure_ev: vec![],
            steps: vec![1.0; 12],
            neighbours: 0.4,
            reached,
        };
        let seen = Seen {
            photos: &photos,
            glances: &[],
            together: &together,
            sharpness: &[],
            tags: None,
            people: None,
        };
        let mut findings = Findings {
            photos: &photos,
            all: vec![],
        };
        order(&seen, &mut findings);
        findings.all[0].what.to_string()
    };
    assert!(found([true, true, false, false]).contains("not in turning order"));
    let in_the_hand = found([true, false, true, true]);
    assert!(
        in_the_hand.contains("20 % of the picture stay still: the camera"),
        "{in_the_hand}"
    );
}

#[test]
fn an_order_is_one_that_chance_gives_to_one_of_a_thousand_turns() {
    assert!(shuffled(0.5, 18) && shuffled(0.36, 18));
    // Bodies in order: 0.04 to 0.23.
    assert!(!shuffled(0.3, 18) && !shuffled(0.23, 12));
    // Of six photos neighbours are 60° apart.
    assert!(!shuffled(0.5, 6));
}
