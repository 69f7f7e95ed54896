//! A level model as a file that people can read and compare.

use super::file::{FORMAT, LevelModel};
use super::held_out::HeldOut;
use crate::features::readings::READINGS_VERSION;
use nalgebra::DMatrix;
use std::fmt::Write;

const ABOUT: &str = "Levels of girths from what a surface shows. All values are shares of stature, but ln_stature: the \
logarithm of stature against 1700 mm. Covariances are the rows of a lower triangle, readings first, then levels; of a law features first, then its place. \
Written by pipelines/fit-levels.toml: do not edit, refit.";

/// The file of a model, with the tables it was fitted on and what it does on bodies left out.
pub(crate) fn model_to_toml(
    model: &LevelModel,
    tables: &[(String, String)],
    held_out: &[HeldOut],
) -> String {
    let mut text = String::new();
    let names = |all: Vec<&str>| {
        let quoted: Vec<String> = all.iter().map(|n| format!("\"{n}\"")).collect();
        format!("[{}]", quoted.join(", "))
    };
    let numbers = |all: &[f64]| {
        let all: Vec<String> = all.iter().map(|x| format!("{x:e}")).collect();
        format!("[{}]", all.join(", "))
    };
    let _ = writeln!(text, "format = {FORMAT}");
    let _ = writeln!(text, "readings_version = {READINGS_VERSION}");
    let _ = writeln!(text, "about = \"{ABOUT}\"");
    let readings = names(model.readings.iter().map(|r| r.name()).collect());
    let _ = writeln!(text, "readings = {readings}");
    let levels = names(model.levels.iter().map(|l| l.name()).collect());
    let _ = writeln!(text, "levels = {levels}");
    let _ = writeln!(text, "limit = {}", numbers(&model.limit));
    let triangle = |text: &mut String, name: &str, matrix: &DMatrix<f64>| {
        let _ = writeln!(text, "{name} = [");
        for i in 0..matrix.nrows() {
            let row: Vec<f64> = (0..=i).map(|j| matrix[(i, j)]).collect();
            let _ = writeln!(text, "  {},", numbers(&row));
        }
        let _ = writeln!(text, "]");
    };
    let _ = writeln!(text, "reading_sigma = {}", numbers(&model.reading_sigma));
    if let Some(repeat) = &model.repeat {
        triangle(&mut text, "repeat", repeat);
    }
    for p in &model.populations {
        let _ = writeln!(text, "\n[[population]]\nname = \"{}\"", p.name);
        let _ = writeln!(
            text,
            "scope = \"{}\"\nweight = {:e}",
            p.scope.name(),
            p.weight
        );
        let _ = writeln!(text, "mean = {}", numbers(p.normal.mean.as_slice()));
        triangle(&mut text, "covariance", &p.normal.covariance);
    }
    for law in &model.laws {
        let features = names(law.place.features());
        let place = law.place.name();
        let _ = writeln!(
            text,
            "\n[[law]]\nplace = \"{place}\"\nfeatures = {features}"
        );
        let _ = writeln!(text, "mean = {}", numbers(law.normal.mean.as_slice()));
        triangle(&mut text, "covariance", &law.normal.covariance);
        let _ = writeln!(text, "sigma = {:e}\nlimit = {:e}", law.sigma, law.limit);
        if let Some(repeat) = &law.repeat {
            triangle(&mut text, "repeat", repeat);
        }
    }
    for (name, hash) in tables {
        let _ = writeln!(text, "\n[[table]]\nname = \"{name}\"\nblake3 = \"{hash}\"");
    }
    for h in held_out {
        let _ = writeln!(text, "\n[[held_out]]\n{}", h.lines());
    }
    let _ = writeln!(text, "\n[end]\nheld_out = {}", held_out.len());
    text
}
