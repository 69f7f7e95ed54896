//! What is behind the points of a sweep: commands, links to what is in the cache, and with `--show` results as files
//! beside the page, one of equal ones.

use super::fault::Fault;
use super::program::GlobalArgs;
use super::sweep_asked::SweepArgs;
use super::sweep_report::how;
use engine::delivery::Delivery;
use engine::graph::Graph;
use engine::store::Store;
use engine::sweep::{Kept, Point, Row};
use engine::{out, whole};
use stage::{AnyArtifact, Hash};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use tables::Behind;

/// Where points' files are, below the page.
const FOLDER: &str = "points";

/// Formats that a browser shows, the first that a kind has; else it is written in its usual one.
const SHOWN: [&str; 6] = ["views", "sheet", "svg", "png", "jpg", "html"];

/// So many digits of a hash name a file. \[hexadecimal digits\]
const DIGITS: usize = 12;

/// Addresses below the page of what was written, by node, format and content.
pub(super) type Files = HashMap<(String, String, Hash), String>;

/// A node that is to be shown, and in which format.
fn asked(text: &str) -> (&str, Option<&str>) {
    match text.split_once(':') {
        Some((node, format)) => (node, Some(format)),
        None => (text, None),
    }
}

/// Whether what `--show` names is there, before anything runs.
pub(super) fn check(args: &SweepArgs, graphs: &[Graph]) -> Result<(), Fault> {
    for text in &args.show {
        let (name, format) = asked(text);
        let Some(graph) = graphs.iter().find(|g| g.node(name).is_some()) else {
            super::open::node(&graphs[0], name)?;
            continue;
        };
        let kind = graph.node(name).map(|at| graph.nodes[at].stage.yields());
        let known = out::formats(graph.catalog, kind.unwrap_or_default());
        if let Some(format) = format.filter(|f| !known.contains(f)) {
            return Err(Fault::input(format!(
                "`--show {text}`: {}",
                stage::unknown("format", format, known)
            )));
        }
    }
    Ok(())
}

/// Writes what `--show` asks for of every point.
pub(super) fn written(
    args: &SweepArgs,
    rows: &[Row],
    at: &dyn Fn(&Point) -> Option<Graph>,
    (store, delivery): (&Store, &mut Delivery),
) -> Result<Files, Fault> {
    let mut files = Files::new();
    for row in rows.iter().filter(|_| !args.show.is_empty()) {
        let Some(graph) = at(&row.point) else {
            continue;
        };
        for text in &args.show {
            let (name, format) = asked(text);
            let Some(kept) = row.results.iter().find(|k| k.node == name) else {
                continue;
            };
            let known = (name.to_owned(), text.clone(), kept.content);
            if files.contains_key(&known) {
                continue;
            }
            let file = one(&graph, row, kept, format, store)?;
            let hex = kept.content.to_hex();
            let stem = format!("{FOLDER}/{name}-{}", &hex[..DIGITS]);
            files.insert(known, put(delivery, &stem, file)?);
        }
    }
    Ok(files)
}

/// Files, by their names.
type Written = Vec<(String, Vec<u8>)>;

/// A result as files: format and bytes.
fn one(
    graph: &Graph,
    row: &Row,
    kept: &Kept,
    format: Option<&str>,
    store: &Store,
) -> Result<(String, Written), Fault> {
    let gone = |node: &str| {
        Fault::stage(format!(
            "the result of `{node}` went out of the cache before it was written; run the same command again"
        ))
    };
    let read = |kept: &Kept| -> Option<AnyArtifact> {
        let stage = graph.nodes[graph.node(&kept.node)?].stage;
        stage.read(&store.blob(kept.content)?).ok()
    };
    let at = graph.node(&kept.node).ok_or_else(|| gone(&kept.node))?;
    let artifact = read(kept).ok_or_else(|| gone(&kept.node))?;
    let beside = graph.beside(at).and_then(|at| {
        let name = &graph.nodes[at].name;
        read(row.results.iter().find(|k| k.node == *name)?)
    });
    let known = out::formats(graph.catalog, artifact.kind());
    let shown = SHOWN.into_iter().find(|f| known.contains(f));
    let format = format.or(shown).unwrap_or(known[0]);
    let raw = || {
        store
            .blob(kept.content)
            .map_or(vec![], |blob| blob.to_vec())
    };
    let files = out::files(graph.catalog, artifact, raw, beside, Some(format));
    Ok((format.to_owned(), files.map_err(Fault::stage)?))
}

/// Puts a result's files beside the page; the address of the first.
fn put(
    delivery: &mut Delivery,
    stem: &str,
    (format, files): (String, Vec<(String, Vec<u8>)>),
) -> Result<String, Fault> {
    let single = matches!(&files[..], [(name, _)] if name.is_empty());
    let name = match files.first() {
        Some((_, bytes)) if single => format!("{stem}.{}", ending(bytes, &format)),
        _ => stem.to_owned(),
    };
    delivery.put(&name, &files).map_err(Fault::stage)?;
    match files.first() {
        Some((first, _)) if !single => Ok(format!("{name}/{first}")),
        _ => Ok(name),
    }
}

/// What a file is called by its bytes, else by its format.
fn ending<'a>(bytes: &[u8], format: &'a str) -> &'a str {
    match bytes {
        [0xff, 0xd8, 0xff, ..] => "jpg",
        [0x89, b'P', b'N', b'G', ..] => "png",
        _ => format,
    }
}

/// What is behind a row: the commands that give it, what `--show` wrote, records and blobs of the cache.
pub(super) fn behind(
    row: &Row,
    files: &Files,
    (args, store, global): (&SweepArgs, &Store, &GlobalArgs),
) -> Behind {
    let root = whole(store.root());
    let address = |path: PathBuf| match path.strip_prefix(store.root()) {
        Ok(inner) => address(&root.join(inner)),
        Err(_) => address(&path),
    };
    let mut links = Vec::new();
    for kept in &row.results {
        let mut link = |word: &str, address: String| {
            links.push((kept.node.clone(), word.to_owned(), address));
        };
        for text in args.show.iter().filter(|text| asked(text).0 == kept.node) {
            let written = files.get(&(kept.node.clone(), text.clone(), kept.content));
            if let Some(address) = written {
                link(asked(text).1.unwrap_or("picture"), address.clone());
            }
        }
        link("why", address(store.record_file(kept.key)));
        link("result", address(store.blob_file(kept.content)));
    }
    Behind {
        commands: how(row, args, global),
        links,
    }
}

/// A file's address for a browser.
fn address(path: &Path) -> String {
    let mut text = String::from("file://");
    for byte in path.to_string_lossy().bytes() {
        match byte {
            b'/' | b'-' | b'.' | b'_' | b'~' => text.push(byte.into()),
            _ if byte.is_ascii_alphanumeric() => text.push(byte.into()),
            _ => text += &format!("%{byte:02X}"),
        }
    }
    text
}
