//! A plot, and what it is compared with.

/// A value that plots of a metric show as a line across: the truth, a limit.
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    /// What it is, in a word or two.
    pub label: String,
    /// Where it is, in the metric's unit.
    pub value: f64,
}

/// What a metric is compared with; by its name and unit.
pub type References<'a> = dyn Fn(&str, &str) -> Vec<Reference> + 'a;

/// A plot.
#[derive(Debug, Clone, PartialEq)]
pub struct Plot {
    /// The name of its files, without an ending.
    pub file: String,
    /// What it shows.
    pub title: String,
    /// The drawing.
    pub svg: String,
    /// The numbers: a table with a head.
    pub data: Vec<Vec<String>>,
    /// Names of its lines with their colours, where there are several.
    pub legend: Vec<(String, &'static str)>,
}

/// A name as a file may have it.
pub(super) fn file(parts: &[&str]) -> String {
    let one = |c: char| {
        if c.is_ascii_alphanumeric() || c == '.' || c == '_' {
            c
        } else {
            '-'
        }
    };
    let name: String = parts.join("-over-").chars().map(one).collect();
    name.split('-')
        .filter(|p| !p.is_empty())
        .collect::<Vec<_>>()
        .join("-")
}
