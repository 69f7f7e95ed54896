//! A metric over two params as a map of cells.

use super::field::{Field, Point};
use super::plotted::{Plot, file};
use super::svg::{Svg, ramp, wide};
use system::text::short;

/// Size of a cell. \[px\]
const CELL: [f64; 2] = [46.0, 26.0];

/// What a map is drawn on.
struct Grid {
    /// The params across and up.
    params: [usize; 2],
    /// Their values, ascending.
    xs: Vec<f64>,
    ys: Vec<f64>,
    /// What is left free at the left.
    left: f64,
    /// Least and greatest number.
    ends: [f64; 2],
}

impl Grid {
    /// Of the two params with numbers; none where other than two vary, or there are fewer points than cells: a sample
    /// has hardly two points in a row.
    fn of(field: &Field, maps: &dyn Fn(&[usize]) -> usize, at: usize) -> Option<Grid> {
        let by_number = |p: &usize| {
            let mut all = field.points.iter();
            all.all(|point| point.params[*p].parse::<f64>().is_ok())
        };
        let numbers: Vec<usize> = (0..field.params.len()).filter(by_number).collect();
        let [across, up] = numbers[..] else {
            return None;
        };
        let values = |p: usize| {
            let all = field.points.iter().filter_map(|t| t.params[p].parse().ok());
            let mut all: Vec<f64> = all.collect();
            all.sort_by(f64::total_cmp);
            all.dedup();
            all
        };
        let (xs, ys) = (values(across), values(up));
        if xs.len() * ys.len() * maps(&[across, up]) > field.points.len() {
            return None;
        }
        let reported = field
            .points
            .iter()
            .filter_map(|p| Some(p.reported[at]?.value));
        let widest = ys.iter().map(|y| wide(&short(*y))).fold(0.0, f64::max);
        Some(Grid {
            params: [across, up],
            xs,
            ys,
            left: widest + 8.0,
            ends: reported.fold([f64::MAX, f64::MIN], |[a, b], x| [a.min(x), b.max(x)]),
        })
    }

    /// Size of one map.
    fn size(&self) -> [f64; 2] {
        let across = CELL[0] * self.xs.len() as f64;
        [
            across + self.left + 10.0,
            CELL[1] * self.ys.len() as f64 + 34.0,
        ]
    }

    /// The upper left corner of a point's cell, below the top of its map.
    fn corner(&self, point: &Point) -> [f64; 2] {
        let place = |p: usize, of: &[f64]| {
            let value = point.params[p].parse().ok();
            let at = of.iter().position(|v| Some(*v) == value);
            at.unwrap_or(0)
        };
        let (i, j) = (
            place(self.params[0], &self.xs),
            place(self.params[1], &self.ys),
        );
        let down = self.ys.len() - 1 - j;
        [self.left + CELL[0] * i as f64, CELL[1] * down as f64]
    }

    /// Where a number is between the least and the greatest.
    fn share(&self, value: f64) -> f64 {
        let [least, most] = self.ends;
        if most > least {
            (value - least) / (most - least)
        } else {
            0.5
        }
    }

    /// A map's name and the words along its sides.
    fn words(&self, svg: &mut Svg, top: f64, name: &str) {
        svg.word((self.left, top - 4.0), "start", name, "");
        for (j, y) in self.ys.iter().rev().enumerate() {
            let middle = top + CELL[1] * (j as f64 + 0.6);
            svg.word((self.left - 4.0, middle), "end", &short(*y), "");
        }
        let foot = top + CELL[1] * self.ys.len() as f64 + 12.0;
        for (i, x) in self.xs.iter().enumerate() {
            let middle = self.left + CELL[0] * (i as f64 + 0.5);
            svg.word((middle, foot), "middle", &short(*x), "");
        }
    }
}

/// The map, of each of what else differs one below the other.
pub(super) fn heat(field: &Field, at: usize) -> Option<Plot> {
    let grid = Grid::of(field, &|but| field.names(but).len(), at)?;
    let metric = &field.metrics[at];
    let [across, up] = grid.params.map(|p| field.params[p].as_str());
    let title = format!("{} over {across} and {up}", metric.title());
    let names = field.names(&grid.params);
    let [width, height] = grid.size();
    let mut svg = Svg::new(width.max(wide(&title)), height * names.len() as f64, &title);
    let mut data = vec![
        ["of", across, up, &metric.title()]
            .map(str::to_owned)
            .to_vec(),
    ];
    for (k, name) in names.iter().enumerate() {
        let top = height * k as f64 + 14.0;
        grid.words(&mut svg, top, name);
        let own = field.points.iter().enumerate();
        for (row, point) in own.filter(|(_, p)| field.rest(p, &grid.params) == *name) {
            let Some(reported) = point.reported[at] else {
                continue;
            };
            let [x, y] = grid.corner(point);
            let cell = [x, top + y, CELL[0] - 1.0, CELL[1] - 1.0];
            let color = ramp(grid.share(reported.value));
            svg.cell(cell, &color, row, &field.title(point, at));
            let middle = (x + CELL[0] / 2.0, top + y + CELL[1] / 2.0 + 3.0);
            let more = " fill=\"#111\" pointer-events=\"none\"";
            svg.word(middle, "middle", &short(reported.value), more);
            let [across, up] = grid.params.map(|p| point.params[p].clone());
            data.push(vec![name.clone(), across, up, reported.value.to_string()]);
        }
    }
    Some(Plot {
        file: format!("map-{}", file(&[&metric.name, across, up])),
        title,
        svg: svg.done(),
        data,
        legend: vec![],
    })
}
