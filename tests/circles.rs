//! No module of a crate reads another that reads it, directly or around several corners.
//!
//! Read off what files name as `crate::MODULE`; the modules are those right below a crate's root.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Which modules each module reads.
type Reads = BTreeMap<String, BTreeSet<String>>;

/// Circles that are there and are to go: of each the modules, in the order of their names.
const KNOWN: &[(&str, &[&str])] = &[
    ("capture", &["alike", "load"]),
    ("capture", &["rig", "rig_tags"]),
    (
        "pose",
        &[
            "any_order",
            "calibrate",
            "from_mat",
            "from_rim",
            "from_tracks",
            "solved",
            "tag_bloom",
            "trust",
            "turn_trial",
        ],
    ),
    ("pose", &["epipolar", "five_point"]),
    ("pose", &["residual", "rim", "ring", "scene"]),
    ("pose", &["sift_describe", "sift_detect"]),
    ("refine", &["look", "patch"]),
    ("refine", &["round", "settle_stage"]),
    ("shape", &["girth_id", "girth_table"]),
    ("silhouette", &["disk_colors", "turn"]),
    ("silhouette", &["empty", "grabcut"]),
];

fn files(folder: &Path) -> Vec<PathBuf> {
    let (mut open, mut found) = (vec![folder.to_owned()], Vec::new());
    while let Some(folder) = open.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            match path.is_dir() {
                true => open.push(path),
                false if path.extension().is_some_and(|e| e == "rs") => found.push(path),
                false => {}
            }
        }
    }
    found
}

/// The module right below the root that a file belongs to; none for the root itself.
fn module(src: &Path, file: &Path) -> Option<String> {
    let inner = file.strip_prefix(src).unwrap();
    let first = Path::new(inner.iter().next().unwrap()).file_stem().unwrap();
    let name = first.to_str().unwrap();
    (!["lib", "main"].contains(&name)).then(|| name.to_owned())
}

/// The names that follow `crate::`, those in braces one by one.
fn named(text: &str) -> BTreeSet<String> {
    let word = |text: &str| -> String {
        let letters = text.trim_start().chars();
        letters
            .take_while(|c| c.is_alphanumeric() || *c == '_')
            .collect()
    };
    let mut names = BTreeSet::new();
    // Tests may read what they like.
    let product = text.split("#[cfg(test)]\nmod").next().unwrap();
    let lines = product
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"));
    let product: String = lines.collect::<Vec<_>>().join("\n");
    for rest in product.split("crate::").skip(1) {
        let Some(braces) = rest.strip_prefix('{') else {
            names.insert(word(rest));
            continue;
        };
        let (mut depth, mut start) = (0, 0);
        for (at, c) in braces.char_indices() {
            match c {
                '{' => depth += 1,
                '}' if depth > 0 => depth -= 1,
                ',' | '}' if depth == 0 => {
                    names.insert(word(&braces[start..at]));
                    start = at + 1;
                    if c == '}' {
                        break;
                    }
                }
                _ => {}
            }
        }
    }
    names
}

fn reads(src: &Path) -> Reads {
    let all = files(src);
    let modules: BTreeSet<String> = all.iter().filter_map(|file| module(src, file)).collect();
    let mut reads = Reads::new();
    for file in &all {
        let Some(own) = module(src, file) else {
            continue;
        };
        let names = named(&std::fs::read_to_string(file).unwrap());
        let others = names
            .into_iter()
            .filter(|n| modules.contains(n) && *n != own);
        reads.entry(own.clone()).or_default().extend(others);
    }
    reads
}

/// All that a module reads, directly or not.
fn reached<'a>(reads: &'a Reads, from: &str) -> BTreeSet<&'a str> {
    let (mut open, mut seen) = (vec![from], BTreeSet::new());
    while let Some(at) = open.pop() {
        for next in reads.get(at).into_iter().flatten() {
            if seen.insert(next.as_str()) {
                open.push(next);
            }
        }
    }
    seen
}

/// Modules that reach each other.
fn circles(reads: &Reads) -> BTreeSet<Vec<String>> {
    let mut found = BTreeSet::new();
    for module in reads.keys() {
        let reach = reached(reads, module);
        if reach.contains(module.as_str()) {
            let ring = reach
                .into_iter()
                .filter(|m| reached(reads, m).contains(module.as_str()));
            found.insert(ring.map(str::to_owned).collect());
        }
    }
    found
}

#[test]
fn no_module_reads_one_that_reads_it() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut crates = vec![("tailor".to_owned(), root.join("src"))];
    crates.push(("engine".into(), root.join("engine/src")));
    for room in std::fs::read_dir(root.join("stages")).unwrap() {
        let room = room.unwrap();
        let name = room.file_name().into_string().unwrap();
        crates.push((name, room.path().join("src")));
    }
    let (mut found, mut modules) = (Vec::new(), 0);
    for (name, src) in crates {
        let reads = reads(&src);
        modules += reads.len();
        found.extend(circles(&reads).into_iter().map(|ring| (name.clone(), ring)));
    }
    assert!(modules > 100, "only {modules} modules were found");
    found.sort();
    let known = KNOWN.iter().map(|(name, ring)| {
        let ring: Vec<String> = ring.iter().map(|m| (*m).to_owned()).collect();
        ((*name).to_owned(), ring)
    });
    let mut known: Vec<(String, Vec<String>)> = known.collect();
    known.sort();
    assert_eq!(
        found, known,
        "circles that are there, and circles that are known"
    );
}

#[test]
fn a_circle_is_found() {
    let text =
        "use crate::a::B;\nuse crate::{c, d::{e, f}, g};\n// crate::h\nfn x() { crate::i::j() }\n";
    let names: Vec<String> = named(text).into_iter().collect();
    assert_eq!(names, ["a", "c", "d", "g", "i"]);
    let reads = |pairs: &[(&str, &str)]| {
        let mut reads = Reads::new();
        for (from, to) in pairs {
            reads
                .entry((*from).into())
                .or_default()
                .insert((*to).into());
        }
        circles(&reads).into_iter().collect::<Vec<_>>()
    };
    assert_eq!(
        reads(&[("a", "b"), ("b", "c"), ("a", "c")]),
        Vec::<Vec<String>>::new()
    );
    assert_eq!(
        reads(&[("a", "b"), ("b", "c"), ("c", "a"), ("c", "d")]),
        [["a", "b", "c"]]
    );
}
