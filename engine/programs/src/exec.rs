//! A kind's importer as the stage of a program: what is read is laid out, the program runs, and what it
//! wrote is imported.

use crate::Importer;
use crate::child::Line;
use crate::error::ForeignError;
use crate::kept::Kept;
use crate::layout::{Job, Layout};
use crate::out;
use crate::program::Program;
use crate::results;
use crate::run::{self, MOST, word};
use crate::template::{Piece, Template};
use stage::{
    AnyArtifact, AnyStage, Artifact, Checked, Corrupt, Ctx, Files, Made, Mistake, ParamSpec,
    PortSpec, Stop, Value,
};
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

/// What a pipeline calls the stage of a program.
pub const EXEC: &str = "exec";

/// Raise it whenever a program gets or gives something else.
pub const VERSION: u32 = 2;

/// Whether a kind can be laid out as files for a program, in a format if one is given.
///
/// # Errors
///
/// It has no such format, or none that a program could read.
pub fn laid_out(catalog: &crate::Catalog, kind: &str, format: Option<&str>) -> Result<(), String> {
    let formats = match catalog.kind(kind) {
        _ if kind == Files::KIND => &[][..],
        Some(kind) => kind.formats,
        None => {
            return Err(format!(
                "{kind} is written in no format that a program could read"
            ));
        }
    };
    match format {
        Some(format) if !formats.contains(&format) => Err(format!(
            "{kind} is not written as `{format}`; known: {}",
            formats.join(", ")
        )),
        None if formats.is_empty() && kind != Files::KIND => Err(format!(
            "{kind} is written in no format that a program could read"
        )),
        _ => Ok(()),
    }
}

/// What replaces each place of a command that reads or writes.
type Places = Vec<(Piece, String)>;

impl Program {
    /// Lays out what the command reads.
    fn inputs(&self, job: &Job, inputs: &[Option<AnyArtifact>]) -> Result<Places, ForeignError> {
        let mut places = Places::new();
        let pieces = self
            .command
            .iter()
            .flat_map(|Template { pieces, .. }| pieces);
        for piece in pieces {
            let Piece::From(port, format) = piece else {
                continue;
            };
            if places.iter().any(|(known, _)| known == piece) {
                continue;
            }
            let at = self.ports.iter().position(|(name, _)| name == port);
            let artifact = at.and_then(|at| inputs[at].clone());
            let wrong = |why: String| ForeignError::Input {
                port: port.clone(),
                why,
            };
            let artifact = artifact.ok_or_else(|| wrong("nothing is there".into()))?;
            let path = match artifact.clone().downcast::<Files>() {
                Some(files) => job.user_files(port, &files)?,
                None => {
                    let kind = self.catalog.kind(artifact.kind());
                    let beside = kind.and_then(|kind| of_kind(inputs, kind.beside?));
                    let extension = match format {
                        Some(format) => format.as_str(),
                        None => out::extension(self.catalog, &artifact),
                    };
                    let raw = Vec::new;
                    let format = format.as_deref();
                    let files = out::files(self.catalog, artifact.clone(), raw, beside, format);
                    let files = files.map_err(|why| wrong(why.to_string()))?;
                    let name = match format {
                        Some(format) => format!("{port}-{format}"),
                        None => port.clone(),
                    };
                    job.written(&name, extension, &files)?
                }
            };
            places.push((piece.clone(), word(&job.shown(&path))));
        }
        Ok(places)
    }

    /// Runs the program, and gives what its kind's importer makes of what it wrote.
    fn made(&self, inputs: &[Option<AnyArtifact>], ctx: &Ctx<'_>) -> Result<Made, ForeignError> {
        let grant = self.granted.0.get().ok_or(ForeignError::NotAllowed)?;
        if !self.keep {
            let job = Job::new(&Arc::new(Layout::new(&grant.folder)?))?;
            return self.made_in(&job, None, inputs, ctx);
        }
        let mut kept = Kept::of(self, &grant.folder)?;
        let job = Job::new(&kept.layout)?;
        let made = self.made_in(&job, Some(&mut kept), inputs, ctx);
        // Imported artifacts hold no files of it any more.
        kept.rest();
        made
    }

    /// As `made`, in new folders.
    fn made_in(
        &self,
        job: &Job,
        kept: Option<&mut Kept>,
        inputs: &[Option<AnyArtifact>],
        ctx: &Ctx<'_>,
    ) -> Result<Made, ForeignError> {
        let grant = self.granted.0.get().ok_or(ForeignError::NotAllowed)?;
        let stop = || ctx.check().is_err();
        job.files(&self.files)?;
        let mut places = self.inputs(job, inputs)?;
        let out: PathBuf = results::place(&job.results(), self.importer);
        places.push((Piece::Out, word(&job.shown(&out))));
        let place = |piece: &Piece| {
            let place = places.iter().find(|(known, _)| known == piece);
            place.map_or(String::new(), |(_, path)| path.clone())
        };
        let steps = ctx.steps("program", 100);
        let mut shown = 0;
        let mut heard = |line: &Line| match progress(line) {
            Some(percent) => {
                while shown < percent {
                    shown += 1;
                    let _ = steps.tick();
                }
                true
            }
            None => false,
        };
        let tail = run::command(self, job, &place, kept, &stop, &mut heard)?;
        let reported = |mut error: ForeignError| {
            error.printed(&tail.text());
            error
        };
        let name = self.name();
        let files =
            results::collected(&name, job, self.importer, MOST, self.keep).map_err(reported)?;
        let made = self.imported(files, inputs, ctx).map_err(reported)?;
        self.same_identity(&grant.folder, &stop)?;
        grant.same_reads(&self.reads)?;
        Ok(made)
    }

    fn imported(
        &self,
        files: Files,
        inputs: &[Option<AnyArtifact>],
        ctx: &Ctx<'_>,
    ) -> Result<Made, ForeignError> {
        let importer = self.importer.stage;
        let port = |port: PortSpec| match port.kind == Files::KIND {
            true => Some(AnyArtifact::new(files.clone())),
            false => of_kind(inputs, port.kind),
        };
        let given = importer.ports().into_iter().map(port).collect();
        let refused = |why: String| ForeignError::Refused {
            program: self.name(),
            kind: importer.yields(),
            why,
            tail: String::new(),
        };
        let params = importer.check(&BTreeMap::new());
        let params = params.map_err(|_| refused("its importer needs params".into()))?;
        importer
            .run(&params, given, ctx)
            .map_err(|stop| match stop {
                Stop::Cancelled => ForeignError::Cancelled,
                Stop::Failed(why) => refused(why.to_string()),
            })
    }

    /// Whether the program still is what it was when the run began.
    fn same_identity(
        &self,
        store: &std::path::Path,
        stop: &dyn Fn() -> bool,
    ) -> Result<(), ForeignError> {
        let before = self
            .granted
            .0
            .get()
            .and_then(|grant| grant.identity.clone());
        let after = run::identity(self, store, stop)?;
        match (before, after) {
            (Some(Ok(before)), Some(after)) if before != after => Err(ForeignError::Identity {
                program: self.name(),
                before,
                after,
            }),
            _ => Ok(()),
        }
    }
}

/// The first artifact of a kind.
fn of_kind(inputs: &[Option<AnyArtifact>], kind: &str) -> Option<AnyArtifact> {
    let mut inputs = inputs.iter().flatten();
    inputs.find(|artifact| artifact.kind() == kind).cloned()
}

/// `{"progress": 0.4}` on standard output, as a percentage.
fn progress(line: &Line) -> Option<usize> {
    let text = line.text.trim();
    if !line.out || !text.starts_with('{') {
        return None;
    }
    let line: serde_json::Value = serde_json::from_str(text).ok()?;
    let share = line.get("progress")?.as_f64()?;
    Some((share.clamp(0.0, 1.0) * 100.0) as usize)
}

/// A program whose result this importer reads. Ports and params are the node's own, so that they are known
/// by the graph's node and not here.
impl AnyStage for Importer {
    fn name(&self) -> &'static str {
        EXEC
    }
    fn version(&self) -> u32 {
        VERSION
    }
    fn about(&self) -> &'static str {
        "Runs a program of yours."
    }
    fn yields(&self) -> &'static str {
        self.stage.yields()
    }
    fn format(&self) -> u32 {
        self.stage.format()
    }
    fn ports(&self) -> Vec<PortSpec> {
        vec![]
    }
    fn programs(&self) -> Vec<(&'static str, String)> {
        self.stage.programs()
    }
    fn metrics(&self) -> &'static [&'static str] {
        self.stage.metrics()
    }
    fn params(&self) -> Vec<ParamSpec> {
        vec![]
    }
    fn check(&self, _: &BTreeMap<String, Value>) -> Result<Checked, Vec<Mistake>> {
        Ok(Checked::of(vec![], Arc::new(())))
    }
    fn memory(&self, params: &Checked, _: &[Option<AnyArtifact>]) -> u64 {
        let program = params.typed::<Arc<Program>>();
        let mb = program.and_then(|program| program.memory_mb);
        mb.map_or(0, |mb| mb.saturating_mul(1 << 20))
    }
    fn run(
        &self,
        params: &Checked,
        inputs: Vec<Option<AnyArtifact>>,
        ctx: &Ctx<'_>,
    ) -> Result<Made, Stop> {
        let program = params.typed::<Arc<Program>>();
        let program = program.ok_or(ForeignError::NotAllowed)?;
        program.made(&inputs, ctx).map_err(|error| match error {
            ForeignError::Cancelled => Stop::Cancelled,
            error => Stop::Failed(Box::new(error)),
        })
    }
    fn read(&self, bytes: &[u8]) -> Result<AnyArtifact, Corrupt> {
        self.stage.read(bytes)
    }
}
