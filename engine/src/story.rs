//! The lines of a story in one piece: two runs of many nodes are held in memory at once.

use serde::{Deserialize, Deserializer};

/// What a result depends on, line by line: what, and its value.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Story {
    text: Box<str>,
    /// Where each text ends: what and value in turn. \[bytes\]
    ends: Box<[u32]>,
}

impl Story {
    /// The lines in their order.
    pub fn lines(&self) -> impl Iterator<Item = (&str, &str)> {
        let begin = |i: usize| if i == 0 { 0 } else { self.ends[i - 1] as usize };
        let text = move |i: usize| &self.text[begin(i)..self.ends[i] as usize];
        (0..self.ends.len() / 2).map(move |line| (text(2 * line), text(2 * line + 1)))
    }
}

impl<'a> FromIterator<(&'a str, &'a str)> for Story {
    fn from_iter<I: IntoIterator<Item = (&'a str, &'a str)>>(lines: I) -> Story {
        let (mut text, mut ends) = (String::new(), Vec::new());
        for part in lines.into_iter().flat_map(|(what, value)| [what, value]) {
            text += part;
            ends.push(u32::try_from(text.len()).expect("bug: a story of 4 GB"));
        }
        Story {
            text: text.into(),
            ends: ends.into(),
        }
    }
}

impl<'de> Deserialize<'de> for Story {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Story, D::Error> {
        let lines = Vec::<(String, String)>::deserialize(from)?;
        Ok(lines
            .iter()
            .map(|(w, v)| (w.as_str(), v.as_str()))
            .collect())
    }
}

#[cfg(test)]
mod tests {
    use super::Story;

    #[test]
    fn lines_come_back_as_they_were_and_none_passes_for_two() {
        let told = r#"[["with n","1"],["","größe\nx"],["from a",""]]"#;
        let story: Story = serde_json::from_str(told).unwrap();
        let lines: Vec<_> = story.lines().collect();
        assert_eq!(lines, [("with n", "1"), ("", "größe\nx"), ("from a", "")]);
        assert_eq!(story, lines.into_iter().collect());
        assert_ne!(
            story,
            [("with n1", ""), ("größe\nx", "from a")]
                .into_iter()
                .collect()
        );
        assert_eq!(Story::default().lines().count(), 0);
    }
}
