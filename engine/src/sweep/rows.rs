//! Rows in the points' order, each as soon as all before it are there.

use super::busy::Busy;
use super::points::Point;
use super::row::{End, Row};
use super::sweeping::Sweeping;
use super::whole::Member;
use crate::done::{Done, Status};
use crate::history::{self, RunSummary};
use crate::outcome::Outcome;
use crate::session::EngineError;
use crate::store::Store;
use crate::store::retention::KEPT_RECORDS;
use stage::{Files, Hash};
use std::sync::mpsc::Receiver;
use std::time::Instant;

/// A point, and what it is in the whole, or why it is wrong.
pub(super) type Entry = (Point, Result<Member, String>);

/// What all rows are made of.
pub(super) struct Common<'a> {
    pub(super) sweeping: &'a Sweeping<'a>,
    pub(super) store: &'a Store,
    pub(super) busy: &'a Busy,
    /// The files of each input of the whole, and their content.
    pub(super) files: &'a [Files],
    pub(super) contents: &'a [Hash],
    /// So many points come after these, at least.
    pub(super) after: usize,
}

/// The rows of points that run together.
pub(super) struct Rows<'a> {
    common: Common<'a>,
    points: std::iter::Peekable<std::vec::IntoIter<Entry>>,
    /// One entry a node of the whole.
    nodes: Vec<Option<Done>>,
    /// Whether the node is in a row already: in all later ones it is found.
    reported: Vec<bool>,
    /// How many nodes of the next point are known to be done.
    done: usize,
    /// When the row before was there.
    since: Instant,
    /// The id of the record of the first run.
    id: Option<String>,
    rows: Vec<Row>,
}

impl<'a> Rows<'a> {
    /// Of points whose whole has so many nodes; `id` is that of the first record.
    pub(super) fn new(
        common: Common<'a>,
        points: Vec<Entry>,
        nodes: usize,
        since: Instant,
        id: String,
    ) -> Rows<'a> {
        Rows {
            common,
            points: points.into_iter().peekable(),
            nodes: vec![None; nodes],
            reported: vec![false; nodes],
            done: 0,
            since,
            id: Some(id),
            rows: vec![],
        }
    }

    /// Takes what is done as it comes, until nothing more comes.
    pub(super) fn hear(
        &mut self,
        heard: &Receiver<(usize, Done)>,
        report: &mut impl FnMut(&Row),
    ) -> Result<(), EngineError> {
        self.whole(report)?;
        while let Ok((node, done)) = heard.recv() {
            self.nodes[node] = Some(done);
            self.whole(report)?;
        }
        Ok(())
    }

    /// The rows of the next points all of whose nodes are done.
    fn whole(&mut self, report: &mut impl FnMut(&Row)) -> Result<(), EngineError> {
        while let Some((_, member)) = self.points.peek() {
            if let Ok(member) = member {
                let open = |place: &Option<usize>| place.is_some_and(|p| self.nodes[p].is_none());
                let left = &member.places[self.done..];
                match left.iter().position(open) {
                    Some(more) => {
                        self.done += more;
                        return Ok(());
                    }
                    None => self.done = 0,
                }
            }
            let (point, member) = self.points.next().expect("bug: peeked");
            self.row(point, member, report)?;
        }
        Ok(())
    }

    /// The rest, once nothing runs any more. Of the points that a stop kept from their end only the first
    /// gets a row.
    pub(super) fn rest(
        mut self,
        nodes: Vec<Option<Done>>,
        report: &mut impl FnMut(&Row),
    ) -> Result<Vec<Row>, EngineError> {
        self.nodes = nodes;
        let mut stopped = false;
        while let Some((point, member)) = self.points.next() {
            let cancelled = |member: &Member| {
                let mut nodes = member.places.iter().flatten();
                nodes.any(|p| {
                    self.nodes[*p]
                        .as_ref()
                        .is_some_and(|d| d.status == Status::Cancelled)
                })
            };
            let is_stopped = member.as_ref().is_ok_and(cancelled);
            if !is_stopped || !stopped {
                self.row(point, member, report)?;
            }
            stopped |= is_stopped;
        }
        Ok(self.rows)
    }

    /// The row of a point, and the record of its run.
    fn row(
        &mut self,
        point: Point,
        member: Result<Member, String>,
        report: &mut impl FnMut(&Row),
    ) -> Result<(), EngineError> {
        let mut row = Row::new(point, End::Stopped);
        match member {
            Err(why) => row.end = End::Wrong(why),
            Ok(member) => self.fill(&mut row, &member)?,
        }
        let now = Instant::now();
        row.seconds = (now - self.since).as_secs_f64();
        let busy = self.common.busy.seconds(self.since, now);
        row.engine = (row.seconds - busy).max(0.0);
        self.since = now;
        report(&row);
        self.rows.push(row);
        Ok(())
    }

    fn fill(&mut self, row: &mut Row, member: &Member) -> Result<(), EngineError> {
        let Common {
            sweeping,
            store,
            files,
            contents,
            after,
            ..
        } = self.common;
        let Member { graph, wanted, .. } = member;
        let nodes = member.places.iter().map(|place| self.taken((*place)?));
        let nodes: Vec<Option<Done>> = nodes.collect();
        let inputs: Vec<Hash> = member.inputs.iter().map(|i| contents[*i]).collect();
        let files: Vec<Files> = member.inputs.iter().map(|i| files[*i].clone()).collect();
        let seconds = self.since.elapsed().as_secs_f64();
        // The record of a point that found all goes as soon as so many newer ones are there.
        let found = nodes.iter().flatten().all(|d| d.status == Status::Hit);
        if !found || self.points.len().saturating_add(after) < KEPT_RECORDS {
            let id = self.id.take().map_or_else(|| store.next_run(), Ok)?;
            let summary = RunSummary {
                graph,
                nodes: &nodes,
                inputs: &inputs,
                seconds,
            };
            history::write(store, &id, &summary, &files)?;
        }
        let names = graph.nodes.iter().map(|n| (n.name.clone(), n.stage));
        let outcome = Outcome {
            names: names.collect(),
            inputs,
            nodes,
            seconds,
            store: Store::open(store.root())?,
            _using: store.using(),
        };
        row.fill(sweeping, graph, wanted, &outcome);
        Ok(())
    }

    /// A node of the whole as a row has it: what was made for another row is found in this one.
    fn taken(&mut self, place: usize) -> Option<Done> {
        let mut done = self.nodes[place].clone()?;
        let before = std::mem::replace(&mut self.reported[place], true);
        if before && done.status == Status::Executed {
            done.status = Status::Hit;
        }
        Some(done)
    }
}
