//! A Bland–Altman plot as SVG.

use super::study::GirthStudy;
use std::fmt::Write;

/// Size of the plot. \[px\]
const WIDE: f64 = 520.0;
const HIGH: f64 = 300.0;
/// What is left for labels: left, right, top, bottom. \[px\]
const MARGIN: [f64; 4] = [58.0, 96.0, 30.0, 44.0];

/// A step of an axis: 1, 2 or 5 times a power of ten, about `span / 5`.
fn step(span: f64) -> f64 {
    let power = libm::pow(10f64, libm::log10(span / 5.0).floor());
    let times = [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .find(|t| t * power >= span / 5.0);
    times.unwrap_or(10.0) * power
}

/// Marks of an axis.
fn marks(low: f64, high: f64) -> (Vec<f64>, usize) {
    let step = step(high - low);
    let first = (low / step).ceil() as i64;
    let last = (high / step).floor() as i64;
    let digits = (-libm::log10(step).floor()).max(0.0) as usize;
    ((first..=last).map(|i| i as f64 * step).collect(), digits)
}

/// An axis: its ends, and the place of a value of it on the plot.
type Axis<'a> = (f64, f64, &'a dyn Fn(f64) -> f64);

/// Both axes with their marks and words.
fn axes((x0, x1, x): Axis<'_>, (y0, y1, y): Axis<'_>) -> String {
    let [left, right, top, bottom] = MARGIN;
    let (far, foot) = (WIDE - right, HIGH - bottom);
    let mut svg = String::new();
    let (ticks, digits) = marks(x0, x1);
    for v in ticks {
        let at = x(v);
        let _ = writeln!(
            svg,
            "<line x1=\"{at:.1}\" x2=\"{at:.1}\" y1=\"{foot}\" y2=\"{:.1}\" stroke=\"#777\"/><text x=\"{at:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{v:.digits$}</text>",
            foot + 4.0,
            foot + 17.0
        );
    }
    let (ticks, digits) = marks(y0, y1);
    for v in ticks {
        let at = y(v);
        let _ = writeln!(
            svg,
            "<line x1=\"{:.1}\" x2=\"{left}\" y1=\"{at:.1}\" y2=\"{at:.1}\" stroke=\"#777\"/><text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{v:.digits$}</text>",
            left - 4.0,
            left - 7.0,
            at + 4.0
        );
    }
    let _ = writeln!(
        svg,
        "<path d=\"M{left} {top}V{foot}H{far}\" fill=\"none\" stroke=\"#777\"/>"
    );
    let _ = writeln!(
        svg,
        "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">mean of both [mm]</text>",
        (left + far) / 2.0,
        HIGH - 8.0
    );
    let middle = (top + foot) / 2.0;
    let _ = writeln!(
        svg,
        "<text x=\"14\" y=\"{middle:.1}\" text-anchor=\"middle\" transform=\"rotate(-90 14 {middle:.1})\">later − first [mm]</text>"
    );
    svg
}

/// The difference of each later measurement from the person's first over the mean of both, with bias and limits of
/// agreement (Bland and Altman 1986). It has its own colours, for light and dark pages.
pub fn bland_altman_svg(girth: &GirthStudy) -> String {
    let agreement = &girth.agreement;
    let over = |f: fn(f64, f64) -> f64, at: usize, start: f64| {
        agreement.pairs.iter().map(|p| p[at]).fold(start, f)
    };
    let (x0, x1) = (over(f64::min, 0, f64::MAX), over(f64::max, 0, f64::MIN));
    let margin = (0.08 * (x1 - x0)).max(1.0);
    let (x0, x1) = (x0 - margin, x1 + margin);
    let limits = agreement.limits.unwrap_or([agreement.bias; 2]);
    let low = over(f64::min, 1, limits[0].min(0.0));
    let high = over(f64::max, 1, limits[1].max(0.0));
    let margin = (0.1 * (high - low)).max(0.1);
    let (y0, y1) = (low - margin, high + margin);
    let [left, right, top, bottom] = MARGIN;
    let x = |v: f64| left + (v - x0) / (x1 - x0) * (WIDE - left - right);
    let y = |v: f64| HIGH - bottom - (v - y0) / (y1 - y0) * (HIGH - top - bottom);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDE} {HIGH}\" width=\"{WIDE}\" height=\"{HIGH}\" role=\"img\" \
         aria-label=\"Bland–Altman plot of {0}\" font-family=\"sans-serif\" font-size=\"12\" fill=\"#777\">\n\
         <text x=\"{left}\" y=\"18\" font-size=\"14\">{0}</text>\n",
        tables::html::escaped(&format!("{} ({})", girth.name, girth.label))
    );
    let far = WIDE - right;
    svg += &axes((x0, x1, &x), (y0, y1, &y));
    let mut line = |v: f64, dash: &str, word: &str| {
        let at = y(v);
        let _ = writeln!(
            svg,
            "<line x1=\"{left}\" x2=\"{far}\" y1=\"{at:.1}\" y2=\"{at:.1}\" stroke=\"#c2570c\" stroke-dasharray=\"{dash}\"/>"
        );
        if !word.is_empty() {
            let _ = writeln!(
                svg,
                "<text x=\"{:.1}\" y=\"{:.1}\" fill=\"#c2570c\">{word} {v:+.1}</text>",
                far + 5.0,
                at + 4.0
            );
        }
    };
    line(agreement.bias, "", "bias");
    if let Some(limits) = agreement.limits {
        limits
            .into_iter()
            .for_each(|limit| line(limit, "6 4", "95 %"));
    }
    for [mean, off] in &agreement.pairs {
        let _ = writeln!(
            svg,
            "<circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"4\" fill=\"#1a59d9\"/>",
            x(*mean),
            y(*off)
        );
    }
    svg + "</svg>\n"
}
