//! A plan on Dask: tasks with what they wait for, handed to the adapter `PROGRAM-dask`.

use super::layers::Layer;
use engine::strands::Plan;
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::io::Write;
use std::path::PathBuf;
use std::process::{Command, Stdio};

/// A task: strands that one worker makes in one go.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Task {
    /// What Dask calls it: the plan's name and its strands, so that nothing is sent twice.
    pub key: String,
    /// Its strands, as `work --strand` takes them.
    pub strands: String,
    /// The tasks that make what it reads.
    pub after: Vec<String>,
}

/// Why Dask could not be asked.
#[derive(Debug, thiserror::Error)]
pub enum DaskError {
    /// No adapter.
    #[error(
        "`{0}` is not here: it comes with the Python package, and needs Dask (`pip install distributed`); run this where they are installed"
    )]
    Missing(String),
    /// It refuses.
    #[error("`{0}` printed: {1}")]
    Refused(String, String),
}

/// How the names of a plan's tasks begin.
fn prefix(program: &str, plan: &str) -> String {
    format!("{program}-{}-s", &plan[..12])
}

/// The tasks of what is left of a plan, packed as in the layers, named after the program.
pub fn tasks(program: &str, name: &str, plan: &Plan, layers: &[Layer]) -> Vec<Task> {
    let elements = layers
        .iter()
        .flat_map(|layer| layer.elements.iter().map(move |e| layer.of(*e)));
    let elements: Vec<_> = elements.collect();
    let mut makes = vec![None; plan.strands.len()];
    for (at, strands) in elements.iter().enumerate() {
        strands.clone().for_each(|s| makes[s] = Some(at));
    }
    let text = |at: usize| {
        let (first, last) = (elements[at].start, elements[at].end - 1);
        if first == last {
            first.to_string()
        } else {
            format!("{first}-{last}")
        }
    };
    let key = |at: usize| format!("{}{}", prefix(program, name), text(at));
    let task = |at: usize| {
        let reads = elements[at].clone().flat_map(|s| &plan.strands[s].reads);
        let after: BTreeSet<usize> = reads
            .filter_map(|s| makes[*s])
            .filter(|of| *of != at)
            .collect();
        Task {
            key: key(at),
            strands: text(at),
            after: after.into_iter().map(key).collect(),
        }
    };
    (0..elements.len()).map(task).collect()
}

/// What is asked of the adapter, and of which scheduler.
#[derive(Debug, Clone)]
pub struct Dask<'a> {
    /// The adapter's command.
    pub adapter: PathBuf,
    /// The scheduler's address.
    pub address: &'a str,
    /// What the program is called: tasks are named after it.
    pub program: &'a str,
    /// The plan's name.
    pub plan: &'a str,
}

impl Dask<'_> {
    /// Sends tasks that are not there yet; `command` works on strands that follow it. Returns how many
    /// were sent.
    ///
    /// # Errors
    ///
    /// There is no adapter, or it refuses.
    pub fn submit(&self, tasks: &[Task], command: &[String]) -> Result<u64, DaskError> {
        let task = |t: &Task| json!({ "key": t.key, "strands": t.strands, "after": t.after });
        let tasks: Vec<Value> = tasks.iter().map(task).collect();
        let answer = self.ask("submit", json!({ "tasks": tasks, "command": command }))?;
        Ok(answer["sent"].as_u64().unwrap_or(0))
    }

    /// How many tasks are in which state.
    ///
    /// # Errors
    ///
    /// As [`Dask::submit`].
    pub fn states(&self) -> Result<Vec<(String, u64)>, DaskError> {
        let answer = self.ask("status", json!({}))?;
        let states = answer["states"].as_object().cloned().unwrap_or_default();
        let count = |(state, n): (String, Value)| Some((state, n.as_u64()?));
        Ok(states.into_iter().filter_map(count).collect())
    }

    /// Lets go of all that is not done. Returns how many tasks.
    ///
    /// # Errors
    ///
    /// As [`Dask::submit`].
    pub fn cancel(&self) -> Result<u64, DaskError> {
        let answer = self.ask("cancel", json!({}))?;
        Ok(answer["cancelled"].as_u64().unwrap_or(0))
    }

    fn ask(&self, verb: &str, mut asked: Value) -> Result<Value, DaskError> {
        asked["verb"] = verb.into();
        asked["address"] = self.address.into();
        asked["prefix"] = prefix(self.program, self.plan).into();
        let name = self.adapter.display().to_string();
        let mut command = Command::new(&self.adapter);
        let command = command.stdin(Stdio::piped()).stdout(Stdio::piped());
        let spawned = command.stderr(Stdio::piped()).spawn();
        let mut child = spawned.map_err(|_| DaskError::Missing(name.clone()))?;
        if let Some(mut to) = child.stdin.take() {
            // An adapter that does not read it reports why below.
            let _ = to.write_all(asked.to_string().as_bytes());
        }
        let refused = |reply: String| DaskError::Refused(name.clone(), reply);
        let ended = child.wait_with_output();
        let ended = ended.map_err(|e| refused(e.to_string()))?;
        let reply = String::from_utf8_lossy(&ended.stderr);
        let last = reply.lines().rfind(|line| !line.trim().is_empty());
        match ended.status.success() {
            true => serde_json::from_slice(&ended.stdout).map_err(|e| refused(e.to_string())),
            false => Err(refused(last.unwrap_or("nothing").trim().to_owned())),
        }
    }
}
