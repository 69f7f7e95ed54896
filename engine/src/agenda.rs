//! The walk's book: what is ready, what waits for what, what is still read. Linear in the graph.

use crate::done::{Done, Job, Status, needed, sources};
use crate::graph::{Graph, Source};
use stage::{AnyArtifact, Hash};
use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

/// What is ready, what waits, what is done.
pub(crate) struct Agenda<'a> {
    graph: &'a Graph,
    inputs: Vec<(Hash, AnyArtifact)>,
    pub(crate) needed: Vec<bool>,
    wanted: Vec<bool>,
    pub(crate) done: Vec<Option<Done>>,
    /// Ports of a node whose node is not done.
    waits: Vec<usize>,
    /// The needed nodes that read a node, once a port: `readers[first[i]..first[i + 1]]`.
    readers: Vec<usize>,
    first: Vec<usize>,
    /// How many of them are not done.
    unread: Vec<usize>,
    /// Results in memory, while somebody still reads them.
    alive: Vec<Option<AnyArtifact>>,
    /// What can run now: the first of the pipeline on top.
    ready: BinaryHeap<Reverse<usize>>,
    /// What another process makes just now.
    busy: Vec<usize>,
    /// Nodes that are made again since their result went out of the store, and who waits for that.
    again: BTreeMap<usize, Vec<usize>>,
    tries: BTreeMap<usize, usize>,
    pub(crate) running: usize,
    pub(crate) stop: bool,
}

/// How often what a node reads may go out of the store before the run gives up.
const MOST_TRIES: usize = 3;

impl<'a> Agenda<'a> {
    /// For the wanted nodes of a graph and all that they need.
    pub(crate) fn new(job: &Job<'a>) -> Self {
        let (graph, wanted) = (job.graph, job.wanted);
        let n = graph.nodes.len();
        let needed = needed(graph, wanted);
        let (mut waits, mut unread) = (vec![0; n], vec![0; n]);
        let wires = || {
            (0..n)
                .filter(|i| needed[*i])
                .flat_map(|i| sources(graph, i).map(move |j| (i, j)))
        };
        wires().for_each(|(i, j)| {
            waits[i] += 1;
            unread[j] += 1;
        });
        let mut first = vec![0; n + 1];
        (0..n).for_each(|j| first[j + 1] = first[j] + unread[j]);
        let (mut readers, mut next) = (vec![0; first[n]], first.clone());
        wires().for_each(|(i, j)| {
            readers[next[j]] = i;
            next[j] += 1;
        });
        let mut is_wanted = vec![false; n];
        wanted.iter().for_each(|i| is_wanted[*i] = true);
        let inputs = job.contents.iter().zip(job.files);
        Agenda {
            graph,
            inputs: inputs
                .map(|(c, f)| (*c, AnyArtifact::new(f.clone())))
                .collect(),
            ready: (0..n)
                .filter(|i| needed[*i] && waits[*i] == 0)
                .map(Reverse)
                .collect(),
            needed,
            wanted: is_wanted,
            done: vec![None; n],
            waits,
            readers,
            first,
            unread,
            alive: vec![None; n],
            busy: vec![],
            again: BTreeMap::new(),
            tries: BTreeMap::new(),
            running: 0,
            stop: false,
        }
    }

    /// What can run now.
    pub(crate) fn next(&mut self) -> Option<usize> {
        self.ready.pop().map(|Reverse(node)| node)
    }

    /// Whether a node's result must be there: it is wanted, or somebody reads it now. Of any other
    /// node it is enough that its content is known.
    pub(crate) fn there(&self, node: usize) -> bool {
        self.wanted[node] || self.again.contains_key(&node)
    }

    /// Puts a node off that another process makes just now.
    pub(crate) fn put_off(&mut self, node: usize) {
        self.busy.push(node);
    }

    /// What was put off is ready once more; whether there was any.
    pub(crate) fn retry(&mut self) -> bool {
        let any = !self.busy.is_empty();
        self.ready.extend(self.busy.drain(..).map(Reverse));
        any
    }

    /// Whether nothing can run now, and nothing that runs could change that.
    pub(crate) fn idle(&self) -> bool {
        self.ready.is_empty() && self.busy.is_empty() && self.running == 0
    }

    /// Whether something was put off.
    pub(crate) fn has_put_off(&self) -> bool {
        !self.busy.is_empty()
    }

    /// A node is done. Returns the nodes that cannot run any more.
    pub(crate) fn finish(
        &mut self,
        node: usize,
        done: Done,
        artifact: Option<AnyArtifact>,
    ) -> Vec<usize> {
        let status = match (&done.content, &done.status) {
            (Some(_), _) => None,
            (None, Status::Cancelled) => Some(Status::Cancelled),
            (None, _) => Some(Status::Skipped),
        };
        self.done[node] = Some(done);
        if self.unread[node] > 0 {
            self.alive[node] = artifact;
        }
        let waiting = self.again.remove(&node);
        let first_time = waiting.is_none();
        let waiting = waiting
            .unwrap_or_else(|| self.readers[self.first[node]..self.first[node + 1]].to_vec());
        let mut skipped = Vec::new();
        match status {
            None => {
                for reader in waiting {
                    self.waits[reader] -= 1;
                    let open = self.done[reader].is_none() || self.again.contains_key(&reader);
                    if self.waits[reader] == 0 && open {
                        self.ready.push(Reverse(reader));
                    }
                }
            }
            Some(status) => self.skip(waiting, &status, &mut skipped),
        }
        if first_time {
            let graph = self.graph;
            sources(graph, node).for_each(|j| self.read(j));
        }
        skipped
    }

    fn skip(&mut self, mut open: Vec<usize>, status: &Status, skipped: &mut Vec<usize>) {
        while let Some(i) = open.pop() {
            if self.done[i].is_none() {
                self.done[i] = Some(Done::nothing(status.clone()));
                skipped.push(i);
                open.extend_from_slice(&self.readers[self.first[i]..self.first[i + 1]]);
                let graph = self.graph;
                sources(graph, i).for_each(|j| self.read(j));
            }
        }
    }

    /// One reader of a node less; the last one lets go of its result.
    fn read(&mut self, node: usize) {
        self.unread[node] -= 1;
        if self.unread[node] == 0 {
            self.alive[node] = None;
        }
    }

    /// Results that a node reads are gone from the store: they are made again first. `false` if
    /// that has been tried too often for this node.
    pub(crate) fn gone(&mut self, node: usize, gone: &[usize]) -> bool {
        let tries = self.tries.entry(node).or_default();
        *tries += 1;
        if *tries > MOST_TRIES {
            return false;
        }
        // What is in memory was made again for another reader since this one looked.
        let lost = |j: &usize| self.alive[*j].is_none();
        let lost: Vec<usize> = gone.iter().copied().filter(lost).collect();
        self.waits[node] = lost.len();
        if lost.is_empty() {
            self.ready.push(Reverse(node));
        }
        for j in lost {
            let waiting = self.again.entry(j).or_default();
            waiting.push(node);
            if waiting.len() == 1 {
                self.ready.push(Reverse(j));
            }
        }
        true
    }

    /// The content at each port, if all that the node reads is done.
    pub(crate) fn contents(&self, node: usize) -> Option<Vec<Option<Hash>>> {
        let content = |source: &Option<Source>| match source {
            None => Some(None),
            Some(Source::Input(i)) => Some(Some(self.inputs[*i].0)),
            Some(Source::Node(j)) => self.done[*j].as_ref().map(|d| d.content),
        };
        self.graph.nodes[node].from.iter().map(content).collect()
    }

    /// The artifacts at each port that are in memory already.
    pub(crate) fn at_hand(&self, node: usize) -> Vec<Option<AnyArtifact>> {
        let artifact = |source: &Option<Source>| match source.as_ref()? {
            Source::Input(i) => Some(self.inputs[*i].1.clone()),
            Source::Node(j) => self.alive[*j].clone(),
        };
        self.graph.nodes[node].from.iter().map(artifact).collect()
    }
}
