//! Tables that models are fitted on: CSV with a header, a column a variable, a row a body.

use std::collections::BTreeMap;

/// What is wrong with a table.
#[derive(Debug, thiserror::Error)]
pub enum TableError {
    /// No table of that name.
    #[error("there is no {0} among the files")]
    Missing(String),
    /// Not CSV.
    #[error("{name} cannot be read as CSV: {why}")]
    Csv {
        /// The file.
        name: String,
        /// What the reader reports, with the line.
        why: String,
    },
    /// A column that is not there.
    #[error("{name} has no column `{column}`")]
    Column {
        /// The file.
        name: String,
        /// The column.
        column: String,
    },
    /// What should be a number.
    #[error("{name}, row {row}, `{column}`: `{value}` is no number")]
    Number {
        /// The file.
        name: String,
        /// The row, 1 for the first below the header.
        row: usize,
        /// The column.
        column: String,
        /// What is there.
        value: String,
    },
    /// Too few rows of a kind.
    #[error("{name} has {rows} rows of {what}, but a fit needs at least {least}")]
    Short {
        /// The file.
        name: String,
        /// How many there are.
        rows: usize,
        /// Of what.
        what: String,
        /// How many are needed.
        least: usize,
    },
}

/// A table: cells as text, by column.
#[derive(Debug, Clone, Default)]
pub(crate) struct Table {
    /// What errors call it.
    pub name: String,
    columns: BTreeMap<String, usize>,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// Reads a table.
    pub(crate) fn read(name: &str, bytes: &[u8]) -> Result<Table, TableError> {
        let wrong = |e: csv::Error| TableError::Csv {
            name: name.into(),
            why: e.to_string(),
        };
        let mut reader = csv::Reader::from_reader(bytes);
        let header = reader.headers().map_err(wrong)?.clone();
        let columns = header.iter().enumerate().map(|(i, c)| (c.to_owned(), i));
        let columns = columns.collect();
        let mut rows = Vec::new();
        for record in reader.records() {
            rows.push(record.map_err(wrong)?.iter().map(str::to_owned).collect());
        }
        Ok(Table {
            name: name.into(),
            columns,
            rows,
        })
    }

    /// A table that is checked in.
    #[cfg(test)]
    pub(crate) fn checked_in(name: &str) -> Table {
        let tables = concat!(env!("CARGO_MANIFEST_DIR"), "/../../models/tables");
        let bytes = std::fs::read(std::path::Path::new(tables).join(name)).unwrap();
        Table::read(name, &bytes).unwrap()
    }

    /// How many rows.
    pub(crate) fn len(&self) -> usize {
        self.rows.len()
    }

    /// A column as text.
    pub(crate) fn text(&self, column: &str) -> Result<Vec<&str>, TableError> {
        let at = self.columns.get(column).ok_or_else(|| TableError::Column {
            name: self.name.clone(),
            column: column.into(),
        })?;
        Ok(self.rows.iter().map(|r| r[*at].as_str()).collect())
    }

    /// A column of numbers; an empty cell is `None`.
    pub(crate) fn optional(&self, column: &str) -> Result<Vec<Option<f64>>, TableError> {
        let number = |(i, cell): (usize, &str)| match cell.trim() {
            "" => Ok(None),
            text => match text.parse::<f64>().ok().filter(|x| x.is_finite()) {
                Some(x) => Ok(Some(x)),
                None => Err(TableError::Number {
                    name: self.name.clone(),
                    row: i + 1,
                    column: column.into(),
                    value: text.into(),
                }),
            },
        };
        self.text(column)?
            .into_iter()
            .enumerate()
            .map(number)
            .collect()
    }

    /// Columns of numbers whose names are a word and digits, in the order of their names; an empty cell is
    /// `None`.
    pub(crate) fn starting_with(&self, word: &str) -> Result<Vec<Vec<Option<f64>>>, TableError> {
        let digits = |c: &&String| {
            let rest = c.strip_prefix(word);
            rest.is_some_and(|r| !r.is_empty() && r.bytes().all(|b| b.is_ascii_digit()))
        };
        let columns = self.columns.keys().filter(digits);
        columns.map(|c| self.optional(c)).collect()
    }

    /// A column of numbers, each of them there.
    pub(crate) fn numbers(&self, column: &str) -> Result<Vec<f64>, TableError> {
        let all = self.optional(column)?.into_iter().enumerate();
        let there = |(i, x): (usize, Option<f64>)| {
            x.ok_or_else(|| TableError::Number {
                name: self.name.clone(),
                row: i + 1,
                column: column.into(),
                value: String::new(),
            })
        };
        all.map(there).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_numbers_or_empty_and_what_is_neither_is_named_with_its_place() {
        let table = Table::read("t.csv", b"a,b\n1,\n2,x\n").unwrap();
        assert_eq!(table.numbers("a").unwrap(), [1.0, 2.0]);
        let stated = table.optional("b").unwrap_err().to_string();
        assert_eq!(stated, "t.csv, row 2, `b`: `x` is no number");
        assert!(
            table
                .numbers("c")
                .unwrap_err()
                .to_string()
                .contains("no column `c`")
        );
        assert!(Table::read("t.csv", b"a,b\n1\n").is_err());
        assert!(
            Table::read("t.csv", b"a\nNaN\n")
                .unwrap()
                .numbers("a")
                .is_err()
        );
    }
}
