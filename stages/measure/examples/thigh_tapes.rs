//! Tapes of made bodies' thighs, as the table by which a thigh that is hidden where legs join is bounded.
//!
//! ```sh
//! python3 models/made/strangers.py WHEEL MADE --to 240
//! cargo run --release -p measure --features tables --example thigh_tapes -- MADE > models/tables/thighs.csv
//! ```
//!
//! A row a thigh: `web` is 1 where gaps between thighs were filled; `truth` the true tape; the rest is what the program reads
//! (`thigh_seen`). Shares of stature.

mod made_bodies;

use made_bodies::{Fault, read, written};
use measure::thigh_seen;
use shape::Side;
use std::path::Path;

fn main() -> Result<(), Fault> {
    written(
        [
            "id", "side", "web", "truth", "above", "hip", "tape", "lower20", "lower40",
        ],
        body,
    )
}

/// The rows of one body.
fn body(path: &Path) -> Result<Vec<Vec<String>>, Fault> {
    let made = read(path)?;
    let Ok(features) = made.features() else {
        return Err(format!("{}: no body", made.id).into());
    };
    let stature = made.truth["stature"]
        .as_f64()
        .ok_or("a truth without stature")?;
    let web = made.truth["finish"]["web"]
        .as_f64()
        .is_some_and(|mm| mm > 0.0);
    let row = |side: Side| {
        let plane = format!("thigh{}", side.suffix().to_lowercase());
        let truth = made.truth["planes"][plane]["tape_clean"].as_f64()?;
        let seen = thigh_seen(&made.mesh, &features, side)?;
        let mut row = vec![
            made.id.clone(),
            side.word().to_owned(),
            u8::from(web).to_string(),
        ];
        row.push(format!("{:.4}", truth / stature));
        row.extend(seen.map(|x| format!("{x:.4}")));
        Some(row)
    };
    Ok(Side::BOTH.into_iter().filter_map(row).collect())
}
