//! A run in a program's own words, for people who know none of its nodes: a few steps in place of them.

use engine::walk::{Done, Status};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::time::Instant;

/// How a program reports a run. Steps are numbers in the order in which they follow each other.
pub trait Telling: Send + Sync {
    /// The step that a node belongs to.
    fn step(&self, node: &str) -> usize;
    /// What is printed when a node is done: lines.
    fn heard(&self, node: &str, done: &Done) -> Vec<String>;
    /// A step that is over, as a line where there is no terminal; whether all of it was found.
    fn over(&self, step: usize, found: bool) -> String;
    /// The line of a terminal: the step that runs, how long the run goes on, and how long it may still take. \[s\]
    fn line(&self, step: usize, spent: f64, left: Option<f64>) -> String;
}

/// The steps of a run that goes on.
pub(super) struct Steps {
    telling: Arc<dyn Telling>,
    /// The nodes of each that are not done.
    open: BTreeMap<usize, BTreeSet<String>>,
    /// Those of which something was made.
    made: BTreeSet<usize>,
    since: Instant,
}

impl Steps {
    /// Of a walk of these nodes.
    pub(super) fn new<'a>(
        telling: &Arc<dyn Telling>,
        nodes: impl Iterator<Item = &'a String>,
    ) -> Steps {
        let mut open: BTreeMap<usize, BTreeSet<String>> = BTreeMap::new();
        for node in nodes {
            let step = open.entry(telling.step(node)).or_default();
            step.insert(node.clone());
        }
        Steps {
            telling: telling.clone(),
            open,
            made: BTreeSet::new(),
            since: Instant::now(),
        }
    }

    /// What is printed above the line of a terminal now that a node is done, and, where there is no terminal, besides.
    pub(super) fn done(&mut self, node: &str, done: &Done) -> [Vec<String>; 2] {
        let lines = self.telling.heard(node, done);
        let well = matches!(done.status, Status::Hit | Status::Executed);
        let step = self.telling.step(node);
        if done.status == Status::Executed {
            self.made.insert(step);
        }
        let open = self.open.get_mut(&step).filter(|_| well);
        let over = open.is_some_and(|nodes| nodes.remove(node) && nodes.is_empty());
        let over = over.then(|| self.telling.over(step, !self.made.contains(&step)));
        [lines, over.into_iter().collect()]
    }

    /// The line of a terminal, while these nodes run.
    pub(super) fn line<'a>(
        &self,
        running: impl Iterator<Item = &'a str>,
        left: Option<f64>,
    ) -> String {
        let first_open = self.open.iter().find(|(_, nodes)| !nodes.is_empty());
        let step = running.map(|node| self.telling.step(node)).max();
        match step.or(first_open.map(|(step, _)| *step)) {
            Some(step) => {
                let spent = self.since.elapsed().as_secs_f64();
                self.telling.line(step, spent, left)
            }
            None => String::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two steps: `a…` and all else.
    struct Two;

    impl Telling for Two {
        fn step(&self, node: &str) -> usize {
            usize::from(!node.starts_with('a'))
        }

        fn heard(&self, _: &str, done: &Done) -> Vec<String> {
            done.warnings.iter().map(String::from).collect()
        }

        fn over(&self, step: usize, found: bool) -> String {
            format!("{step} {found}")
        }

        fn line(&self, step: usize, _: f64, left: Option<f64>) -> String {
            format!("{step} {left:?}")
        }
    }

    #[test]
    fn a_step_is_over_once_when_its_last_node_is_done_well() {
        let names = ["a1", "a2", "b"].map(str::to_owned);
        let telling: Arc<dyn Telling> = Arc::new(Two);
        let mut steps = Steps::new(&telling, names.iter());
        let mut over = |node: &str, status| {
            let [_, over] = steps.done(node, &Done::nothing(status));
            over.concat()
        };
        assert_eq!(over("a1", Status::Hit), "");
        assert_eq!(over("a2", Status::Failed("so".into())), "");
        assert_eq!(over("b", Status::Executed), "1 false");
        assert_eq!(over("a2", Status::Hit), "0 true");
        // What is made again is over already.
        assert_eq!(over("a2", Status::Executed), "");
    }

    #[test]
    fn the_line_shows_the_last_step_that_runs() {
        let names = ["a1", "b"].map(str::to_owned);
        let telling: Arc<dyn Telling> = Arc::new(Two);
        let steps = Steps::new(&telling, names.iter());
        assert_eq!(steps.line(["b", "a1"].into_iter(), None), "1 None");
        assert_eq!(steps.line([].into_iter(), Some(2.0)), "0 Some(2.0)");
    }
}
