//! `[variant.NAME]`: its keys.

use super::read::Reader;
use super::tree::Spot;
use super::written::{Spanned, Variant};

impl Reader {
    pub(super) fn variant(&mut self, name: Spanned<String>, value: &Spot<'_>) -> Variant {
        let mut v = Variant {
            name,
            about: String::new(),
            with: vec![],
            stage: vec![],
            from: vec![],
            without: vec![],
        };
        for (key, value) in self.table(value, "a variant") {
            match &*key.name {
                "about" => v.about = self.text(value, "`about`").value,
                "without" => v.without = self.texts(value, "a node"),
                "with" => {
                    let nodes = self.table(value, "`with` of a variant");
                    v.with = nodes
                        .iter()
                        .map(|(node, w)| (node.spanned(), self.with(w)))
                        .collect();
                }
                "stage" => {
                    let nodes = self.table(value, "`stage` of a variant");
                    v.stage = nodes
                        .iter()
                        .map(|(n, s)| (n.spanned(), self.text(s, "a stage")))
                        .collect();
                }
                "from" => {
                    let nodes = self.table(value, "`from` of a variant");
                    v.from = nodes
                        .iter()
                        .map(|(node, f)| (node.spanned(), self.from(f)))
                        .collect();
                }
                _ => self.unknown_key(key, &["about", "with", "without", "stage", "from"]),
            }
        }
        v
    }
}
