//! Variants, runs and folders of results side by side, each against the first.
//!
//! ```text
//! variant ─ run ─┐                  ┌─ differ: params, first result that is another
//! run of a cache ┼─ Side ─ compare ─┼─ girths: changed or not, and by ISO   ─┬─ words: Markdown, JSON
//! folder ────────┘                  ├─ surfaces: how far apart, everywhere  ─┴─ page: HTML with a view
//!                                   └─ pictures: silhouettes and surfaces as each camera saw them
//! ```

mod cut;
pub(crate) mod girths;
mod laid;
mod page;
mod pictures;
pub(crate) mod render;
pub(crate) mod side;
mod surfaces;
mod views;
pub(crate) mod words;

pub use crate::girth_file::ReadGirth;
pub use engine::differ::{Change, Difference, NodeRun, differ};
pub use engine::provenance::PackedProvenance;
pub use girths::{GirthRow, Judged, TechnicalErrors, girths, mixed};
pub use laid::{Laid, laid};
pub use page::page;
pub use side::{Side, SideError};
pub use surfaces::{Apart, apart};
pub use views::{View, Views};
pub use words::{json, markdown};

/// All that is reported of the sides.
pub struct Comparison {
    /// What is compared, the reference first.
    pub sides: Vec<Side>,
    /// One entry for each side but the first.
    pub differences: Vec<Difference>,
    /// The girths of all sides.
    pub girths: Vec<GirthRow>,
    /// How far each surface is from the first as they are; `None` where a side has none.
    pub apart: Vec<Option<Apart>>,
    /// The same of a body that is placed differently, aligned to the first; `None` where it need not be.
    pub laid: Vec<Option<Laid>>,
}

/// Compares each side with the first. `tolerance_mm` is for all girths; without it each has the
/// limit of ISO 20685-1. `known` errors of repetition take the place of what captures report themselves.
pub fn compare(sides: Vec<Side>, tolerance_mm: Option<f64>, known: &TechnicalErrors) -> Comparison {
    let (first, rest) = sides.split_first().expect("bug: nothing to compare");
    let surface = |side: &Side| Some(apart(first.mesh.as_ref()?, side.mesh.as_ref()?));
    let all: Vec<Option<Apart>> = rest.iter().map(surface).collect();
    let again = |(side, apart): (&Side, &Option<Apart>)| {
        laid(first.mesh.as_ref()?, side.mesh.as_ref()?, apart.as_ref()?)
    };
    Comparison {
        differences: rest
            .iter()
            .map(|side| differ(&first.nodes, &side.nodes))
            .collect(),
        girths: girths(&sides, tolerance_mm, known),
        laid: rest.iter().zip(&all).map(again).collect(),
        apart: all,
        sides,
    }
}
