//! All that varies as parallel axes: a line a point, coloured by the last.

use super::field::Field;
use super::plotted::Plot;
use super::scale::Scale;
use super::svg::{SOFT, Svg, hue, wide};

/// So many axes are kept apart.
const MOST_AXES: usize = 14;

/// Height of the drawing. \[px\]
const HIGH: f64 = 300.0;

/// The drawing; none of fewer than three axes, which a plot of lines shows better.
pub(super) fn parallel(field: &Field) -> Option<Plot> {
    let params = field.params.iter().zip(&field.axes);
    let params = params.map(|(name, scale)| (name.clone(), scale.clone()));
    let metrics = field
        .metrics
        .iter()
        .map(|m| (m.name.clone(), m.scale.clone()));
    let axes: Vec<(String, Scale)> = params.chain(metrics).take(MOST_AXES).collect();
    if axes.len() < 3 || field.metrics.is_empty() {
        return None;
    }
    let two = |name: &str| match name.split_once('.') {
        Some((node, own)) => (node.to_owned(), own.to_owned()),
        None => (String::new(), name.to_owned()),
    };
    let names: Vec<(String, String)> = axes.iter().map(|(name, _)| two(name)).collect();
    let marks: Vec<Vec<(f64, String)>> = axes.iter().map(|(_, scale)| scale.marks()).collect();
    let texts = names
        .iter()
        .flat_map(|(a, b)| [a, b])
        .chain(marks.iter().flatten().map(|m| &m.1));
    let step = texts.map(|t| wide(t)).fold(86.0, f64::max) + 14.0;
    let title = "all that varies, a line a point".to_owned();
    let mut svg = Svg::new(step * axes.len() as f64, HIGH, &title);
    let x = |i: usize| (i as f64 + 0.5) * step;
    let y = |place: f64| HIGH - 24.0 - place * (HIGH - 70.0);
    let count = field.params.len().min(axes.len());
    let mut data = vec![
        axes.iter()
            .map(|(name, _)| name.clone())
            .collect::<Vec<_>>(),
    ];
    for (row, point) in field.points.iter().enumerate() {
        let of = |i: usize| match i < count {
            true => axes[i].1.place(&point.params[i]),
            false => Some(axes[i].1.at(point.reported[i - count]?.value)),
        };
        let text = |i: usize| match i < count {
            true => point.params[i].clone(),
            false => point.reported[i - count].map_or(String::new(), |t| t.value.to_string()),
        };
        let places: Vec<Option<f64>> = (0..axes.len()).map(of).collect();
        let line: Vec<(f64, f64)> = places
            .iter()
            .enumerate()
            .filter_map(|(i, place)| Some((x(i), y((*place)?))))
            .collect();
        let color = hue(places.last().copied().flatten().unwrap_or(0.0));
        if point.reported.iter().all(Option::is_none) {
            continue;
        }
        svg.path(
            &line,
            &color,
            &format!(" data-row=\"{row}\" stroke-width=\"1.6\" opacity=\".8\""),
        );
        data.push((0..axes.len()).map(text).collect());
    }
    for (i, (node, own)) in names.iter().enumerate() {
        svg.line([x(i), 40.0, x(i), HIGH - 18.0], SOFT, " opacity=\".5\"");
        svg.word((x(i), 12.0), "middle", node, "");
        svg.word((x(i), 26.0), "middle", own, "");
        for (place, word) in &marks[i] {
            svg.word((x(i) + 4.0, y(*place) + 3.0), "start", word, "");
        }
    }
    Some(Plot {
        file: "parallel".into(),
        title,
        svg: svg.done(),
        data,
        legend: vec![],
    })
}
