//! The lines of what a result depends on, in one piece: two runs of many nodes are in memory at once.

use serde::{Deserialize, Deserializer};

/// What a result depends on, line by line: what, and its value.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct PackedProvenance {
    text: Box<str>,
    /// Where each text ends: what and value in turn. \[bytes\]
    ends: Box<[u32]>,
}

impl PackedProvenance {
    /// The lines in their order.
    pub fn lines(&self) -> impl Iterator<Item = (&str, &str)> {
        let begin = |i: usize| if i == 0 { 0 } else { self.ends[i - 1] as usize };
        let text = move |i: usize| &self.text[begin(i)..self.ends[i] as usize];
        (0..self.ends.len() / 2).map(move |line| (text(2 * line), text(2 * line + 1)))
    }
}

impl<'a> FromIterator<(&'a str, &'a str)> for PackedProvenance {
    fn from_iter<I: IntoIterator<Item = (&'a str, &'a str)>>(lines: I) -> PackedProvenance {
        let (mut text, mut ends) = (String::new(), Vec::new());
        for part in lines.into_iter().flat_map(|(what, value)| [what, value]) {
            text += part;
            ends.push(u32::try_from(text.len()).expect("bug: a provenance of 4 GB"));
        }
        PackedProvenance {
            text: text.into(),
            ends: ends.into(),
        }
    }
}

impl<'de> Deserialize<'de> for PackedProvenance {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<PackedProvenance, D::Error> {
        let lines = Vec::<(String, String)>::deserialize(from)?;
        Ok(lines
            .iter()
            .map(|(w, v)| (w.as_str(), v.as_str()))
            .collect())
    }
}

#[cfg(test)]
mod tests {
    use super::PackedProvenance;

    #[test]
    fn lines_come_back_as_they_were_and_none_passes_for_two() {
        let json = r#"[["with n","1"],["","größe\nx"],["from a",""]]"#;
        let provenance: PackedProvenance = serde_json::from_str(json).unwrap();
        let lines: Vec<_> = provenance.lines().collect();
        assert_eq!(lines, [("with n", "1"), ("", "größe\nx"), ("from a", "")]);
        assert_eq!(provenance, lines.into_iter().collect());
        assert_ne!(
            provenance,
            [("with n1", ""), ("größe\nx", "from a")]
                .into_iter()
                .collect()
        );
        assert_eq!(PackedProvenance::default().lines().count(), 0);
    }
}
