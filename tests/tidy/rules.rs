//! What every file of the house keeps to.

use std::path::{Path, PathBuf};

/// Every Rust file that we wrote.
pub(super) fn sources() -> Vec<(PathBuf, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut open = [
        "src", "engine", "stages", "study", "tests", "benches", "python",
    ]
    .map(|d| root.join(d))
    .to_vec();
    let mut found = Vec::new();
    while let Some(folder) = open.pop() {
        let Ok(entries) = std::fs::read_dir(&folder) else {
            continue;
        };
        for path in entries.map(|e| e.unwrap().path()) {
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|e| e == "rs") {
                let text = std::fs::read_to_string(&path).unwrap();
                found.push((path.strip_prefix(root).unwrap().to_path_buf(), text));
            }
        }
    }
    found.sort();
    assert!(
        found.len() > 20,
        "the house has more than {} files",
        found.len()
    );
    found
}

/// The files that break a rule.
pub(crate) fn breakers(rule: impl Fn(&Path, &str) -> bool) -> Vec<PathBuf> {
    sources()
        .into_iter()
        .filter(|(path, text)| rule(path, text))
        .map(|(path, _)| path)
        .collect()
}

#[test]
fn every_file_begins_with_what_it_is() {
    assert_eq!(
        breakers(|_, text| !text.starts_with("//! ")),
        Vec::<PathBuf>::new()
    );
}

#[test]
fn no_file_is_longer_than_three_hundred_lines() {
    assert_eq!(
        breakers(|_, text| text.lines().count() > 300),
        Vec::<PathBuf>::new()
    );
}

/// Each function of a file as rustfmt lays it out, and its lines, from `fn` to the brace that closes it.
fn functions(text: &str) -> Vec<(&str, usize)> {
    let lines: Vec<&str> = text.lines().collect();
    let name = |line: &'_ str| -> Option<usize> {
        let words = [
            "pub",
            "pub(crate)",
            "pub(super)",
            "const",
            "async",
            "unsafe",
        ];
        let before = line.split_whitespace().take_while(|w| *w != "fn");
        let declared = line.trim_start().starts_with("fn ") || line.contains(" fn ");
        (declared && before.into_iter().all(|w| words.contains(&w))).then(|| line.find("fn "))?
    };
    let one = |(first, line): (usize, &&'_ str)| {
        let at = name(line)? + "fn ".len();
        let rest = &lines[first][at..];
        let indent = &line[..line.len() - line.trim_start().len()];
        let closes = |l: &&str| *l == format!("{indent}}}");
        // A signature ends where its body begins, or with a semicolon in a trait.
        let head = lines[first..]
            .iter()
            .position(|l| l.ends_with(['{', ';', '}']))?;
        let body = match lines[first + head].ends_with('{') {
            true => lines[first + head..].iter().position(closes)?,
            false => 0,
        };
        Some((rest.split(['(', '<']).next()?, head + body + 1))
    };
    lines.iter().enumerate().filter_map(one).collect()
}

#[test]
fn lines_of_functions_are_counted() {
    let text = "\
impl A {
    pub(crate) fn one(
        a: u8,
    ) -> u8 {
        if a > 1 {
            return 1;
        }
        a
    }

    fn two(&self) {}
}

trait B {
    fn three(&self);
}
";
    assert_eq!(functions(text), [("one", 8), ("two", 1), ("three", 1)]);
}

#[test]
fn no_function_is_longer_than_eighty_lines() {
    let mut long = Vec::new();
    for (path, text) in sources() {
        let of_file = functions(&text).into_iter();
        let over = of_file.filter(|(_, lines)| *lines > 80);
        long.extend(over.map(|(name, lines)| format!("{}: {name}, {lines}", path.display())));
    }
    assert_eq!(long, Vec::<String>::new());
}

#[test]
fn nothing_is_called_util() {
    let names = ["util", "utils", "common", "helpers", "misc"];
    let named = |path: &Path, _: &str| {
        path.iter().any(|part| {
            names
                .iter()
                .any(|n| Path::new(part).file_stem() == Some(n.as_ref()))
        })
    };
    assert_eq!(breakers(named), Vec::<PathBuf>::new());
}

#[test]
fn no_stages_crate_knows_another() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("stages");
    let allowed = |name: &str| match name {
        "stage" | "proof" => &[][..],
        "shape" => &["stage"][..],
        _ => &["stage", "shape"][..],
    };
    let crates: Vec<String> = std::fs::read_dir(&root)
        .unwrap()
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .collect();
    for name in &crates {
        let manifest = std::fs::read_to_string(root.join(name).join("Cargo.toml")).unwrap();
        let product = manifest.split("[dev-dependencies]").next().unwrap();
        for other in crates
            .iter()
            .filter(|other| !allowed(name).contains(&other.as_str()))
        {
            let arrow = format!("\n{other}.workspace");
            assert!(!product.contains(&arrow), "{name} must not know {other}");
        }
    }
}

#[test]
fn a_kernel_knows_no_stage() {
    let kernel = |path: &Path, text: &str| {
        let step = path.starts_with("stages")
            && !path.starts_with("stages/stage")
            && !path.starts_with("stages/shape")
            && path.iter().any(|part| part == "src");
        let product = text.split("#[cfg(test)]").next().unwrap();
        step && !product.contains("impl Stage for")
            && ["Ctx", "Stop"].iter().any(|word| {
                product
                    .split(|c: char| !c.is_alphanumeric() && c != '_')
                    .any(|w| w == *word)
            })
    };
    assert_eq!(breakers(kernel), Vec::<PathBuf>::new());
}

#[test]
fn only_the_catalog_names_the_crates_of_stages() {
    let crates = [
        "capture",
        "pose",
        "silhouette",
        "hull",
        "refine",
        "measure",
        "report",
        "synth",
    ];
    let names = |path: &Path, text: &str| {
        path.starts_with("src")
            && path != Path::new("src/catalog.rs")
            && crates.iter().any(|c| text.contains(&format!("{c}::")))
    };
    assert_eq!(breakers(names), Vec::<PathBuf>::new());
}

#[test]
fn every_case_of_the_engine_has_a_test_that_is_there() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let table = std::fs::read_to_string(root.join("docs/lab/engine.md")).unwrap();
    let rows: Vec<&str> = table.lines().filter(|l| l.starts_with("| T")).collect();
    assert_eq!(rows.len(), 46, "T1 to T18 and T21 to T48");
    let sources = sources();
    let faults = std::fs::read_to_string(root.join("docs/lab/cluster.md")).unwrap();
    let faults: Vec<&str> = faults.lines().filter(|l| l.ends_with("` |")).collect();
    assert!(faults.len() > 6, "{faults:?}");
    for row in rows.into_iter().chain(faults) {
        let row = row
            .trim_end_matches(" |")
            .rsplit_once("| ")
            .map_or(row, |r| r.1);
        let mut tests = row.split('`').skip(1).step_by(2).peekable();
        assert!(tests.peek().is_some(), "{row}");
        // Those in Python are in `python/tests/test_store.py`.
        for test in tests.filter(|t| !t.contains(' ') && !t.starts_with("test_")) {
            let name = format!("\nfn {test}() {{");
            let is_test = |text: &str| {
                let before = text.find(&name).map(|at| &text[..at]);
                let mut lines = before.into_iter().flat_map(|b| b.lines().rev());
                lines
                    .by_ref()
                    .take_while(|l| l.starts_with("#["))
                    .any(|l| l == "#[test]")
            };
            assert!(sources.iter().any(|(_, text)| is_test(text)), "{test}");
        }
    }
}

/// The names of metrics that a file of a stage reports, as they are written there.
fn metrics_reported(text: &str) -> Vec<&str> {
    let calls = text.split(".metric(").skip(1);
    let first = calls.map(|call| call.trim_start().trim_start_matches("&format!("));
    let literal = first.filter_map(|call| call.strip_prefix('"')?.split('"').next());
    literal.collect()
}

#[test]
fn every_metric_that_a_stage_reports_is_declared() {
    let mut count = 0;
    let sources = sources();
    let stages = sources
        .iter()
        .filter(|(path, _)| path.starts_with("stages") && !path.starts_with("stages/stage"));
    for (path, text) in stages {
        let declared = text.split("const METRICS").nth(1).unwrap_or_default();
        let declared: Vec<&str> = declared.split(';').next().unwrap().split('"').collect();
        for name in metrics_reported(text) {
            let fits = match name.contains('{') {
                true => declared.iter().any(|d| d.contains('*')),
                false => declared.contains(&name),
            };
            assert!(fits, "{}: METRICS do not name `{name}`", path.display());
            count += 1;
        }
    }
    assert!(count > 40, "only {count} metrics were found");
}
