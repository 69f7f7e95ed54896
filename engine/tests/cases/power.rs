//! Losses of power: a process is killed, and of each file that it wrote any part may be missing.
//!
//! What was not synced when power went may be whole, empty, cut, full of zeros or under no name, in any
//! mixture, for a disk writes in the order that it likes. Here that happens to every file alike, synced
//! or not, so all that a disk can come to is among it. `ENGINE_LOSSES=1000` takes more of them.

use crate::place::{Log, NONE, Place};
use crate::processes::{start, wide};
use proof::Dice;
use std::path::{Path, PathBuf};
use std::time::Duration;

use engine::store::retention;

/// Every file below a folder.
fn files(folder: &Path) -> Vec<PathBuf> {
    let (mut open, mut found) = (vec![folder.to_owned()], Vec::new());
    while let Some(folder) = open.pop() {
        for entry in std::fs::read_dir(folder).into_iter().flatten() {
            let path = entry.unwrap().path();
            match path.is_dir() {
                true => open.push(path),
                false => found.push(path),
            }
        }
    }
    found.sort();
    found
}

/// What a disk may have made of a file.
fn lose(path: &Path, dice: &mut Dice) {
    let bytes = std::fs::read(path).unwrap();
    let cut = dice.bits() as usize % (bytes.len() + 1);
    let left = match dice.bits() % 4 {
        0 => return std::fs::remove_file(path).unwrap(),
        1 => vec![],
        2 => bytes[..cut].to_vec(),
        _ => {
            let mut zeros = bytes.clone();
            zeros[cut..].fill(0);
            zeros
        }
    };
    std::fs::write(path, left).unwrap();
}

#[test]
fn a_loss_of_power_costs_work_and_nothing_else() {
    let losses: i64 = std::env::var("ENGINE_LOSSES").map_or(50, |n| n.parse().unwrap());
    let seed: u64 = std::env::var("ENGINE_LOSSES_SEED").map_or(1, |n| n.parse().unwrap());
    let (mut dice, mut lost) = (Dice(seed), 0);
    let place = Place::new("hello\n");
    let contents = |cache: &Path, n: i64| {
        let outcome = place.outcome(&wide(2, 6, 0, n), cache, 1, &Log::default());
        let contents = outcome.nodes.iter().flatten().map(|d| d.content);
        contents.collect::<Vec<_>>()
    };
    let fresh: Vec<_> = (0..4)
        .map(|n| contents(&place.path().join("fresh"), n))
        .collect();
    for round in 0..losses {
        let n = round % 4;
        let mut child = start(&place, &format!("2 6 0 {n}"));
        std::thread::sleep(Duration::from_micros(dice.within(2000.0, 30_000.0) as u64));
        let _ = child.kill();
        child.wait().unwrap();
        let share = dice.unit() * dice.unit();
        for path in files(&place.cache()) {
            if dice.unit() < share {
                lose(&path, &mut dice);
                lost += 1;
            }
        }
        let now = contents(&place.cache(), n);
        assert_eq!(now, fresh[n as usize], "round {round}");
        engine::runs(&place.cache()).for_each(drop);
        let graph = wide(2, 6, 0, n);
        assert_eq!(
            place.run_in(&graph, &place.cache(), 2),
            NONE,
            "round {round}"
        );
        retention::verify(&place.store()).unwrap();
        assert_eq!(
            retention::verify(&place.store()).unwrap(),
            0,
            "round {round}"
        );
    }
    assert!(lost >= losses as usize, "only {lost} files were lost");
}
