//! Girth of the trunk over height, as a drawing.

use crate::labels::spread;
use crate::lengths::Lengths;
use crate::tables::escaped;
use crate::ticks::ticks;
use shape::{Girth, Girths};
use std::fmt::Write;

/// A girth that changes by more than this from one height to the next jumps (structural: it decides how a line is drawn
/// alone).
const JUMP_SHARE: f64 = 0.06;

/// An axis has no more ticks (structural: layout).
const TICKS: usize = 7;

/// Width of the column that holds names of girths, and height of a line of it (structural: layout).
const NAMES: f64 = 186.0;
/// Height of a line (structural: the drawing's layout).
const LINE: f64 = 16.0;

/// An SVG of the curve; each horizontal girth is a dot on it, led to its name beside the drawing. Empty without a curve. Where the girth
/// jumps, because limbs join or part, the curve is dotted.
pub(crate) fn svg(girths: &Girths, ground_mm: f64, lengths: Lengths) -> String {
    let profile = &girths.profile;
    let pairs: Vec<(f64, f64)> = profile
        .height_mm
        .iter()
        .copied()
        .zip(profile.tape_mm.iter().copied())
        .collect();
    let (Some(first), Some(last)) = (pairs.first(), pairs.last()) else {
        return String::new();
    };
    let (low, high) = (first.0, last.0.max(first.0 + 1.0));
    let widest = pairs.iter().map(|p| p.1).fold(1.0, f64::max);
    let narrowest = pairs.iter().map(|p| p.1).fold(widest, f64::min);
    let span = (widest - narrowest).max(1.0);
    let (w, h, left, bottom) = (620.0, 320.0, 46.0, 30.0);
    let right = w - NAMES;
    let x = |girth: f64| left + (girth - narrowest + 0.05 * span) / (1.1 * span) * (right - left);
    let y = |height: f64| 8.0 + (high - height) / (high - low) * (h - bottom - 8.0);
    let mut svg = format!(
        "<svg class=\"profile\" viewBox=\"0 0 {w} {h}\" role=\"img\" aria-label=\"girth of the trunk over height\">"
    );
    let shown = [narrowest - 0.05 * span, narrowest + 1.05 * span];
    let frame = [left, right, h - bottom];
    grid(
        &mut svg,
        lengths,
        shown.map(|g| (g, x(g))),
        [low, high].map(|z| (z, y(z))),
        frame,
    );
    for pair in pairs.windows(2) {
        let [(z0, g0), (z1, g1)] = [pair[0], pair[1]];
        let class = match (g1 - g0).abs() > JUMP_SHARE * g0 {
            true => "curve jump",
            false => "curve",
        };
        let [x0, y0, x1, y1] = [x(g0), y(z0), x(g1), y(z1)];
        let _ = write!(
            svg,
            "<path class=\"{class}\" d=\"M{x0:.1},{y0:.1}L{x1:.1},{y1:.1}\"/>"
        );
    }
    let level = |g: &&Girth| g.plane.normal[2].abs() > 0.999;
    let mut marks = Vec::new();
    for girth in girths.girths.iter().filter(level) {
        let z = girth.plane.point_mm[2] - ground_mm;
        if (low..=high).contains(&z) && (narrowest..=widest * 1.02).contains(&girth.tape_mm) {
            marks.push(([x(girth.tape_mm), y(z)], girth));
        }
    }
    names(&mut svg, marks, right, h - bottom);
    let _ = write!(
        svg,
        "<text x=\"{:.0}\" y=\"{}\" text-anchor=\"middle\">girth of the trunk [{unit}]</text>\
         <text transform=\"translate(11 {:.0}) rotate(-90)\" text-anchor=\"middle\">height [{unit}]</text></svg>",
        (right + left) / 2.0,
        h - 2.0,
        (h - bottom) / 2.0,
        unit = lengths.word(),
    );
    svg
}

/// Ticks of both axes with their lines. An axis is given by its ends, each with its place on the page; the frame by its
/// left, its right and its lower border.
fn grid(
    svg: &mut String,
    lengths: Lengths,
    girths: [(f64, f64); 2],
    heights: [(f64, f64); 2],
    [left, right, bottom]: [f64; 3],
) {
    let (one, _) = lengths.scale();
    let axis = |[(low, from), (high, to)]: [(f64, f64); 2]| {
        let (all, digits) = ticks(low / one, high / one, TICKS);
        let place = move |tick: f64| from + (tick * one - low) / (high - low) * (to - from);
        let one = move |tick: f64| (place(tick), format!("{tick:.digits$}"));
        all.into_iter().map(one).collect::<Vec<_>>()
    };
    for (x, label) in axis(girths) {
        let _ = write!(
            svg,
            "<line class=\"grid\" x1=\"{x:.1}\" x2=\"{x:.1}\" y1=\"8\" y2=\"{bottom}\"/>\
             <text x=\"{x:.1}\" y=\"{}\" text-anchor=\"middle\">{label}</text>",
            bottom + 14.0,
        );
    }
    for (y, label) in axis(heights) {
        let _ = write!(
            svg,
            "<line class=\"grid\" x1=\"{left}\" x2=\"{right}\" y1=\"{y:.1}\" y2=\"{y:.1}\"/>\
             <text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">{label}</text>",
            left - 6.0,
            y + 4.0,
        );
    }
}

/// Names in a column beside the curve. A level line meets the curve at its own height alone, so none
/// crosses it; where names would cover one another they are moved apart.
fn names(svg: &mut String, mut marks: Vec<([f64; 2], &Girth)>, right: f64, bottom: f64) {
    marks.sort_by(|a, b| a.0[1].total_cmp(&b.0[1]));
    let wanted: Vec<f64> = marks.iter().map(|(at, _)| at[1]).collect();
    for (([x, y], girth), to) in marks.iter().zip(spread(&wanted, LINE, [10.0, bottom])) {
        let _ = write!(
            svg,
            "<path class=\"lead\" d=\"M{x:.1},{y:.1}H{right:.1}L{:.1},{to:.1}h5\"/>\
             <circle class=\"mark\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3\"/>\
             <text class=\"mark\" x=\"{:.1}\" y=\"{:.1}\">{}</text>",
            right + 12.0,
            right + 20.0,
            to + 4.0,
            escaped(&girth.label),
        );
    }
}
