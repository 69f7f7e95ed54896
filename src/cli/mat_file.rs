//! The marker mat that a file of `tailor mat` describes: the print itself, or the TOML beside it.

use command::Fault;
use stage::message;
use std::path::Path;

stage::messages! {
    UNREADABLE = "fail-mat-unreadable": "--mat {file}: {why}";
    NO_MAT = "fail-mat-file": "--mat {file}: it describes no mat; give the file that `tailor mat` wrote (.pdf, .svg or .toml), or give --mat-tag with the edge length of a printed tag's black square";
}

/// Tables of capture.toml that such a file may hold.
const TABLES: [&str; 3] = ["mat", "rim", "disk"];

/// Keys of capture.toml with their values. A PDF has them attached, an SVG as a comment.
pub(super) fn mat_file(file: &Path) -> Result<Vec<(String, toml::Value)>, Fault> {
    let shown = file.display().to_string();
    let unreadable =
        |why: std::io::Error| message!(UNREADABLE, file = &shown, why = why.to_string());
    let bytes = std::fs::read(file).map_err(|why| Fault::coded(&unreadable(why)))?;
    let nothing = || Fault::coded(&message!(NO_MAT, file = &shown));
    let table = text(&bytes).and_then(|toml| toml.parse::<toml::Table>().ok());
    let table = table
        .filter(|t| t.contains_key("mat"))
        .ok_or_else(nothing)?;
    let mut all = Vec::new();
    for name in TABLES {
        let keys = table.get(name).and_then(toml::Value::as_table);
        for (key, value) in keys.into_iter().flatten() {
            all.push((format!("{name}.{key}"), value.clone()));
        }
    }
    Ok(all)
}

/// The TOML that a file holds, from `[mat]` on; prints of before have its lines commented out by `%`.
pub(super) fn text(file: &[u8]) -> Option<String> {
    let text = String::from_utf8_lossy(file);
    let plain = |line: &'_ str| line.trim_start_matches('%').trim().to_owned();
    let lines = text.lines().map(plain).skip_while(|line| line != "[mat]");
    let of_ours = |line: &String| {
        let table = TABLES.iter().any(|t| *line == format!("[{t}]"));
        table || line.is_empty() || line.starts_with('#') || line.contains(" = ")
    };
    let lines: Vec<String> = lines.take_while(of_ours).collect();
    (!lines.is_empty()).then(|| lines.join("\n") + "\n")
}

#[cfg(test)]
mod tests {
    use super::text;

    #[test]
    fn a_mat_is_read_out_of_comments_and_nothing_out_of_nothing() {
        let lines = "[mat]\nfamily = \"tag36h11\"\ntag_size_mm = 60.0\nids = [0, 11]\n[disk]\ndiameter_cm = 45.0\n";
        let pdf = format!(
            "%PDF-1.4\n% {}1 0 obj\n<< /Type >>\n",
            lines.trim_end().replace('\n', "\n% ") + "\n"
        );
        let svg = format!("<svg>\n<!--\n{lines}-->\n<circle r=\"2\"/>\n");
        for file in [lines.to_owned(), pdf, svg] {
            assert_eq!(text(file.as_bytes()).as_deref(), Some(lines), "{file}");
        }
        assert_eq!(text(b"%PDF-1.7\nnothing of ours"), None);
    }
}
