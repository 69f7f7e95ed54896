//! A pipeline as SVG: a row a step, so that every arrow points down; coloured by what a run would do.

use crate::drawing::color;
use crate::graph::{Graph, Source};
use crate::plan::Planned;
use std::fmt::Write;

const BOX: [usize; 2] = [150, 40];
const GAP: [usize; 2] = [22, 46];
const MARGIN: usize = 16;

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
    let width = widest * w - GAP[0] + 2 * MARGIN;
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
        let (x1, y1) = (left(spot) + BOX[0] / 2, top(spot));
        for from in spot.reads.iter().map(|i| &spots[*i]) {
            let (x0, y0) = (left(from) + BOX[0] / 2, top(from) + BOX[1]);
            let bend = GAP[1] / 2 + (y1 - y0) / 4;
            let _ = writeln!(
                svg,
                "<path d=\"M{x0} {y0}C{x0} {} {x1} {} {x1} {y1}\" fill=\"none\" stroke=\"#8a8f98\"/>",
                y0 + bend,
                y1.saturating_sub(bend)
            );
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
    use crate::plan::State;
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
            line: input.files.join(", "),
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
            line: node.stage.name().into(),
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

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}
