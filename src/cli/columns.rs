//! How wide lines are: as a terminal is, if it is narrow, else as a page of text; in a pipe always so.

use console::Term;

/// Lines are broken before this column: a terminal's as it comes, and what a page of text takes (structural).
pub(super) const WIDTH: usize = 80;

/// The columns that are used of what is printed: those of a terminal that has fewer than usual.
pub(super) fn wide() -> usize {
    columns(&Term::stdout())
}

/// The same of what is printed beside it.
pub(super) fn wide_err() -> usize {
    columns(&Term::stderr())
}

fn columns(term: &Term) -> usize {
    let known = term.size_checked().filter(|(_, columns)| *columns > 0);
    known.map_or(WIDTH, |(_, columns)| usize::from(columns).min(WIDTH))
}

/// The line in pieces of so many columns, the later ones set in.
pub(super) fn broken(line: &str, indent: usize, columns: usize) -> String {
    let (mut text, mut column) = (String::new(), 0);
    let lead = line.len() - line.trim_start().len();
    text += &line[..lead];
    for word in line[lead..].split_inclusive(' ') {
        let long = word.trim_end().chars().count();
        if column > 0 && lead + column + long > columns {
            text.truncate(text.trim_end().len());
            text += &format!("\n{:indent$}", "");
            column = indent - lead;
        }
        text += word;
        column += word.chars().count();
    }
    text + "\n"
}
