//! A table as Markdown: columns as wide as their widest cell.

/// A table as rows of texts, its head first.
pub(crate) type Table = Vec<Vec<String>>;

/// The table as Markdown (GFM 4.10).
pub(crate) fn markdown(table: &Table) -> String {
    let cell = |cell: &String| cell.replace('|', "\\|").replace('\n', " ");
    let table: Table = table.iter().map(|r| r.iter().map(cell).collect()).collect();
    let width = |i: usize| table.iter().map(|r| r[i].chars().count()).max();
    let widths: Vec<usize> = (0..table[0].len())
        .map(|i| width(i).unwrap_or(0).max(3))
        .collect();
    let line = |row: &Vec<String>| {
        let cells = row.iter().zip(&widths);
        let cells: Vec<String> = cells.map(|(cell, w)| format!("{cell:w$}")).collect();
        format!("| {} |\n", cells.join(" | "))
    };
    let dashes = widths.iter().map(|w| "-".repeat(*w)).collect();
    let body: String = table.iter().skip(1).map(line).collect();
    line(&table[0]) + &line(&dashes) + &body
}
