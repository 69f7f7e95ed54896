//! Where the boxes of a drawn pipeline stand: rows by what is read, few crossings, lines led between boxes.
//!
//! Layers with places for long lines, ordered by means of neighbours, then moved above one another (Sugiyama,
//! Tagawa and Toda 1981). Own code: the crates at hand either tell no way of a line (rust-sugiyama) or draw
//! boxes of their own alone (layout-rs), and the first walks hash maps, so equal graphs would give other bytes.

/// What is placed: a box of the drawing, or where a line goes through a row.
struct Item {
    row: usize,
    width: f64,
    /// Items of the row above and of the row below that a line joins it to.
    up: Vec<usize>,
    down: Vec<usize>,
}

/// A line: from and to which box, and the middles of the places in between, row by row. \[px\]
pub(crate) struct Line {
    pub(crate) from: usize,
    pub(crate) to: usize,
    pub(crate) through: Vec<f64>,
}

/// Where everything is.
pub(crate) struct Placed {
    /// The middle of each box, from the drawing's left. \[px\]
    pub(crate) middles: Vec<f64>,
    pub(crate) lines: Vec<Line>,
    /// \[px\]
    pub(crate) width: f64,
}

/// Between two neighbours of a row, and what a line takes of it. \[px\]
const GAP: f64 = 22.0;
const LANE: f64 = 4.0;
/// Times that all rows are gone through.
const SWEEPS: usize = 12;

/// Places boxes of one width whose rows are known; a line is (from, to), and goes down.
pub(crate) fn placed(rows: &[usize], lines: &[(usize, usize)], width: f64) -> Placed {
    let item = |row: &usize| Item {
        row: *row,
        width,
        up: vec![],
        down: vec![],
    };
    let mut items: Vec<Item> = rows.iter().map(item).collect();
    let mut ways = Vec::new();
    for &(from, to) in lines {
        let mut way = vec![from];
        for row in rows[from] + 1..rows[to] {
            way.push(items.len());
            items.push(Item {
                width: LANE,
                ..item(&row)
            });
        }
        way.push(to);
        for pair in way.windows(2) {
            items[pair[0]].down.push(pair[1]);
            items[pair[1]].up.push(pair[0]);
        }
        ways.push(way);
    }
    let layers = ordered(&items);
    let x = aligned(&items, &layers);
    let low = |i: usize| x[i] - items[i].width / 2.0;
    let left = (0..x.len()).map(low).fold(f64::MAX, f64::min);
    let right = (0..x.len()).map(|i| low(i) + items[i].width);
    let line = |way: &Vec<usize>| Line {
        from: way[0],
        to: way[way.len() - 1],
        through: way[1..way.len() - 1].iter().map(|i| x[*i] - left).collect(),
    };
    Placed {
        middles: x[..rows.len()].iter().map(|x| x - left).collect(),
        lines: ways.iter().map(line).collect(),
        width: (right.fold(0.0, f64::max) - left).max(0.0),
    }
}

/// The items of each row from left to right, in the order of all tried that crosses least.
fn ordered(items: &[Item]) -> Vec<Vec<usize>> {
    let rows = items.iter().map(|i| i.row + 1).max().unwrap_or(0);
    let of = |row: usize| (0..items.len()).filter(|i| items[*i].row == row).collect();
    let mut layers: Vec<Vec<usize>> = (0..rows).map(of).collect();
    let mut best = (crossings(items, &layers), layers.clone());
    for sweep in 0..SWEEPS {
        let down = sweep % 2 == 0;
        let mut at = places(items.len(), &layers);
        for k in 0..rows {
            let row = if down { k } else { rows - 1 - k };
            let mean = |i: usize| {
                let beside = if down { &items[i].up } else { &items[i].down };
                match beside.len() {
                    0 => at[i] as f64,
                    n => beside.iter().map(|j| at[*j]).sum::<usize>() as f64 / n as f64,
                }
            };
            let mut keyed: Vec<(f64, usize)> = layers[row].iter().map(|i| (mean(*i), *i)).collect();
            keyed.sort_by(|a, b| a.0.total_cmp(&b.0));
            layers[row] = keyed.into_iter().map(|k| k.1).collect();
            layers[row].iter().enumerate().for_each(|(k, i)| at[*i] = k);
        }
        let count = crossings(items, &layers);
        if count < best.0 {
            best = (count, layers.clone());
        }
    }
    best.1
}

/// The place of each item in its row.
fn places(count: usize, layers: &[Vec<usize>]) -> Vec<usize> {
    let mut at = vec![0; count];
    for layer in layers {
        layer.iter().enumerate().for_each(|(k, i)| at[*i] = k);
    }
    at
}

/// How often lines cross.
fn crossings(items: &[Item], layers: &[Vec<usize>]) -> usize {
    let at = places(items.len(), layers);
    let mut count = 0;
    for layer in layers {
        let ends = |i: &usize| items[*i].down.iter().map(|j| at[*j]).collect::<Vec<_>>();
        let ends: Vec<Vec<usize>> = layer.iter().map(ends).collect();
        for (k, left) in ends.iter().enumerate() {
            for right in ends[k + 1..].iter().flatten() {
                count += left.iter().filter(|end| *end > right).count();
            }
        }
    }
    count
}

/// The middle of each item: as near to those it is joined to as the order of its row lets it.
fn aligned(items: &[Item], layers: &[Vec<usize>]) -> Vec<f64> {
    let mut x = vec![0.0; items.len()];
    for layer in layers {
        let middles = ascending(&vec![0.0; layer.len()], &steps(items, layer));
        layer.iter().zip(middles).for_each(|(i, m)| x[*i] = m);
    }
    for sweep in 0..4 * SWEEPS {
        for k in 0..layers.len() {
            let down = sweep % 2 == 0;
            let layer = &layers[if down { k } else { layers.len() - 1 - k }];
            let wanted = |i: &usize| {
                let beside = if down { &items[*i].up } else { &items[*i].down };
                match beside.len() {
                    0 => x[*i],
                    n => beside.iter().map(|j| x[*j]).sum::<f64>() / n as f64,
                }
            };
            let wanted: Vec<f64> = layer.iter().map(wanted).collect();
            let middles = ascending(&wanted, &steps(items, layer));
            layer.iter().zip(middles).for_each(|(i, m)| x[*i] = m);
        }
    }
    x
}

/// How far the middle of each item of a row is at least from that of the first. \[px\]
fn steps(items: &[Item], layer: &[usize]) -> Vec<f64> {
    let mut far = 0.0;
    let step = |k: usize| {
        if k > 0 {
            far += (items[layer[k - 1]].width + items[layer[k]].width) / 2.0 + GAP;
        }
        far
    };
    (0..layer.len()).map(step).collect()
}

/// Places near to wanted ones that keep their order and steps: what comes too near shares a mean.
fn ascending(wanted: &[f64], steps: &[f64]) -> Vec<f64> {
    let mut pools: Vec<(f64, usize)> = Vec::new();
    for (at, step) in wanted.iter().zip(steps) {
        let mut pool = (at - step, 1);
        while let Some(before) = pools.last().filter(|b| b.0 > pool.0) {
            let count = before.1 + pool.1;
            let sum = before.0 * before.1 as f64 + pool.0 * pool.1 as f64;
            pool = (sum / count as f64, count);
            pools.pop();
        }
        pools.push(pool);
    }
    let firsts = pools
        .iter()
        .flat_map(|(at, n)| std::iter::repeat_n(*at, *n));
    firsts.zip(steps).map(|(at, step)| at + step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_of_a_row_stand_apart_and_a_chain_stands_in_one_line() {
        let chain = placed(&[0, 1, 2], &[(0, 1), (1, 2)], 100.0);
        assert_eq!(chain.middles, [50.0; 3]);
        let fan = placed(&[0, 1, 1, 1], &[(0, 1), (0, 2), (0, 3)], 100.0);
        let mut row = fan.middles[1..].to_vec();
        row.sort_by(f64::total_cmp);
        assert!(row.windows(2).all(|p| p[1] - p[0] >= 122.0), "{row:?}");
        assert_eq!(fan.width, 344.0);
    }

    #[test]
    fn lines_that_need_not_cross_do_not_and_long_ones_go_between_boxes() {
        // Two chains whose second boxes come in the wrong order, and a line past one of them.
        let rows = [0, 0, 1, 1, 2];
        let lines = [(0, 3), (1, 2), (2, 4), (0, 4)];
        let all = placed(&rows, &lines, 100.0);
        let x = &all.middles;
        assert_eq!(x[0] < x[1], x[3] < x[2], "{x:?}");
        let lane = all.lines[3].through[0];
        for middle in [x[2], x[3]] {
            assert!((lane - middle).abs() > 50.0, "{lane} through {middle}");
        }
    }
}
