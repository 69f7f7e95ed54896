//! The points of a sweep as a flat table of typed columns, for files that know types.

use super::cells::{cell, columns, params, trouble};
use engine::sweep::Row;

/// The cells of a column, one a point.
#[derive(Debug, Clone, PartialEq)]
pub enum Cells {
    /// Yes or no.
    Truth(Vec<Option<bool>>),
    /// Whole numbers.
    Whole(Vec<Option<i64>>),
    /// Numbers.
    Number(Vec<Option<f64>>),
    /// Texts.
    Text(Vec<Option<String>>),
}

/// A column.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Its name: of a param `node.param`, of a number `node.metric`.
    pub name: String,
    /// The unit of its numbers.
    pub unit: String,
    /// Its cells.
    pub cells: Cells,
}

/// All columns: what varies, what was reported, what it cost, why a point came to nothing.
pub fn typed(rows: &[Row]) -> Vec<Column> {
    let column = |name: &str, unit: &str, cells: Cells| Column {
        name: name.into(),
        unit: unit.into(),
        cells,
    };
    let named: Vec<Vec<(String, String)>> = rows.iter().map(params).collect();
    let mut all = Vec::new();
    for (name, _) in named.first().into_iter().flatten() {
        let text = |row: &Vec<(String, String)>| {
            let found = row.iter().find(|(n, _)| n == name);
            found.map(|(_, value)| value.clone())
        };
        all.push(column(name, "", parsed(named.iter().map(text).collect())));
    }
    for (name, unit) in columns(rows) {
        let cells = rows.iter().map(|row| cell(row, &name)).collect();
        all.push(column(&name, &unit, Cells::Number(cells)));
    }
    let counts = |of: fn(&Row) -> usize| {
        let counts = rows.iter().map(|row| Some(of(row) as i64));
        Cells::Whole(counts.collect())
    };
    let times = |of: fn(&Row) -> f64| Cells::Number(rows.iter().map(|row| Some(of(row))).collect());
    all.push(column("made", "", counts(|row| row.made)));
    all.push(column("found", "", counts(|row| row.found)));
    all.push(column("seconds", "s", times(|row| row.seconds)));
    all.push(column("engine_seconds", "s", times(|row| row.engine)));
    all.push(column("alone_seconds", "s", times(|row| row.alone)));
    let why = rows.iter().map(trouble).collect();
    all.push(column("trouble", "", Cells::Text(why)));
    all
}

/// Texts as what all of them are.
fn parsed(texts: Vec<Option<String>>) -> Cells {
    fn of<T: std::str::FromStr>(texts: &[Option<String>]) -> Option<Vec<Option<T>>> {
        let one = |text: &Option<String>| match text {
            None => Some(None),
            Some(text) => text.parse().ok().map(Some),
        };
        texts.iter().map(one).collect()
    }
    if let Some(all) = of(&texts) {
        return Cells::Truth(all);
    }
    if let Some(all) = of(&texts) {
        return Cells::Whole(all);
    }
    of(&texts).map_or(Cells::Text(texts), Cells::Number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_of_the_type_that_all_their_texts_have() {
        let texts = |all: &[&str]| all.iter().map(|t| Some((*t).to_owned())).collect();
        assert_eq!(
            parsed(texts(&["1", "2"])),
            Cells::Whole(vec![Some(1), Some(2)])
        );
        assert_eq!(
            parsed(texts(&["1", "2.5"])),
            Cells::Number(vec![Some(1.0), Some(2.5)])
        );
        assert_eq!(parsed(texts(&["true"])), Cells::Truth(vec![Some(true)]));
        let words = texts(&["1", "rigid"]);
        assert_eq!(parsed(words), Cells::Text(texts(&["1", "rigid"])));
        let one_is_missing = vec![Some("3".to_owned()), None];
        assert_eq!(parsed(one_is_missing), Cells::Whole(vec![Some(3), None]));
    }
}
