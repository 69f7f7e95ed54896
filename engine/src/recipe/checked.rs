//! What is wrong with a pipeline whatever is chosen of it: looked for once, asked for every graph.

use super::mistake::Mistake;
use super::sweep_check;
use super::variant::wrong_variants;
use super::written::Recipe;
use programs::Catalog;

/// What is wrong with variants and sweeps, chosen or not.
pub(super) struct Checked {
    pub(super) variants: Vec<Mistake>,
    pub(super) sweeps: Vec<Mistake>,
}

impl Checked {
    pub(super) fn of(recipe: &Recipe, catalog: &'static Catalog) -> Checked {
        let variants = wrong_variants(recipe);
        let sweeps = sweep_check::check(recipe, variants.is_empty(), catalog);
        Checked { variants, sweeps }
    }
}
