//! How sharply bare legs of made bodies step at most, as the table that a hem is known by.
//!
//! ```sh
//! python3 models/made/strangers.py WHEEL MADE --to 40
//! cargo run --release -p measure --features tables --example leg_steps -- MADE > models/tables/hems.csv
//! ```

mod made_bodies;

use made_bodies::{Fault, folder, read, truths};
use measure::leg_step;

fn main() -> Result<(), Fault> {
    let mut out = csv::Writer::from_writer(std::io::stdout());
    out.write_record(["id", "most"])?;
    for path in truths(&folder()?)? {
        let made = read(&path)?;
        match made.standing().as_ref().and_then(leg_step) {
            Some(most) => out.write_record([&made.id, &format!("{most:.6}")])?,
            None => eprintln!("{}: no legs", made.id),
        }
    }
    out.flush()?;
    Ok(())
}
