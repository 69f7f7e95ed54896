//! Toy stages: one that reads, one that adds a number and fails at thirteen.

use shape::Document;
use stage::{Ctx, Files, Stage, Stop, erase};
use std::sync::Arc;
use tailor::engine::Catalog;

stage::inputs! {
    /// Files.
    pub struct FromFiles {
        /// Files.
        files: Arc<Files>,
    }
}
stage::inputs! {
    /// A document.
    pub struct FromDocument {
        /// A document.
        text: Arc<Document>,
    }
}
stage::params! {
    /// A number.
    pub struct Number {
        /// A number.
        #[range(0..=1000)]
        n: i64 = 1,
    }
}

fn document(text: String) -> Document {
    Document {
        media: "text/plain".into(),
        bytes: text.into_bytes(),
    }
}

/// Reads the first file.
struct Read;
impl Stage for Read {
    const NAME: &'static str = "toy.read";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "Reads.";
    type Params = ();
    type Input = FromFiles;
    type Output = Document;
    fn run(_: &(), input: FromFiles, _: &Ctx<'_>) -> Result<Document, Stop> {
        let bytes = input.files.read(&input.files.entries[0])?;
        Ok(document(String::from_utf8(bytes)?))
    }
}

/// Adds a number; tells ten times the number; fails at 13.
struct Add;
impl Stage for Add {
    const NAME: &'static str = "toy.add";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "Adds a number.";
    type Params = Number;
    type Input = FromDocument;
    type Output = Document;
    const METRICS: &'static [&'static str] = &["tenfold"];
    fn run(p: &Number, input: FromDocument, ctx: &Ctx<'_>) -> Result<Document, Stop> {
        if p.n == 13 {
            return Err(std::io::Error::other("thirteen is not taken").into());
        }
        ctx.metric("tenfold", p.n as f64 * 10.0, "mm");
        let text = String::from_utf8_lossy(&input.text.bytes);
        Ok(document(format!("{text} {}", p.n)))
    }
}

/// Their catalog.
pub(crate) static CATALOG: Catalog = Catalog {
    program: "toys 1",
    rooms: &[&[&erase::<Read>(), &erase::<Add>()]],
    pipelines: &[],
    kinds: &[],
    importers: &[],
};

/// src → mid → final.
pub(crate) const PIPELINE: &str = r#"goal = "final"
[input.src]
files = "*.txt"
[node.src]
stage = "toy.read"
from = { files = "@src" }
[node.mid]
stage = "toy.add"
from = { text = "src" }
[node.final]
stage = "toy.add"
from = { text = "mid" }
[variant.double]
with.mid = { n = 2 }
[variant.triple]
with.mid = { n = 3 }
"#;
