//! What a modelled phone does to results, in short: the laboratory's tables of `docs/lab/phone.md` for users.

use super::figures::json;
use super::near::millimetres;
use super::tables::{TRUNK, between, hold, number};
use serde_json::Value;
use std::fmt::Write;

/// The farthest that a fault moves a tape of the trunk that is reported, against the same photos without one. \[%\]
fn moved(data: &Value, counts: impl Fn(&str) -> bool) -> f64 {
    let rows = data["rows"].as_object().unwrap();
    let tape = |row: &Value, name: &str| row["tape_cm"][name].as_f64();
    let faults = rows.iter().filter(|(fault, _)| counts(fault.as_str()));
    let moved = faults.flat_map(|(_, row)| {
        let pair = |name| tape(row, name).zip(tape(&rows["clean"], name));
        TRUNK.into_iter().filter_map(pair).collect::<Vec<_>>()
    });
    let moved = moved.map(|(now, was)| 100.0 * (now / was - 1.0).abs());
    moved.fold(0.0, f64::max)
}

#[test]
fn what_faults_of_a_phone_move() {
    let mut table = String::from(
        "| the mannequin through a modelled phone: trunk's tapes move by at most | one fault of eleven | all at once |\n\
         |---|---|---|\n",
    );
    let with_mat = json("docs/tables/faults.json");
    let bare = json("docs/tables/faults-no-mat.json");
    for (head, data) in [
        ("mat, no plate", &with_mat),
        ("neither mat nor plate", &bare),
    ] {
        let one = moved(data, |fault| !["clean", "all"].contains(&fault));
        let all = moved(data, |fault| fault == "all");
        let _ = writeln!(table, "| {head} | {one:.1} % | {all:.1} % |");
    }
    let scans = json("docs/tables/scans.json");
    let _ = write!(
        table,
        "\n| {} scans of people, all faults at once, no mat | with a plate | without |\n|---|---|---|\n",
        scans["scans"].as_object().unwrap().len()
    );
    let of = |plate: bool| {
        let rows = scans["scans"].as_object().unwrap().values();
        let rows = rows.flat_map(|rows| rows.as_array().unwrap());
        rows.filter(|row| row["plate"] == plate).collect::<Vec<_>>()
    };
    let line = |what: &str, cell: &dyn Fn(&[&Value]) -> String| {
        format!("| {what} | {} | {} |\n", cell(&of(true)), cell(&of(false)))
    };
    table += &line(
        "trunk's tapes against the true surface at the same plane",
        &|rows| {
            let tapes = rows
                .iter()
                .flat_map(|row| TRUNK.map(|g| row["tape_pct"][g].as_f64()));
            between(tapes.flatten().collect(), 1)
        },
    );
    table += &line("surface of the trunk, mean", &|rows| {
        let trunk: Vec<f64> = rows.iter().map(|row| number(&row["trunk_mm"])).collect();
        millimetres(&trunk)
    });
    table += &line("masks, IoU: worst photo", &|rows| {
        let least = rows.iter().map(|row| number(&row["masks"]["least_iou"]));
        format!("{:.3}", least.fold(1.0, f64::min))
    });
    let by = |data: &Value| {
        let text = |key: &str| data[key].as_str().unwrap().to_owned();
        format!("{}, {}", text("program"), text("date"))
    };
    let _ = writeln!(
        table,
        "\n*Mannequin: {}; scans: {}.*",
        by(&with_mat),
        by(&scans)
    );
    hold("docs/accuracy.md", "phone", &table);
}
