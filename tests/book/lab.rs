//! The laboratory: each table is between marks or a study's, and its command is above it.

use super::figures::json;
use super::{place, read};
use serde_json::Value;

/// The laboratory's pages with tables of figures, in order.
pub(crate) fn pages() -> Vec<String> {
    let folder = std::fs::read_dir(place("docs/lab")).unwrap();
    let names = folder.map(|e| e.unwrap().file_name().into_string().unwrap());
    let mut pages: Vec<String> = names
        .filter(|n| n.ends_with(".md"))
        .map(|n| format!("docs/lab/{n}"))
        .collect();
    pages.sort();
    pages
}

/// The data of a page that a study writes.
pub(crate) fn data_of(page: &str) -> Option<Value> {
    let data = page.replace(".md", ".json");
    place(&data).exists().then(|| json(&data))
}

/// A number as tables of studies have it.
fn short(x: f64) -> String {
    match x.abs() {
        _ if x.fract() == 0.0 => format!("{x:.0}"),
        a if a >= 100.0 => format!("{x:.1}"),
        a if a >= 1.0 => format!("{x:.2}"),
        _ => format!("{x:.4}"),
    }
}

/// What a row of a study's table is made of.
fn cells(group: &Value) -> Vec<String> {
    let params = group["params"].as_object().unwrap().values();
    let mut cells: Vec<String> = params.map(|p| p.as_str().unwrap().to_owned()).collect();
    let number = |metric: &Value, key: &str| short(metric[key].as_f64().unwrap());
    for metric in group["metrics"].as_array().unwrap() {
        cells.push(format!(
            "{} ± {}",
            number(metric, "mean"),
            number(metric, "sd")
        ));
    }
    cells
}

#[test]
fn studies_are_what_their_data_give() {
    let mut count = 0;
    for page in pages() {
        let Some(data) = data_of(&page) else { continue };
        let (text, name) = (read(&page), data["study"].as_str().unwrap());
        assert!(place(&format!("studies/{name}.toml")).exists(), "{page}");
        let head = format!(
            "# {}\n\n    tailor study run {name}\n\n",
            data["about"].as_str().unwrap()
        );
        assert!(text.starts_with(&head), "{page}: {head}");
        for group in data["groups"].as_array().unwrap() {
            count += 1;
            let row = cells(group).join(" | ");
            let row = format!(" {row} |");
            assert!(text.lines().any(|l| l.ends_with(&row)), "{page}: {row}");
        }
    }
    assert!(count > 20, "only {count} rows were found");
}

/// What a command of the laboratory reads and writes: the program or pipeline, and the file of figures where it has one.
fn of_command(command: &str) -> (String, Option<&str>) {
    let words: Vec<&str> = command.split(' ').collect();
    let after = |word: &str| words.iter().skip_while(|w| **w != word).nth(1).copied();
    let program = match words[..] {
        ["cargo", "bench", "--bench", bench, ..] => format!("benches/{bench}/main.rs"),
        ["cargo", ..] => format!(
            "stages/{}/examples/{}.rs",
            after("-p").expect("a crate"),
            after("--example").expect("a program")
        ),
        ["tailor", "run", pipeline, ..] => pipeline.to_owned(),
        [program, ..] => program.to_owned(),
        [] => unreachable!("a line has a word"),
    };
    (program, after(">").or_else(|| after("--json")))
}

/// Above each table between marks: the command that makes its figures, of a program that is there.
#[test]
fn a_table_has_its_command_above_it() {
    let makes = ["docs/tables/", "cargo bench ", "cargo run ", "tailor run "];
    let mut count = 0;
    for page in pages() {
        let text = read(&page);
        for (at, _) in text.match_indices("<!-- /") {
            count += 1;
            let begin = text[..at].rfind("<!-- ").expect("a mark");
            let lines = text[..begin].lines().rev();
            let mut commands = lines.filter_map(|line| line.strip_prefix("    "));
            let command = commands.find(|l| makes.iter().any(|m| l.starts_with(m)));
            let command =
                command.unwrap_or_else(|| panic!("{page}: no command: {}", &text[begin..at]));
            let (program, written) = of_command(command);
            assert!(place(&program).exists(), "{page}: {program}");
            if program.starts_with("docs/tables/") {
                assert!(read(&program).contains(&page), "{page}: {command}");
            }
            if let Some(written) = written {
                assert!(place(written).exists(), "{page}: {written}");
            }
        }
    }
    assert!(count >= 3, "only {count} tables were found");
}

#[test]
fn sweeps_that_the_laboratory_names_are_declared() {
    let text = read("docs/lab/README.md");
    let sweeps = text.lines().filter_map(|l| l.strip_prefix("tailor sweep "));
    let mut count = 0;
    for sweep in sweeps {
        count += 1;
        let mut words = sweep.split(' ');
        let (file, name) = (words.next().unwrap(), words.next().unwrap());
        let declared = format!("[sweep.{name}]\n");
        assert!(read(file).contains(&declared), "{file}: {declared}");
    }
    assert!(count > 10, "only {count} sweeps were found");
}
