//! Self-contained pages: one file, no network, light and dark.

const STYLE: &str = include_str!("page.css");

/// Text as HTML.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

/// A page: its title, its body as HTML, data for its script, and the script.
pub fn page(title: &str, body: &str, data: &serde_json::Value, script: &str) -> String {
    let title = escaped(title);
    // So that no text in the data can end the element.
    let data = data.to_string().replace('<', "\\u003c");
    format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\
         <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\
         <title>{title}</title>\n<style>{STYLE}</style></head>\n<body>\n{body}\n\
         <script type=\"application/json\" id=\"data\">{data}</script>\n<script>{script}</script>\n</body></html>\n"
    )
}

/// A table; cells are texts, and those that are numbers are aligned to the right. A row is called `ID-0` and so on.
pub fn table(id: &str, head: &[String], rows: &[Vec<String>]) -> String {
    table_with(id, head, rows, &|_| String::new())
}

/// A table with something more behind each row, as HTML.
pub fn table_with(
    id: &str,
    head: &[String],
    rows: &[Vec<String>],
    more: &dyn Fn(usize) -> String,
) -> String {
    let number =
        |cell: &str| cell.starts_with(|c: char| c.is_ascii_digit() || c == '-' || c == '+');
    let class = |cell: &str| if number(cell) { " class=\"n\"" } else { "" };
    let head: String = head
        .iter()
        .map(|c| format!("<th>{}</th>", escaped(c)))
        .collect();
    let mut html = format!("<table id=\"{id}\"><thead><tr>{head}</tr></thead><tbody>\n");
    for (i, row) in rows.iter().enumerate() {
        let cells: String = row
            .iter()
            .map(|c| format!("<td{}>{}</td>", class(c), escaped(c)))
            .collect();
        let called = match id.is_empty() {
            true => String::new(),
            false => format!(" id=\"{id}-{i}\""),
        };
        html += &format!("<tr{called} data-row=\"{i}\">{cells}{}</tr>\n", more(i));
    }
    html + "</tbody></table>"
}

#[cfg(test)]
mod tests {
    #[test]
    fn no_text_can_end_the_script() {
        let data = serde_json::json!({ "name": "</script><script>alert(1)</script>" });
        let page = super::page("<b>", "", &data, "");
        assert_eq!(page.matches("<script").count(), 2);
        assert!(page.contains("<title>&lt;b&gt;</title>"));
    }
}
