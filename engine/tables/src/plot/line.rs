//! One metric over one param: a line joins points that differ in this param only.

use super::field::{Field, Metric, Point, Reported};
use super::plotted::{Plot, Reference, file};
use super::svg::{COLORS, SOFT, Svg, wide};
use system::text::short;

/// Size of a plot, and what is left free right and above. \[px\]
const WIDE: f64 = 340.0;
const HIGH: f64 = 230.0;
const RIGHT: f64 = 12.0;
const TOP: f64 = 10.0;

/// More lines than this have no legend.
const NAMED: usize = 10;

/// Where things are.
struct Frame {
    left: f64,
    bottom: f64,
    aslant: bool,
}

impl Frame {
    /// Names of methods may be longer than their share of the axis: then all are aslant.
    fn of(field: &Field, param: usize, metric: &Metric) -> Frame {
        let marks = field.axes[param].marks();
        let longest = marks.iter().map(|(_, w)| wide(w)).fold(0.0, f64::max);
        let levels = metric.scale.marks();
        let levels = levels.iter().map(|(_, w)| wide(w)).fold(0.0, f64::max);
        let words = marks.iter().any(|(_, w)| w.parse::<f64>().is_err());
        let aslant = words && longest > 240.0 / marks.len().max(1) as f64;
        let left = match aslant {
            true => (levels + 12.0).max(0.8 * longest - 100.0 / marks.len() as f64),
            false => levels + 12.0,
        };
        Frame {
            left,
            bottom: if aslant {
                16.0 + (0.6 * longest).min(90.0)
            } else {
                26.0
            },
            aslant,
        }
    }

    fn x(&self, place: f64) -> f64 {
        self.left + 8.0 + place * (WIDE - self.left - RIGHT - 16.0)
    }

    fn y(&self, place: f64) -> f64 {
        HIGH - self.bottom - place * (HIGH - TOP - self.bottom)
    }
}

/// The plot; none where fewer than two points have the metric at different values of the param.
pub(super) fn line(field: &Field, param: usize, at: usize) -> Option<Plot> {
    let metric = &field.metrics[at];
    let reported = |p: &&Point| p.reported[at].is_some();
    let first = &field.points.iter().find(reported)?.params[param];
    let mut shown = field.points.iter().filter(reported);
    shown.find(|p| p.params[param] != *first)?;
    let title = format!("{} over {}", metric.title(), field.params[param]);
    let mut svg = Svg::new(WIDE, HIGH, &title);
    let frame = Frame::of(field, param, metric);
    axes(&mut svg, field, param, metric, &frame);
    let head = ["line", &field.params[param], &metric.title(), "low", "high"];
    let mut data = vec![head.map(str::to_owned).to_vec()];
    let names = field.names(&[param]);
    for (k, name) in names.iter().enumerate() {
        // Lines that are on each other are moved apart by a pixel or two, so that each is seen.
        let count = names.len() as f64;
        let aside = (k as f64 - (count - 1.0) / 2.0) * (3.0 / count).min(2.0);
        let color = COLORS[k % COLORS.len()];
        data.extend(series(
            &mut svg,
            field,
            (param, at, name),
            (&frame, aside, color),
        ));
    }
    let empty = String::new;
    let reference = |r: &Reference| {
        vec![
            r.label.clone(),
            empty(),
            r.value.to_string(),
            empty(),
            empty(),
        ]
    };
    data.extend(metric.references.iter().map(reference));
    let named = names.len() > 1 && names.len() <= NAMED;
    let legend = names.into_iter().zip(COLORS);
    Some(Plot {
        file: file(&[&metric.name, &field.params[param]]),
        title,
        svg: svg.done(),
        data,
        legend: if named { legend.collect() } else { vec![] },
    })
}

/// One line with its dots and intervals; its rows of the table.
fn series(
    svg: &mut Svg,
    field: &Field,
    (param, at, name): (usize, usize, &str),
    (frame, aside, color): (&Frame, f64, &str),
) -> Vec<Vec<String>> {
    let (scale, metric) = (&field.axes[param], &field.metrics[at]);
    let own = field.points.iter().enumerate();
    let own = own.filter(|(_, p)| field.rest(p, &[param]) == name);
    let place = |p: &Point| scale.place(&p.params[param]).unwrap_or(0.5);
    let mut own: Vec<(f64, usize, &Point, Reported)> = own
        .filter_map(|(row, p)| Some((place(p), row, p, p.reported[at]?)))
        .collect();
    own.sort_by(|a, b| a.0.total_cmp(&b.0));
    let at_of = |(x, _, _, t): &(f64, usize, &Point, Reported)| {
        (frame.x(*x) + aside, frame.y(metric.scale.at(t.value)))
    };
    let points: Vec<(f64, f64)> = own.iter().map(at_of).collect();
    svg.path(&points, color, " stroke-width=\"1.5\" opacity=\".75\"");
    let mut data = Vec::new();
    for ((_, row, point, reported), (x, y)) in own.iter().zip(points) {
        if let Some(ends) = reported.interval {
            let [low, high] = ends.map(|v| frame.y(metric.scale.at(v)));
            svg.line([x, low, x, high], color, " stroke-width=\"1.2\"");
            for end in [low, high] {
                svg.line([x - 3.0, end, x + 3.0, end], color, "");
            }
        }
        svg.dot((x, y), color, *row, &field.title(point, at));
        let end = |k: usize| {
            reported
                .interval
                .map_or(String::new(), |i| i[k].to_string())
        };
        let value = reported.value.to_string();
        data.push(vec![
            name.to_owned(),
            point.params[param].clone(),
            value,
            end(0),
            end(1),
        ]);
    }
    data
}

/// Axes with their words, and what the metric is compared with.
fn axes(svg: &mut Svg, field: &Field, param: usize, metric: &Metric, frame: &Frame) {
    let far = WIDE - RIGHT;
    for (place, word) in metric.scale.marks() {
        let y = frame.y(place);
        svg.line([frame.left, y, far, y], SOFT, " opacity=\".3\"");
        svg.word((frame.left - 4.0, y + 3.0), "end", &word, "");
    }
    let marks = field.axes[param].marks();
    let foot = HIGH - frame.bottom;
    match frame.aslant {
        true => {
            for (place, word) in &marks {
                let (x, y) = (frame.x(*place) + 3.0, foot + 12.0);
                svg.word(
                    (x, y),
                    "end",
                    word,
                    &format!(" transform=\"rotate(-35 {x:.1} {y:.1})\""),
                );
            }
        }
        false => svg.along(
            &marks,
            [frame.x(0.0), frame.x(1.0)],
            [0.0, WIDE],
            foot + 14.0,
        ),
    }
    // The last word at the right, and at the left: where there is no place for one, it is at the other side.
    let mut last = [f64::MIN; 2];
    let mut references: Vec<_> = metric.references.iter().collect();
    references.sort_by(|a, b| b.value.total_cmp(&a.value));
    for reference in references {
        let y = frame.y(metric.scale.at(reference.value));
        svg.line(
            [frame.left, y, far, y],
            "#1f9e6e",
            " stroke-dasharray=\"5 3\"",
        );
        if let Some(side) = last.iter().position(|last| y - last > 10.0) {
            let word = format!("{} {}", reference.label, short(reference.value));
            let (x, anchor) = [(far, "end"), (frame.left + 2.0, "start")][side];
            let more = " fill=\"#1f9e6e\" font-size=\"9\"";
            svg.word((x, y - 2.0), anchor, &word, more);
            last[side] = y;
        }
    }
}
