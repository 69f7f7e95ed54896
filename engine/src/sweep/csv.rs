//! Tables of points: `node.param` at the head of each column, one point a line.

use super::axis::{Axis, AxisError};
use crate::recipe::parse_value;
use std::path::Path;

/// The cells of a line: separated by commas outside of quotes and brackets.
pub(super) fn cells(line: &str) -> Vec<String> {
    let (mut cells, mut quoted, mut depth) = (vec![String::new()], false, 0i32);
    for c in line.chars() {
        match c {
            '"' => quoted = !quoted,
            '[' if !quoted => depth += 1,
            ']' if !quoted => depth -= 1,
            ',' if !quoted && depth <= 0 => {
                cells.push(String::new());
                continue;
            }
            _ => {}
        }
        cells.last_mut().expect("bug: no cell").push(c);
    }
    cells.iter().map(|c| c.trim().to_owned()).collect()
}

/// A file of points as one axis.
pub(super) fn table(path: &Path) -> Result<Axis, AxisError> {
    let wrong = |why: String| AxisError::Table {
        file: path.display().to_string(),
        why,
    };
    let text = std::fs::read_to_string(path).map_err(|e| wrong(format!("cannot be read: {e}")))?;
    parse(&text).map_err(wrong)
}

fn parse(text: &str) -> Result<Axis, String> {
    let text = text.trim_start_matches('\u{feff}');
    let mut lines = text
        .lines()
        .enumerate()
        .filter(|(_, l)| !l.trim().is_empty() && !l.starts_with('#'));
    let (_, head) = lines
        .next()
        .ok_or("is empty: the first line names node.param, one a column")?;
    let param = |cell: &String| {
        let pair = cell.split_once('.');
        pair.map(|(n, p)| (n.to_owned(), p.to_owned()))
            .ok_or(format!("`{cell}` heads a column; it should be node.param"))
    };
    let params: Vec<_> = cells(head).iter().map(param).collect::<Result<_, _>>()?;
    let mut rows = Vec::new();
    for (number, line) in lines {
        let cells = cells(line);
        if cells.len() != params.len() {
            let (got, want) = (cells.len(), params.len());
            return Err(format!(
                "line {} has {got} cells, but {want} columns are named",
                number + 1
            ));
        }
        rows.push(cells.iter().map(|c| parse_value(c)).collect());
    }
    match rows.is_empty() {
        true => Err("names columns, but no point".into()),
        false => Ok(Axis { params, rows }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_is_read_cell_by_cell_and_errors_name_the_place() {
        let axis = parse("a.x, b.y\n# a comment\n1, \"p, q\"\n\n2.5, [1, 2]\n").unwrap();
        assert_eq!(
            axis.params,
            [("a".into(), "x".into()), ("b".into(), "y".into())]
        );
        let cells: Vec<String> = axis.rows.iter().flatten().map(|v| v.to_string()).collect();
        assert_eq!(cells, ["1", "\"p, q\"", "2.5", "[1, 2]"]);
        for (text, what) in [
            ("", "is empty"),
            ("ax\n1\n", "`ax` heads"),
            ("a.x\n", "no point"),
            ("a.x,a.y\n1,2\n3\n", "line 3 has 1 cells"),
        ] {
            let error = parse(text).unwrap_err();
            assert!(error.contains(what), "{error}");
        }
    }
}
