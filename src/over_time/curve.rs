//! A girth over days as SVG: points, the band of what repetition gives, what exceeds it filled.

use super::change::{Followed, Line};
use super::day::day_number;
use std::fmt::Write;

/// Size of the plot, and what is left for labels: left, right, top, bottom. \[px\]
const WIDE: f64 = 520.0;
const HIGH: f64 = 220.0;
const MARGIN: [f64; 4] = [64.0, 24.0, 30.0, 40.0];

/// Where captures stand along the axis: days since the first, or their number where a day is unknown.
fn places(told: &Followed) -> (Vec<f64>, bool) {
    let days: Option<Vec<i64>> = told
        .days
        .iter()
        .map(|d| day_number(d.day.as_deref()?))
        .collect();
    match days {
        Some(days) if days.first() != days.last() => {
            (days.iter().map(|d| (d - days[0]) as f64).collect(), true)
        }
        _ => ((0..told.days.len()).map(|i| i as f64).collect(), false),
    }
}

/// The curve of a girth. Bars hold the true change nine times in ten; the grey band is what repetition gives about the first
/// capture; a point that exceeds it is filled.
pub(super) fn curve_svg(told: &Followed, line: &Line) -> String {
    let (at, by_days) = places(told);
    let first = line.at[0].tape_mm.ok().unwrap_or(0.0);
    let least = line
        .at
        .iter()
        .filter_map(|c| c.least_change_mm)
        .reduce(f64::max)
        .unwrap_or(0.0);
    let ends = line
        .at
        .iter()
        .filter_map(|c| c.interval_mm.map(|e| e.map(|x| first + x)));
    let all = ends
        .flatten()
        .chain(line.at.iter().filter_map(|c| c.tape_mm.ok()))
        .chain([first - least, first + least]);
    let (low, high) = all.fold((f64::MAX, f64::MIN), |(a, b), x| (a.min(x), b.max(x)));
    let room = (0.1 * (high - low)).max(1.0);
    let (low, high) = (low - room, high + room);
    let [left, right, top, bottom] = MARGIN;
    let last = at.iter().copied().fold(1e-9, f64::max);
    let x = |v: f64| left + 12.0 + v / last * (WIDE - left - right - 24.0);
    let y = |mm: f64| HIGH - bottom - (mm - low) / (high - low) * (HIGH - top - bottom);
    let title = crate::page::escaped(&format!("{} ({}) [cm]", line.name, line.label));
    let (far, foot) = (WIDE - right, HIGH - bottom);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDE} {HIGH}\" width=\"{WIDE}\" height=\"{HIGH}\" role=\"img\" aria-label=\"{title}\" font-family=\"sans-serif\" font-size=\"12\" fill=\"#777\">\n\
         <text x=\"{left}\" y=\"18\" font-size=\"14\">{title}</text>\n\
         <rect x=\"{left}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"#777\" fill-opacity=\"0.18\"/>\n\
         <path d=\"M{left} {top}V{foot}H{far}\" fill=\"none\" stroke=\"#777\"/>\n",
        y(first + least),
        far - left,
        y(first - least) - y(first + least)
    );
    for mm in [low + room, first, high - room] {
        let _ = writeln!(
            svg,
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{:.1}</text>",
            left - 6.0,
            y(mm) + 4.0,
            mm / 10.0
        );
    }
    let mut before: Option<(f64, f64)> = None;
    for (i, c) in line.at.iter().enumerate() {
        let Ok(tape) = c.tape_mm else {
            before = None;
            continue;
        };
        let (px, py) = (x(at[i]), y(tape));
        if let Some((ox, oy)) = before {
            let _ = writeln!(
                svg,
                "<line x1=\"{ox:.1}\" y1=\"{oy:.1}\" x2=\"{px:.1}\" y2=\"{py:.1}\" stroke=\"#1a59d9\"/>"
            );
        }
        if let Some([a, b]) = c.interval_mm {
            let _ = writeln!(
                svg,
                "<line x1=\"{px:.1}\" x2=\"{px:.1}\" y1=\"{:.1}\" y2=\"{:.1}\" stroke=\"#1a59d9\" stroke-width=\"2\"/>",
                y(first + a),
                y(first + b)
            );
        }
        let fill = if c.changed == Some(true) {
            "#1a59d9"
        } else {
            "#fff"
        };
        let _ = writeln!(
            svg,
            "<circle cx=\"{px:.1}\" cy=\"{py:.1}\" r=\"4.5\" fill=\"{fill}\" stroke=\"#1a59d9\" stroke-width=\"2\"/>"
        );
        before = Some((px, py));
    }
    let heads = super::words::heads(told);
    let shown = if heads.len() > 5 {
        vec![0, heads.len() - 1]
    } else {
        (0..heads.len()).collect()
    };
    for i in shown {
        let anchor = if i == 0 {
            "start"
        } else if i + 1 == heads.len() {
            "end"
        } else {
            "middle"
        };
        let edge = if i == 0 {
            left
        } else if i + 1 == heads.len() {
            far
        } else {
            x(at[i])
        };
        let _ = writeln!(
            svg,
            "<text x=\"{edge:.1}\" y=\"{:.1}\" text-anchor=\"{anchor}\">{}</text>",
            foot + 16.0,
            crate::page::escaped(&heads[i])
        );
    }
    if !by_days {
        let _ = writeln!(
            svg,
            "<text x=\"{far:.1}\" y=\"{:.1}\" text-anchor=\"end\">not to scale: days are unknown or the same</text>",
            HIGH - 6.0
        );
    }
    svg + "</svg>\n"
}
