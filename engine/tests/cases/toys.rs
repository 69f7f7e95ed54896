//! Small stages: cheap, and each with one property that the engine must cope with.

use crate::document::Document;
use engine::Catalog;
use stage::{AnyStage, Ctx, Files, Stage, Stop, erase};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

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
stage::inputs! {
    /// Two documents.
    pub struct FromTwo {
        /// One.
        a: Arc<Document>,
        /// Another, or none.
        b: Option<Arc<Document>>,
    }
}
stage::params! {
    /// A number, and how long it takes.
    pub struct Number {
        /// A number.
        #[range(0..=1_000_000)]
        n: i64 = 1,
        /// How long it takes.
        sleep_ms: u32 = 0,
    }
}

fn document(text: String) -> Document {
    Document {
        media: "text/plain".into(),
        bytes: text.into_bytes(),
    }
}

/// Takes comments (lines with #) out of all files.
struct Clean;
impl Stage for Clean {
    const NAME: &'static str = "toy.clean";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "Takes comments out.";
    type Params = ();
    type Input = FromFiles;
    type Output = Document;
    fn run(_: &(), input: FromFiles, _: &Ctx<'_>) -> Result<Document, Stop> {
        let mut text = String::new();
        for entry in &input.files.entries {
            let file = String::from_utf8(input.files.read(entry)?)?;
            text.extend(file.lines().filter(|l| !l.starts_with('#')));
        }
        Ok(document(text))
    }
}

/// Adds a number; its metric is ten times the number; fails at 13.
struct Mid;
impl Stage for Mid {
    const NAME: &'static str = "toy.mid";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "Adds a number.";
    type Params = Number;
    type Input = FromDocument;
    type Output = Document;
    const METRICS: &'static [&'static str] = &["tenfold"];
    fn run(p: &Number, input: FromDocument, ctx: &Ctx<'_>) -> Result<Document, Stop> {
        std::thread::sleep(std::time::Duration::from_millis(p.sleep_ms.into()));
        if p.n == 13 {
            return Err(std::io::Error::other("thirteen is not taken").into());
        }
        ctx.metric("tenfold", p.n as f64 * 10.0, "mm");
        let text = String::from_utf8_lossy(&input.text.bytes);
        Ok(document(format!("{text} {}", p.n)))
    }
}

/// Half the sum of the lengths and the number: often equal for other inputs.
struct Half;
impl Stage for Half {
    const NAME: &'static str = "toy.half";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "Half of a sum.";
    type Params = Number;
    type Input = FromTwo;
    type Output = Document;
    fn run(p: &Number, input: FromTwo, _: &Ctx<'_>) -> Result<Document, Stop> {
        let length = |d: &Document| d.bytes.len();
        let sum = length(&input.a) + input.b.as_deref().map_or(0, length) + p.n as usize;
        Ok(document("x".repeat(sum / 2 % 7)))
    }
}

/// Declares that it needs more than there is; its metric is how many more run beside it.
struct Big;
impl Stage for Big {
    const NAME: &'static str = "toy.big";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "Needs much.";
    type Params = Number;
    type Input = FromDocument;
    type Output = Document;
    const METRICS: &'static [&'static str] = &["beside"];
    fn memory(_: &Number, _: &FromDocument) -> u64 {
        u64::MAX
    }
    fn run(p: &Number, _: FromDocument, ctx: &Ctx<'_>) -> Result<Document, Stop> {
        static NOW: AtomicUsize = AtomicUsize::new(0);
        let beside = NOW.fetch_add(1, Ordering::SeqCst);
        std::thread::sleep(std::time::Duration::from_millis(p.sleep_ms.into()));
        NOW.fetch_sub(1, Ordering::SeqCst);
        ctx.metric("beside", beside as f64, "");
        Ok(document(p.n.to_string()))
    }
}

/// Never the same twice: what no stage may be.
struct Unsteady;
impl Stage for Unsteady {
    const NAME: &'static str = "toy.unsteady";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "Never the same twice.";
    type Params = Number;
    type Input = FromDocument;
    type Output = Document;
    fn run(p: &Number, input: FromDocument, _: &Ctx<'_>) -> Result<Document, Stop> {
        std::thread::sleep(std::time::Duration::from_millis(p.sleep_ms.into()));
        static COUNT: AtomicUsize = AtomicUsize::new(0);
        let count = COUNT.fetch_add(1, Ordering::Relaxed);
        let text = String::from_utf8_lossy(&input.text.bytes);
        Ok(document(format!("{text} {count}")))
    }
}

/// Works file by file, then in steps; its metrics are how many files and steps it did now. Fails at step 13.
struct Parts;
impl Stage for Parts {
    const NAME: &'static str = "toy.parts";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "Works file by file.";
    type Params = Number;
    type Input = FromFiles;
    type Output = Document;
    const METRICS: &'static [&'static str] = &["files", "steps"];
    fn run(p: &Number, input: FromFiles, ctx: &Ctx<'_>) -> Result<Document, Stop> {
        let (mut files, mut text) = (0, String::new());
        for entry in &input.files.entries {
            let part = ctx.part("file", &[entry.content], || {
                files += 1;
                Ok(document(String::from_utf8(input.files.read(entry)?)?))
            })?;
            text += &String::from_utf8_lossy(&part.bytes);
        }
        let mut steps = ctx.resume::<Document>("steps").map_or(0, |d| d.bytes.len());
        let first = steps;
        while steps < p.n as usize {
            steps += 1;
            ctx.checkpoint("steps", &document("x".repeat(steps)));
            if p.sleep_ms > 0 && steps == p.sleep_ms as usize && first == 0 {
                return Err(std::io::Error::other("stopped on the way").into());
            }
        }
        ctx.metric("files", f64::from(files), "");
        ctx.metric("steps", (steps - first) as f64, "");
        Ok(document(text))
    }
}

stage::params! {
    /// A number under noise.
    pub struct Noisy {
        /// A number.
        n: i64 = 1,
        /// Seed of the noise.
        #[range(0..=20)]
        #[chance(seed)]
        seed: i64 = 1,
    }
}

/// Tells its number and its seed; of seed 4 it refuses the sum, and it fails at 7.
struct Noise;
impl Stage for Noise {
    const NAME: &'static str = "toy.noise";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "A number under noise.";
    type Params = Noisy;
    type Input = FromDocument;
    type Output = Document;
    const METRICS: &'static [&'static str] = &["sum"];
    fn run(p: &Noisy, _: FromDocument, ctx: &Ctx<'_>) -> Result<Document, Stop> {
        if p.seed == 7 {
            return Err(std::io::Error::other("seven is not taken").into());
        }
        if p.seed != 4 {
            ctx.metric("sum", (p.n * 10 + p.seed) as f64, "mm");
        }
        Ok(document(format!("{} {}", p.n, p.seed)))
    }
}

const STAGES: &[&dyn AnyStage] = &[
    &erase::<Clean>(),
    &erase::<Mid>(),
    &erase::<Half>(),
    &erase::<Big>(),
    &erase::<Unsteady>(),
    &erase::<Parts>(),
    &erase::<Noise>(),
];

/// Their catalog.
pub(crate) static CATALOG: Catalog = Catalog {
    program: "toys 1",
    stages: &[STAGES],
    pipelines: &[],
    kinds: &[],
    importers: &[],
};
