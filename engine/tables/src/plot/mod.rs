//! Plots of a sweep, each an SVG and the numbers that it shows: small multiples of each metric over each param, heat maps
//! over two params, all columns as parallel axes.
//!
//! Arrows: `plotted`, `scale`, `svg` ← `field` ← `line`, `heat`, `parallel` ← this file.

mod field;
mod heat;
mod line;
mod parallel;
mod plotted;
mod scale;
mod svg;

use super::spread::Group;
use field::Field;
pub use plotted::{Plot, Reference, References};

/// More plots than this are no help on a page.
const MOST_PLOTS: usize = 60;

/// All plots of some points: lines first, then heat maps, then parallel axes.
pub(super) fn plots(groups: &[Group], references: &References<'_>) -> Vec<Plot> {
    let field = Field::new(groups, references);
    let mut all = Vec::new();
    for metric in 0..field.metrics.len() {
        for param in 0..field.params.len() {
            all.extend(line::line(&field, param, metric));
        }
    }
    for metric in 0..field.metrics.len() {
        all.extend(heat::heat(&field, metric));
    }
    all.truncate(MOST_PLOTS);
    all.extend(parallel::parallel(&field));
    all
}
