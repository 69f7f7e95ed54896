//! Pieces of a drawing: with colours of their own, so that a file shows what the page does, on light and on dark.

use crate::html::escaped;
use std::fmt::Write;

/// Colours of lines, one after the other.
pub(super) const COLORS: [&str; 10] = [
    "#2a6fdb", "#d4500c", "#1f9e6e", "#a04ac0", "#c79a00", "#0e98b0", "#c2386c", "#6b7a1e",
    "#8a5a3c", "#5a5ad0",
];

/// What is neither line nor point.
pub(super) const SOFT: &str = "#7c7c82";

/// A drawing in the making.
pub(super) struct Svg(String);

impl Svg {
    /// Of a size, called by what it shows. \[px\]
    pub(super) fn new(width: f64, height: f64, about: &str) -> Svg {
        Svg(format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" width=\"{width:.0}\" height=\"{height:.0}\" role=\"img\" aria-label=\"{}\" font-family=\"sans-serif\" font-size=\"10\" fill=\"{SOFT}\">\n",
            escaped(about)
        ))
    }

    /// A straight line; `more` are further attributes.
    pub(super) fn line(&mut self, [x1, y1, x2, y2]: [f64; 4], color: &str, more: &str) {
        let _ = writeln!(
            self.0,
            "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" stroke=\"{color}\"{more}/>"
        );
    }

    /// A line from point to point.
    pub(super) fn path(&mut self, points: &[(f64, f64)], color: &str, more: &str) {
        let points: Vec<String> = points
            .iter()
            .map(|(x, y)| format!("{x:.1},{y:.1}"))
            .collect();
        let _ = writeln!(
            self.0,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{color}\"{more}/>",
            points.join(" ")
        );
    }

    /// A dot with its title, and a link to its row.
    pub(super) fn dot(&mut self, (x, y): (f64, f64), color: &str, row: usize, title: &str) {
        let _ = writeln!(
            self.0,
            "<a href=\"#points-{row}\"><circle data-row=\"{row}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.2\" fill=\"{color}\"><title>{}</title></circle></a>",
            escaped(title)
        );
    }

    /// A filled cell with its title, and a link to its row.
    pub(super) fn cell(&mut self, [x, y, w, h]: [f64; 4], color: &str, row: usize, title: &str) {
        let _ = writeln!(
            self.0,
            "<a href=\"#points-{row}\"><rect data-row=\"{row}\" x=\"{x:.1}\" y=\"{y:.1}\" width=\"{w:.1}\" height=\"{h:.1}\" fill=\"{color}\"><title>{}</title></rect></a>",
            escaped(title)
        );
    }

    /// A word; `anchor` is `start`, `middle` or `end`.
    pub(super) fn word(&mut self, (x, y): (f64, f64), anchor: &str, text: &str, more: &str) {
        let _ = writeln!(
            self.0,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\"{more}>{}</text>",
            escaped(text)
        );
    }

    /// Words along a bottom axis from `low` to `high`, at places from `left` to `right`: those that would be on each
    /// other are left out.
    pub(super) fn along(
        &mut self,
        marks: &[(f64, String)],
        [left, right]: [f64; 2],
        [low, high]: [f64; 2],
        y: f64,
    ) {
        let mut end = f64::MIN;
        for (place, word) in marks {
            let half = wide(word) / 2.0;
            let x =
                (left + place * (right - left)).clamp(low + half, (high - half).max(low + half));
            if x - half < end + 4.0 {
                continue;
            }
            end = x + half;
            self.word((x, y), "middle", word, "");
        }
    }

    /// The drawing.
    pub(super) fn done(self) -> String {
        self.0 + "</svg>\n"
    }
}

/// About how wide letters of 10 px are. \[px\]
pub(super) fn wide(text: &str) -> f64 {
    5.8 * text.chars().count() as f64
}

/// A cell's colour from blue over white to orange, for 0 to 1.
pub(super) fn ramp(share: f64) -> String {
    mixed(share, [244.0, 244.0, 240.0])
}

/// A line's colour from blue over violet to orange, for 0 to 1.
pub(super) fn hue(share: f64) -> String {
    mixed(share, [150.0, 84.0, 168.0])
}

fn mixed(share: f64, middle: [f64; 3]) -> String {
    let ends = [[42.0, 111.0, 219.0], middle, [212.0, 80.0, 12.0]];
    let share = share.clamp(0.0, 1.0) * 2.0;
    let (from, at) = if share < 1.0 {
        (0, share)
    } else {
        (1, share - 1.0)
    };
    let mix = |k: usize| (ends[from][k] * (1.0 - at) + ends[from + 1][k] * at).round();
    format!(
        "#{:02x}{:02x}{:02x}",
        mix(0) as u8,
        mix(1) as u8,
        mix(2) as u8
    )
}
