//! A girth over days as SVG: points, the band of what repetition gives, what exceeds it filled.

use super::change::{Followed, Line};
use stage::day_number;
use std::fmt::Write;

/// Size of the plot, and what is left for labels: left, right, top, bottom. \[px\]
const WIDE: f64 = 520.0;
const HIGH: f64 = 220.0;
const MARGIN: [f64; 4] = [64.0, 24.0, 30.0, 40.0];

/// Places of captures along the axis: days since the first, or their number where a day is unknown.
fn places(followed: &Followed) -> (Vec<f64>, bool) {
    let days: Option<Vec<i64>> = followed
        .days
        .iter()
        .map(|d| day_number(d.day.as_deref()?))
        .collect();
    match days {
        Some(days) if days.first() != days.last() => {
            (days.iter().map(|d| (d - days[0]) as f64).collect(), true)
        }
        _ => ((0..followed.days.len()).map(|i| i as f64).collect(), false),
    }
}

/// Places of captures and lengths on the plot.
struct Axes {
    /// The capture's places, 0 to `last`.
    at: Vec<f64>,
    last: f64,
    /// The lengths at the plot's foot and top. \[mm\]
    low: f64,
    high: f64,
}

impl Axes {
    fn x(&self, i: usize) -> f64 {
        let [left, right, ..] = MARGIN;
        left + 12.0 + self.at[i] / self.last * (WIDE - left - right - 24.0)
    }

    fn y(&self, mm: f64) -> f64 {
        let [.., top, bottom] = MARGIN;
        HIGH - bottom - (mm - self.low) / (self.high - self.low) * (HIGH - top - bottom)
    }
}

/// The curve of a girth. Bars hold the true change nine times in ten; the grey band is what repetition gives about the first
/// capture; a point that exceeds it is filled.
pub(super) fn curve_svg(followed: &Followed, line: &Line) -> String {
    let (at, by_days) = places(followed);
    let first = line.at[0].tape_mm.ok().unwrap_or(0.0);
    let least = line.at.iter().filter_map(|c| c.least_change_mm);
    let least = least.reduce(f64::max).unwrap_or(0.0);
    let ends = line.at.iter().filter_map(|c| c.interval_mm);
    let tapes = line.at.iter().filter_map(|c| c.tape_mm.ok());
    let all = ends.flatten().map(|x| first + x).chain(tapes);
    let all = all.chain([first - least, first + least]);
    let (low, high) = all.fold((f64::MAX, f64::MIN), |(a, b), x| (a.min(x), b.max(x)));
    let margin = (0.1 * (high - low)).max(1.0);
    let axes = Axes {
        last: at.iter().copied().fold(1e-9, f64::max),
        at,
        low: low - margin,
        high: high + margin,
    };
    let [left, right, top, bottom] = MARGIN;
    let title = tables::html::escaped(&format!("{} ({}) [cm]", line.name, line.label));
    let (far, foot) = (WIDE - right, HIGH - bottom);
    let (band_top, band_foot) = (axes.y(first + least), axes.y(first - least));
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDE} {HIGH}\" width=\"{WIDE}\" height=\"{HIGH}\" role=\"img\" aria-label=\"{title}\" font-family=\"sans-serif\" font-size=\"12\" fill=\"#777\">\n\
         <text x=\"{left}\" y=\"18\" font-size=\"14\">{title}</text>\n\
         <rect x=\"{left}\" y=\"{band_top:.1}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"#777\" fill-opacity=\"0.18\"/>\n\
         <path d=\"M{left} {top}V{foot}H{far}\" fill=\"none\" stroke=\"#777\"/>\n",
        far - left,
        band_foot - band_top
    );
    for mm in [low, first, high] {
        let (x, y) = (left - 6.0, axes.y(mm) + 4.0);
        let _ = writeln!(
            svg,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"end\">{:.1}</text>",
            mm / 10.0
        );
    }
    svg += &points(&axes, line, first);
    svg += &days(&axes, followed);
    if !by_days {
        let y = HIGH - 6.0;
        let _ = writeln!(
            svg,
            "<text x=\"{far:.1}\" y=\"{y:.1}\" text-anchor=\"end\">not to scale: days are unknown or the same</text>"
        );
    }
    svg + "</svg>\n"
}

/// Points with their bars, joined where none between is missing.
fn points(axes: &Axes, line: &Line, first: f64) -> String {
    const BLUE: &str = "#1a59d9";
    let mut svg = String::new();
    let mut before: Option<(f64, f64)> = None;
    for (i, c) in line.at.iter().enumerate() {
        let Ok(tape) = c.tape_mm else {
            before = None;
            continue;
        };
        let (x, y) = (axes.x(i), axes.y(tape));
        if let Some((ox, oy)) = before {
            let _ = writeln!(
                svg,
                "<line x1=\"{ox:.1}\" y1=\"{oy:.1}\" x2=\"{x:.1}\" y2=\"{y:.1}\" stroke=\"{BLUE}\"/>"
            );
        }
        if let Some(ends) = c.interval_mm {
            let [a, b] = ends.map(|mm| axes.y(first + mm));
            let _ = writeln!(
                svg,
                "<line x1=\"{x:.1}\" x2=\"{x:.1}\" y1=\"{a:.1}\" y2=\"{b:.1}\" stroke=\"{BLUE}\" stroke-width=\"2\"/>"
            );
        }
        let fill = if c.changed == Some(true) {
            BLUE
        } else {
            "#fff"
        };
        let _ = writeln!(
            svg,
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4.5\" fill=\"{fill}\" stroke=\"{BLUE}\" stroke-width=\"2\"/>"
        );
        before = Some((x, y));
    }
    svg
}

/// Days, or names, under the points; of many the first and the last.
fn days(axes: &Axes, followed: &Followed) -> String {
    let heads = super::words::heads(followed);
    let last = heads.len() - 1;
    let y = HIGH - MARGIN[3] + 16.0;
    let mut svg = String::new();
    for (i, head) in heads.iter().enumerate() {
        let (x, anchor) = match i {
            0 => (MARGIN[0], "start"),
            i if i == last => (WIDE - MARGIN[1], "end"),
            _ if last > 4 => continue,
            i => (axes.x(i), "middle"),
        };
        let head = tables::html::escaped(head);
        let _ = writeln!(
            svg,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{head}</text>"
        );
    }
    svg
}
