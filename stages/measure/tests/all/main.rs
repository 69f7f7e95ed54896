//! All tests of `measure` in one program: each takes long to link.

mod arms_at_sides;
mod bad_input;
mod bodies;
mod causes;
mod clothes;
mod covered;
mod cut_off;
mod declared;
mod disputed;
mod ground;
mod level_model;
mod levels;
mod limbs;
#[path = "../made/mod.rs"]
mod made;
mod made_girths;
mod nearly_touching;
mod necks;
mod refit;
mod sections;
mod silhouettes;
mod touching;
