//! Tables for spreadsheets (RFC 4180): the one place that writes them, and knows what a spreadsheet takes for a formula.

use csv::Writer;

/// A table as CSV, a row a line, the head first; all rows have as many cells as the head.
///
/// Names come from users and from folders, and a spreadsheet runs a text that begins like a formula
/// (CWE-1236): such a text gets an apostrophe before it. What reads as a number stays as it is, `-1.5`, too.
pub fn csv_table(rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let mut table = Writer::from_writer(Vec::new());
    for row in rows {
        let row = row.into_iter().map(harmless);
        table
            .write_record(row.collect::<Vec<_>>())
            .expect("bug: a row of another length");
    }
    let bytes = table.into_inner().expect("bug: memory is full");
    String::from_utf8(bytes).expect("bug: texts are UTF-8")
}

/// A cell that no spreadsheet takes for a formula.
fn harmless(text: String) -> String {
    let begins = text.starts_with(['=', '+', '-', '@', '\t', '\r']);
    match begins && text.parse::<f64>().is_err() {
        true => format!("'{text}"),
        false => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(cells: &[&str]) -> String {
        csv_table([cells.iter().map(|c| (*c).to_owned()).collect()])
    }

    #[test]
    fn no_text_becomes_a_formula_or_another_cell_and_numbers_stay_numbers() {
        assert_eq!(
            line(&["=1+1", "+cmd", "-a", "@x", "\tb"]),
            "'=1+1,'+cmd,'-a,'@x,'\tb\n"
        );
        assert_eq!(line(&["-1.5", "+0.3", "-2e-3", ""]), "-1.5,+0.3,-2e-3,\n");
        assert_eq!(
            line(&["a,\"b\"", "two\nlines", "Anna = B"]),
            "\"a,\"\"b\"\"\",\"two\nlines\",Anna = B\n"
        );
        assert_eq!(line(&["=HYPERLINK(\"x\")"]), "\"'=HYPERLINK(\"\"x\"\")\"\n");
    }
}
