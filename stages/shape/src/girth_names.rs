//! Names and definitions of girths, out of the table.

use crate::girth_id::{GirthId, Side};
use crate::girth_table::{Definition, TABLE};

impl GirthId {
    /// Its row of the table.
    pub fn definition(self) -> &'static Definition {
        let row = TABLE.iter().find(|row| row.id == self.sideless());
        row.expect("bug: a girth without a row in the table")
    }

    /// Its name in files: `WC`, `AC_L`.
    pub fn name(self) -> String {
        let suffix = self.side().map_or("", Side::suffix);
        format!("{}{suffix}", self.definition().name)
    }

    /// What people call it: `upper arm, left`.
    pub fn label(self) -> String {
        let label = self.definition().label;
        match self.side() {
            Some(side) => format!("{label}, {}", side.word()),
            None => label.to_owned(),
        }
    }

    /// The girth of a name in a file; `None` for one that a user declared.
    pub fn named(name: &str) -> Option<GirthId> {
        GirthId::all().find(|id| id.name() == name)
    }

    /// Every girth of the table but [`Own`](GirthId::Own), left and right apart.
    pub fn all() -> impl Iterator<Item = GirthId> {
        let sides = |row: &'static Definition| match row.id {
            GirthId::UpperArm(_) => Side::BOTH.map(GirthId::UpperArm).to_vec(),
            GirthId::Thigh(_) => Side::BOTH.map(GirthId::Thigh).to_vec(),
            GirthId::Calf(_) => Side::BOTH.map(GirthId::Calf).to_vec(),
            GirthId::Own => vec![],
            other => vec![other],
        };
        TABLE.iter().flat_map(sides)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_girth_has_a_row_and_a_name_of_its_own() {
        let mut names: Vec<String> = GirthId::all().map(GirthId::name).collect();
        for (id, name) in GirthId::all().zip(&names) {
            assert_eq!(GirthId::named(name), Some(id), "{name}");
            assert!(!id.definition().sentence.is_empty());
        }
        assert_eq!(GirthId::named("mid_thigh_L"), None);
        assert_eq!(GirthId::UpperArm(Side::Right).name(), "AC_R");
        assert_eq!(GirthId::Calf(Side::Left).label(), "calf, left");
        let count = names.len();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), count);
    }
}
