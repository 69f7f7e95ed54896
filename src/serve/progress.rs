//! How far a measuring is: reported by the engine, looked at by pages.

use super::record::Ended;
use engine::walk::{Done, Status, Watch};
use serde::Serialize;
use stage::Message;
use std::collections::BTreeMap;
use std::time::Instant;
use tokio::sync::watch;

/// A node on its way.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct Step {
    /// Its name in the pipeline.
    pub(super) node: String,
    /// `open`, `running`, `found`, `made`, `failed`, `skipped`, `cancelled`.
    pub(super) state: &'static str,
    /// How much of its loop is done, of how much.
    pub(super) done: usize,
    pub(super) of: usize,
    /// How long it took, if it is done. \[s\]
    pub(super) seconds: f64,
    /// How long it took the last time, of whatever capture. \[s\]
    pub(super) expected: Option<f64>,
}

/// All of it.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub(super) struct Progress {
    /// `none`, `waiting`, `running`, `done`, `failed`, `stopped`, `interrupted`.
    pub(super) state: &'static str,
    /// Every node that is needed, in the pipeline's order.
    pub(super) steps: Vec<Step>,
    /// Why it failed.
    pub(super) why: Vec<Message>,
    /// What the user should know.
    pub(super) warnings: Vec<Message>,
    /// How long it took, if it is over. \[s\]
    pub(super) seconds: f64,
    /// Stage and content of results that can be shown, by node.
    pub(super) pictures: BTreeMap<String, (String, String)>,
}

impl Progress {
    /// Of one that is over, or was interrupted, as the disk knows it.
    pub(super) fn past(ended: Option<&Ended>) -> Progress {
        let Some(ended) = ended else {
            return Progress {
                state: "none",
                ..Progress::default()
            };
        };
        let state = match ended.state.as_str() {
            "done" => "done",
            "failed" => "failed",
            "stopped" => "stopped",
            _ => "interrupted",
        };
        Progress {
            state,
            why: ended.why.clone(),
            warnings: ended.warnings.clone(),
            seconds: ended.seconds,
            pictures: ended.results.clone(),
            ..Progress::default()
        }
    }

    /// Whether somebody works on it.
    pub(super) fn goes_on(&self) -> bool {
        ["waiting", "running"].contains(&self.state)
    }

    /// How long it may still take, where that is known of every node that is left. \[s\]
    pub(super) fn left(&self) -> Option<f64> {
        let open = self
            .steps
            .iter()
            .filter(|s| ["open", "running"].contains(&s.state));
        let left = |s: &Step| {
            let share = if s.of > 0 {
                s.done as f64 / s.of as f64
            } else {
                0.0
            };
            Some(s.expected? * (1.0 - share))
        };
        open.map(left).sum()
    }
}

/// Tells pages what the engine does.
pub(super) struct Teller {
    sender: watch::Sender<Progress>,
    /// The nodes whose results can be shown, with their stages.
    shown: BTreeMap<String, &'static str>,
    since: Instant,
}

impl Teller {
    /// To whoever looks at `sender`.
    pub(super) fn new(
        sender: watch::Sender<Progress>,
        shown: BTreeMap<String, &'static str>,
    ) -> Teller {
        Teller {
            sender,
            shown,
            since: Instant::now(),
        }
    }

    fn step(&self, node: &str, change: impl FnOnce(&mut Step)) {
        self.sender.send_modify(|progress| {
            if let Some(step) = progress.steps.iter_mut().find(|s| s.node == node) {
                change(step);
            }
        });
    }

    /// How long it goes on. \[s\]
    pub(super) fn seconds(&self) -> f64 {
        self.since.elapsed().as_secs_f64()
    }
}

impl Watch for Teller {
    fn started(&self, node: &str) {
        self.step(node, |step| step.state = "running");
    }

    fn progress(&self, node: &str, _: &str, done: usize, of: usize) {
        self.step(node, |step| (step.done, step.of) = (done, of));
    }

    fn done(&self, node: &str, done: &Done) {
        self.step(node, |step| {
            step.state = done.status.word();
            step.seconds = done.seconds;
        });
        let well = matches!(done.status, Status::Hit | Status::Executed);
        let (Some(stage), Some(content), true) = (self.shown.get(node), done.content, well) else {
            return;
        };
        let result = ((*stage).to_owned(), content.to_hex().to_string());
        self.sender
            .send_modify(|p| _ = p.pictures.insert(node.to_owned(), result));
    }
}
