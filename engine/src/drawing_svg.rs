//! A pipeline as SVG: a row a step, so that every arrow points down; coloured by what a run would do.

use crate::graph::{Graph, Source};
use crate::plan::{Planned, State};
use std::fmt::Write;

const BOX: [usize; 2] = [150, 40];
const GAP: [usize; 2] = [22, 46];
const MARGIN: usize = 16;

/// How far an arrow over so many rows bows out. \[px\]
fn bow(rows: usize) -> usize {
    if rows < 2 { 0 } else { 8 + 9 * rows }
}

/// A box of the drawing: an input or a node.
struct Spot {
    row: usize,
    /// Place in the row, from the left.
    at: usize,
    title: String,
    line: String,
    fill: &'static str,
    reads: Vec<usize>,
}

/// The drawing.
pub(crate) fn svg(graph: &Graph, plan: &[Option<Planned>]) -> String {
    let mut spots = spots(graph, plan);
    let widest = arrange(&mut spots);
    let rows = spots.iter().map(|s| s.row + 1).max().unwrap_or(0);
    let [w, h] = [0, 1].map(|i| BOX[i] + GAP[i]);
    let longest = spots
        .iter()
        .flat_map(|s| s.reads.iter().map(|i| s.row - spots[*i].row));
    let around = bow(longest.max().unwrap_or(0));
    let width = widest * w - GAP[0] + 2 * MARGIN + around;
    let height = rows * h - GAP[1] + 2 * MARGIN + 26;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" \
         height=\"{height}\" font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n"
    );
    let count = |row: usize| spots.iter().filter(|s| s.row == row).count();
    let counts: Vec<usize> = (0..rows).map(count).collect();
    // Rows stand in the middle, in half steps.
    let left = |s: &Spot| MARGIN + s.at * w + (widest - counts[s.row]) * w / 2;
    let top = |s: &Spot| MARGIN + s.row * h;
    for spot in &spots {
        for from in spot.reads.iter().map(|i| &spots[*i]) {
            let path = match spot.row - from.row {
                1 => {
                    let (x0, y0) = (left(from) + BOX[0] / 2, top(from) + BOX[1]);
                    let (x1, y1) = (left(spot) + BOX[0] / 2, top(spot));
                    let y = (y0 + y1) / 2;
                    format!("M{x0} {y0}C{x0} {y} {x1} {y} {x1} {y1}")
                }
                // Around the boxes between, on the right.
                rows => {
                    let [x0, x1] = [from, spot].map(|s| left(s) + BOX[0]);
                    let [y0, y1] = [from, spot].map(|s| top(s) + BOX[1] / 2);
                    let x = x0.max(x1) + bow(rows) * 4 / 3;
                    format!("M{x0} {y0}C{x} {y0} {x} {y1} {x1} {y1}")
                }
            };
            let _ = writeln!(svg, "<path d=\"{path}\" fill=\"none\" stroke=\"#8a8f98\"/>");
        }
    }
    for spot in &spots {
        let (x, y) = (left(spot), top(spot));
        let middle = x + BOX[0] / 2;
        let _ = writeln!(
            svg,
            "<g><title>{0}: {1}</title><rect x=\"{x}\" y=\"{y}\" width=\"{2}\" height=\"{3}\" rx=\"6\" fill=\"{4}\" stroke=\"#555b66\"/>\
             <text x=\"{middle}\" y=\"{5}\" text-anchor=\"middle\" font-weight=\"bold\">{0}</text>\
             <text x=\"{middle}\" y=\"{6}\" text-anchor=\"middle\" font-size=\"10\" fill=\"#444\">{1}</text></g>",
            escaped(&spot.title),
            escaped(&spot.line),
            BOX[0],
            BOX[1],
            spot.fill,
            y + 17,
            y + 31,
        );
    }
    let mut x = MARGIN;
    for (fill, word) in legend() {
        let y = height - MARGIN - 10;
        let _ = writeln!(
            svg,
            "<rect x=\"{x}\" y=\"{y}\" width=\"10\" height=\"10\" fill=\"{fill}\" stroke=\"#555b66\"/>\
             <text x=\"{}\" y=\"{}\" font-size=\"10\">{word}</text>",
            x + 14,
            y + 9
        );
        x += 24 + 6 * word.len();
    }
    svg + "</svg>\n"
}

fn legend() -> [(&'static str, &'static str); 4] {
    let of = |state: State| color(Some(&state));
    [
        (of(State::Cached), "cached"),
        (of(State::Stale(vec![])), "will run"),
        (of(State::May), "may run"),
        (color(None), "not asked"),
    ]
}

fn spots(graph: &Graph, plan: &[Option<Planned>]) -> Vec<Spot> {
    let inputs = graph.inputs.len();
    let mut spots: Vec<Spot> = Vec::new();
    for input in &graph.inputs {
        spots.push(Spot {
            row: 0,
            at: 0,
            title: format!("@{}", input.name),
            line: shortened(&input.files.join(", ")),
            fill: "#ffffff",
            reads: vec![],
        });
    }
    for (node, planned) in graph.nodes.iter().zip(plan) {
        let place = |source: &Source| match source {
            Source::Input(i) => *i,
            Source::Node(j) => inputs + j,
        };
        let mut reads: Vec<usize> = node.from.iter().flatten().map(place).collect();
        reads.sort_unstable();
        reads.dedup();
        let row = reads.iter().map(|i| spots[*i].row + 1).max().unwrap_or(0);
        spots.push(Spot {
            row,
            at: 0,
            title: node.name.clone(),
            line: shortened(node.stage.name()),
            fill: color(planned.as_ref().map(|p| &p.state)),
            reads,
        });
    }
    spots
}

/// Puts the boxes of each row in the order of the mean place of what they read. Returns the
/// greatest number of boxes in a row.
fn arrange(spots: &mut [Spot]) -> usize {
    let rows = spots.iter().map(|s| s.row + 1).max().unwrap_or(0);
    let mut widest = 1;
    for row in 0..rows {
        let mut here: Vec<usize> = (0..spots.len()).filter(|i| spots[*i].row == row).collect();
        let mean = |i: &usize| {
            let reads = &spots[*i].reads;
            let sum: usize = reads.iter().map(|j| spots[*j].at).sum();
            sum as f64 / reads.len().max(1) as f64
        };
        here.sort_by(|a, b| mean(a).total_cmp(&mean(b)).then(a.cmp(b)));
        widest = widest.max(here.len());
        for (at, i) in here.into_iter().enumerate() {
            spots[i].at = at;
        }
    }
    widest
}

/// What fits into a box.
fn shortened(text: &str) -> String {
    match text.char_indices().nth(24) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}
/// The colour of a node; `None` is not asked.
pub(crate) fn color(state: Option<&State>) -> &'static str {
    match state {
        Some(State::Cached) => "#b7e4c7",
        Some(State::Stale(_)) => "#ffb4a2",
        Some(State::May) => "#ffe8a3",
        None => "#e5e5e5",
    }
}
