//! Plans on Slurm: one `sbatch` a layer, never one a node; names that show a second submitter what is
//! there already; no polling.

use super::layers::Layer;
use super::sent::Sent;
use super::site::{SlurmError, ask};
use engine::strands::Plan;
use std::path::PathBuf;

/// What the user wishes of every job.
#[derive(Debug, Clone, Default)]
pub struct Wish {
    /// The partition.
    pub partition: Option<String>,
    /// Cores of an element.
    pub cpus: usize,
    /// Memory of an element, as Slurm writes it: `4G`.
    pub mem: Option<String>,
    /// How long an element may take, as Slurm writes it: `2:00:00`.
    pub time: Option<String>,
    /// More words for `sbatch`.
    pub more: Vec<String>,
    /// The folder for the output of elements.
    pub logs: Option<PathBuf>,
    /// The program.
    pub program: PathBuf,
    /// The store.
    pub cache: PathBuf,
    /// The flags that hold for the work, too: the store that machines share, what programs may.
    pub flags: Vec<String>,
}

/// A plan's jobs.
pub struct Slurm<'a> {
    /// What the program is called: jobs are named after it.
    pub program: &'a str,
    /// The plan's name.
    pub name: &'a str,
    /// The plan.
    pub plan: &'a Plan,
}

impl Slurm<'_> {
    /// What the job of a layer is called.
    pub fn job(&self, layer: usize) -> String {
        format!("{}-{}-L{layer}", self.program, &self.name[..12])
    }

    /// All its jobs that Slurm still knows, each element of an array: one question.
    ///
    /// # Errors
    ///
    /// There is no Slurm, or it does not answer.
    pub fn sent(&self) -> Result<Vec<Sent>, SlurmError> {
        let names: Vec<String> = (0..self.plan.layers()).map(|l| self.job(l)).collect();
        let words = ["-h", "-r", "--states=all", "-o", "%F|%j|%T|%m|%r"].map(str::to_owned);
        let mut words = words.to_vec();
        words.push(format!("--name={}", names.join(",")));
        let answer = ask("squeue", &words, "")?;
        let line = |line: &str| Sent::queued(line, &names);
        Ok(answer.lines().filter_map(line).collect())
    }

    /// Its jobs of the last month that Slurm's accounting remembers: one question. None where the site
    /// keeps no accounts, or `sacct` is not here.
    pub fn remembered(&self) -> Vec<Sent> {
        let names: Vec<String> = (0..self.plan.layers()).map(|l| self.job(l)).collect();
        let words = [
            "-X",
            "-n",
            "-P",
            "-S",
            "now-30days",
            "-o",
            "JobID,JobName,State,ReqMem",
        ];
        let mut words = words.map(str::to_owned).to_vec();
        words.push(format!("--name={}", names.join(",")));
        let answer = ask("sacct", &words, "").unwrap_or_default();
        let line = |line: &str| Sent::remembered(line, &names);
        answer.lines().filter_map(line).collect()
    }

    /// Sends one layer, which waits for `after`. Returns the job's number.
    ///
    /// # Errors
    ///
    /// There is no Slurm, or it refuses.
    pub fn send(
        &self,
        layer: &Layer,
        after: Option<&str>,
        wish: &Wish,
    ) -> Result<String, SlurmError> {
        let at = self.plan.strands[layer.strands.start].layer;
        let mut words = ["--parsable", "--requeue", "--kill-on-invalid-dep=yes"]
            .map(str::to_owned)
            .to_vec();
        // Two minutes before its time is over an element gets a signal: what is done by then is kept.
        words.push("--signal=B:TERM@120".into());
        words.push(format!("--job-name={}", self.job(at)));
        words.push(format!("--comment={}", self.name));
        words.push(format!("--array={}", layer.array()));
        words.push(format!("--cpus-per-task={}", wish.cpus.max(1)));
        let file = |logs: &PathBuf| logs.join(format!("{}-%A_%a.out", self.job(at)));
        let log = wish.logs.as_ref().map_or("/dev/null".into(), file);
        words.push(format!("--output={}", log.display()));
        let mut wished = |name: &str, value: Option<&str>| {
            words.extend(value.map(|value| format!("--{name}={value}")));
        };
        wished("partition", wish.partition.as_deref());
        wished("mem", wish.mem.as_deref());
        wished("time", wish.time.as_deref());
        wished("dependency", after);
        words.extend(wish.more.iter().cloned());
        let answer = ask("sbatch", &words, &self.script(layer, wish))?;
        // With several clusters: `number;cluster`.
        let id = answer.trim().split(';').next().unwrap_or_default();
        match !id.is_empty() && id.bytes().all(|b| b.is_ascii_digit()) {
            true => Ok(id.to_owned()),
            false => Err(SlurmError::Odd {
                command: "sbatch".into(),
                answer: answer.trim().to_owned(),
            }),
        }
    }

    /// What every element of a layer runs. The shell becomes the program, so signals reach it.
    pub(crate) fn script(&self, layer: &Layer, wish: &Wish) -> String {
        let (first, last, pack) = (layer.strands.start, layer.strands.end - 1, layer.pack);
        format!(
            "#!/bin/sh\n# strands {first}-{last} of the plan {name}\n\
             first=$(({first} + SLURM_ARRAY_TASK_ID * {pack}))\n\
             last=$((first + {pack} - 1))\n\
             if [ \"$last\" -gt {last} ]; then last={last}; fi\n\
             exec {program} cluster work --plan {name} --strand \"$first-$last\" --cache {cache}{flags} \\\n  \
             --threads \"${{SLURM_CPUS_PER_TASK:-1}}\" --quiet\n",
            name = self.name,
            program = quoted(&wish.program.to_string_lossy()),
            cache = quoted(&wish.cache.to_string_lossy()),
            flags = flags(&wish.flags),
        )
    }

    /// What a layer waits for, by the layer below it and that one's job; `fresh` where both are sent now.
    pub fn after(
        &self,
        layer: &Layer,
        below: Option<(&Layer, &str)>,
        fresh: bool,
    ) -> Option<String> {
        let (below, id) = below?;
        let kind = match () {
            // A failing element drops only what reads it.
            () if fresh && layer.corresponds(below, self.plan) => "aftercorr",
            () if fresh && below.elements.len() == 1 => "afterok",
            // Each strand looks itself whether what it reads was made.
            () => "afterany",
        };
        Some(format!("{kind}:{id}"))
    }

    /// Ends all that is alive. Returns how many jobs.
    ///
    /// # Errors
    ///
    /// There is no Slurm, or it refuses.
    pub fn cancel(&self) -> Result<usize, SlurmError> {
        let mut ids: Vec<String> = Vec::new();
        for sent in self.sent()?.into_iter().filter(Sent::is_alive) {
            if !ids.contains(&sent.id) {
                ids.push(sent.id);
            }
        }
        if !ids.is_empty() {
            ask("scancel", &ids, "")?;
        }
        Ok(ids.len())
    }
}

/// Flags, for a shell.
pub(crate) fn flags(words: &[String]) -> String {
    let one = |word: &String| match word.starts_with("--") {
        true => format!(" {word}"),
        false => format!(" {}", quoted(word)),
    };
    words.iter().map(one).collect()
}

/// A word for a shell.
pub(crate) fn quoted(text: &str) -> String {
    format!("'{}'", text.replace('\'', "'\\''"))
}
