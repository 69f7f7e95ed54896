//! `tailor mat`: a marker mat for a disk, to be printed.

use super::init::not_written;
use super::spoken::Spoken;
use crate::catalog;
use clap::Args;
use command::{Fault, GlobalArgs};
use shape::Document;
use stage::{Ctx, Host, Message, Metric, Value, message};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

stage::messages! {
    NO_PRINT = "cli-mat-ending": "{file}: a mat is written as .pdf or .svg; give the file one of these endings";
}

/// Arguments of `tailor mat`.
#[derive(Args)]
pub(crate) struct MatArgs {
    /// The disk's diameter in millimetres
    #[arg(long)]
    diameter_mm: f64,
    /// Edge length of a tag's black square in millimetres; one that suits the disk if not given
    #[arg(long)]
    tag_mm: Option<f64>,
    /// How many tags; as many as fit if not given
    #[arg(long)]
    count: Option<u32>,
    /// The first tag's number
    #[arg(long)]
    first_id: Option<u32>,
    /// The disk's thickness in millimetres: prints a strip of tags for its rim, too, which tell what
    /// a mat leaves open of the lens (docs/cameras.md)
    #[arg(long)]
    rim_mm: Option<f64>,
    /// Edge length of a rim tag's black square in millimetres; as tall as the rim allows if not given
    #[arg(long, requires = "rim_mm")]
    rim_tag_mm: Option<f64>,
    /// How many tags go around the rim; as many as fit, at most 48, if not given
    #[arg(long, requires = "rim_mm")]
    rim_count: Option<u32>,
    /// The paper of a PDF: a4, a3, letter or whole (one large page)
    #[arg(long, default_value = "a4")]
    paper: String,
    /// The file; by its ending a .pdf or .svg
    #[arg(short)]
    o: PathBuf,
}

/// The file with the facts beside the print: never a `capture.toml` that somebody wrote.
fn beside(print: &Path) -> PathBuf {
    let mut name = print.as_os_str().to_owned();
    name.push(".toml");
    name.into()
}

/// Hears what the stage reports of the mat.
#[derive(Default)]
struct Heard(Mutex<Vec<Metric>>);

impl Host for Heard {
    fn metric(&self, metric: Metric) {
        self.0.lock().expect("bug: a hearer panicked").push(metric);
    }
}

/// Writes a marker mat to print.
pub(crate) fn mat(args: &MatArgs, global: &GlobalArgs) -> Result<(), Fault> {
    let ending = args.o.extension().and_then(|e| e.to_str()).unwrap_or("");
    let ending = ending.to_lowercase();
    if !["pdf", "svg"].contains(&ending.as_str()) {
        let file = args.o.display().to_string();
        return Err(Fault::coded(&message!(NO_PRINT, file = file)));
    }
    let (document, metrics) = laid_out(args, ending)?;
    // What capture.toml has of it, as the print itself has it.
    let toml = beside(&args.o);
    let facts = super::mat_file::text(&document.bytes).expect("bug: a mat without facts");
    for (path, bytes) in [
        (&args.o, document.bytes.clone()),
        (&toml, facts.into_bytes()),
    ] {
        let file = vec![(String::new(), bytes)];
        crate::delivery::write(path, &file)
            .map_err(|why| not_written(&path.display().to_string(), &why))?;
    }
    let shown = args.o.display().to_string();
    let toml = toml.display().to_string();
    if global.json {
        let answer =
            serde_json::json!({ "file": shown, "bytes": document.bytes.len(), "facts": toml });
        command::outln!("{answer}");
    } else if !global.quiet {
        let words = Spoken::default().words();
        let text = |m: &Metric| {
            let name = words.text(&format!("mat-{}", m.name.replace(' ', "-")));
            format!("{name} {} {}", m.value, m.unit).trim().to_owned()
        };
        let lines: Vec<String> = metrics.iter().map(text).collect();
        command::outln!("{shown}: {}", lines.join(", "));
        let put = [("facts", toml.into()), ("print", shown.into())];
        command::outln!("{}", words.with("mat-next", &put));
    }
    Ok(())
}

/// The params of `pose.mat` that the arguments set.
fn params(args: &MatArgs, ending: String) -> BTreeMap<String, Value> {
    let mut stated = BTreeMap::from([
        ("diameter_mm".to_owned(), Value::Float(args.diameter_mm)),
        ("print".to_owned(), Value::Text(ending)),
        ("sheet".to_owned(), Value::Text(args.paper.to_lowercase())),
    ]);
    for (name, value) in [
        ("tag_mm", args.tag_mm),
        ("rim_mm", args.rim_mm),
        ("rim_tag_mm", args.rim_tag_mm),
    ] {
        if let Some(value) = value {
            stated.insert(name.into(), Value::Float(value));
        }
    }
    for (name, value) in [
        ("count", args.count),
        ("first_id", args.first_id),
        ("rim_count", args.rim_count),
    ] {
        if let Some(value) = value {
            stated.insert(name.into(), Value::Int(i64::from(value)));
        }
    }
    stated
}

/// The mat as the stage lays it out, and what it reports of it.
fn laid_out(args: &MatArgs, ending: String) -> Result<(Arc<Document>, Vec<Metric>), Fault> {
    let stage = catalog::find("pose.mat").expect("bug: no stage lays out mats");
    let params = stage.check(&params(args, ending)).map_err(|mistakes| {
        let all: Vec<String> = mistakes
            .iter()
            .map(|m| format!("{}: {}", m.name, m.what))
            .collect();
        Fault::input(all.join("\n"))
    })?;
    let heard = Heard::default();
    let nothing = stage::hash(b"");
    let made = stage.run(&params, vec![], &Ctx::new(&heard, nothing, nothing));
    let made = made.map_err(|stop| match stop {
        stage::Stop::Failed(why) => match why.downcast::<Message>() {
            Ok(why) => Fault::coded(&why),
            Err(why) => Fault::input(why),
        },
        stage::Stop::Cancelled => Fault::stage("cancelled"),
    })?;
    let document = made.artifact.downcast::<Document>();
    let document = document.expect("bug: a mat is no document");
    let heard = heard.0.into_inner().expect("bug: a hearer panicked");
    Ok((document, heard))
}
