//! A pipeline as SVG: a row a step, so that every line goes down; what many nodes read is named in each;
//! coloured by what a run would do.

use crate::drawing_layout::{Line, Placed, placed};
use crate::graph::{Graph, Source};
use crate::plan::{Planned, State};
use std::fmt::Write;

/// Least width of a box, its height without and with a row of badges, and what lies between rows. \[px\]
const LEAST: usize = 150;
const TALL: [usize; 2] = [40, 58];
const BETWEEN: usize = 34;
const MARGIN: usize = 16;
/// What more nodes read than this is named in each of them, in place of a line to each.
const LINES: usize = 4;
/// Fills of badges.
const BADGES: [&str; 6] = [
    "#cfe3ff", "#ffd9c2", "#e3d5f5", "#c9ece6", "#fbe6a6", "#f6cfe0",
];

/// A box of the drawing: an input or a node.
struct Spot {
    row: usize,
    title: String,
    line: String,
    fill: &'static str,
    reads: Vec<usize>,
}

/// The drawing.
pub(crate) fn svg(graph: &Graph, plan: &[Option<Planned>]) -> String {
    let spots = spots(graph, plan);
    let badges = badges(&spots);
    let lines: Vec<(usize, usize)> = (0..spots.len())
        .flat_map(|to| spots[to].reads.iter().map(move |from| (*from, to)))
        .filter(|(from, _)| badges[*from].is_none())
        .collect();
    let badge_width = |i: &usize| 8 + 6 * spots[*i].title.chars().count();
    let named = |s: &Spot| -> Vec<usize> {
        let named = s.reads.iter().copied();
        named.filter(|i| badges[*i].is_some()).collect()
    };
    let wide = |s: &Spot| {
        let badges: usize = named(s).iter().map(|i| badge_width(i) + 4).sum();
        (badges + 8).max(8 * s.title.chars().count() + 16)
    };
    let wide = spots.iter().map(wide).max().unwrap_or(0).max(LEAST);
    let tall = TALL[usize::from(badges.iter().any(Option::is_some))];
    let rows: Vec<usize> = spots.iter().map(|s| s.row).collect();
    let placed = placed(&rows, &lines, wide as f64);
    let width = (placed.width as usize).max(340) + 2 * MARGIN;
    let count = rows.iter().map(|row| row + 1).max().unwrap_or(0);
    let height = count * (tall + BETWEEN) + 2 * MARGIN;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" \
         height=\"{height}\" font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n"
    );
    let top = |row: usize| MARGIN + row * (tall + BETWEEN);
    for line in &placed.lines {
        let path = path(line, &placed, [rows[line.from], rows[line.to]], tall);
        let _ = writeln!(svg, "<path d=\"{path}\" fill=\"none\" stroke=\"#8a8f98\"/>");
    }
    for (i, (spot, middle)) in spots.iter().zip(&placed.middles).enumerate() {
        let left = MARGIN as f64 + middle - wide as f64 / 2.0;
        let at = [left, top(spot.row) as f64];
        drawn(&mut svg, spot, at, [wide, tall], badges[i]);
        let mut x = left + 6.0;
        for from in named(spot) {
            let size = badge_width(&from);
            badge(
                &mut svg,
                [x, at[1] + 38.0],
                size,
                &spots[from].title,
                badges[from],
            );
            x += size as f64 + 4.0;
        }
    }
    keys(&mut svg, height);
    svg + "</svg>\n"
}

/// Which boxes are named where they are read, each with its fill.
fn badges(spots: &[Spot]) -> Vec<Option<&'static str>> {
    let readers = |i: usize| spots.iter().filter(|s| s.reads.contains(&i)).count();
    let mut fills = BADGES.iter().copied().cycle();
    let badge = |i: usize| (readers(i) > LINES).then(|| fills.next()).flatten();
    (0..spots.len()).map(badge).collect()
}

/// A line's way: down through the rows between, straight beside boxes, bent between rows.
fn path(line: &Line, placed: &Placed, [first, last]: [usize; 2], tall: usize) -> String {
    let top = |row: usize| (MARGIN + row * (tall + BETWEEN)) as f64;
    let mut x = MARGIN as f64 + placed.middles[line.from];
    let mut y = top(first) + tall as f64;
    let mut path = format!("M{x:.1} {y}");
    let lanes = line.through.iter().map(|x| (*x, true));
    let ends = [(placed.middles[line.to], false)];
    for (row, (to, through)) in (first + 1..=last).zip(lanes.chain(ends)) {
        let (to, below) = (MARGIN as f64 + to, top(row));
        let bend = (y + below) / 2.0;
        let _ = write!(path, "C{x:.1} {bend} {to:.1} {bend} {to:.1} {below}");
        (x, y) = (to, below);
        if through {
            y += tall as f64;
            let _ = write!(path, "V{y}");
        }
    }
    path
}

/// A box with its two lines of text; what is named elsewhere has the fill of its badge on its left edge.
fn drawn(
    svg: &mut String,
    spot: &Spot,
    [x, y]: [f64; 2],
    [wide, tall]: [usize; 2],
    named: Option<&str>,
) {
    let middle = x + wide as f64 / 2.0;
    let _ = writeln!(
        svg,
        "<g><title>{0}: {1}</title><rect x=\"{x:.1}\" y=\"{y}\" width=\"{wide}\" height=\"{tall}\" rx=\"6\" fill=\"{2}\" stroke=\"#555b66\"/>\
         <text x=\"{middle:.1}\" y=\"{3}\" text-anchor=\"middle\" font-weight=\"bold\">{0}</text>\
         <text x=\"{middle:.1}\" y=\"{4}\" text-anchor=\"middle\" font-size=\"10\" fill=\"#444\">{1}</text></g>",
        escaped(&spot.title),
        escaped(&spot.line),
        spot.fill,
        y + 16.0,
        y + 29.0,
    );
    if let Some(fill) = named {
        let _ = writeln!(
            svg,
            "<rect x=\"{:.1}\" y=\"{}\" width=\"10\" height=\"{}\" rx=\"4\" fill=\"{fill}\" stroke=\"#555b66\"/>",
            x - 5.0,
            y + 8.0,
            tall - 16,
        );
    }
}

/// The name of what a node reads, in the node's box.
fn badge(svg: &mut String, [x, y]: [f64; 2], size: usize, name: &str, fill: Option<&str>) {
    let _ = writeln!(
        svg,
        "<rect x=\"{x:.1}\" y=\"{y}\" width=\"{size}\" height=\"15\" rx=\"7\" fill=\"{}\" stroke=\"#555b66\" stroke-width=\".6\"/>\
         <text x=\"{:.1}\" y=\"{}\" text-anchor=\"middle\" font-size=\"10\">{}</text>",
        fill.unwrap_or("#ffffff"),
        x + size as f64 / 2.0,
        y + 11.0,
        escaped(name),
    );
}

/// What the fills mean.
fn keys(svg: &mut String, height: usize) {
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
            title: node.name.clone(),
            line: shortened(node.stage.name()),
            fill: color(planned.as_ref().map(|p| &p.state)),
            reads,
        });
    }
    spots
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
