//! Arms that touch the trunk, or are one with it, from the armpit to the hand: what is given is given as if they hung free.

use crate::made;

use made::{built, measured, meshed};

#[test]
fn arms_that_are_one_with_the_trunk_are_no_part_of_its_girths() {
    let of = |arms_deg: f64, cell: f64| measured(meshed(&built(1700.0, 1.0, arms_deg), cell)).1;
    let free = of(30.0, 8.0);
    for (arms_deg, cell) in [(7.0, 8.0), (8.0, 6.0), (10.0, 8.0)] {
        let girths = of(arms_deg, cell);
        let mut given = 0;
        for name in [
            "HC", "HC_max", "WC", "WC_navel", "CC", "TC_L", "TC_R", "CFC_L", "CFC_R",
        ] {
            let own = free.get(name).unwrap().tape_mm;
            let Some(girth) = girths.get(name) else {
                continue;
            };
            let off = girth.tape_mm / own - 1.0;
            assert!(off.abs() < 0.015, "{name} at {arms_deg} degrees: {off}");
            given += 1;
        }
        assert!(
            given >= 4 && girths.get("WC").is_some(),
            "{:?}",
            girths.missing
        );
    }
}
