//! The least cut of random grids against augmenting paths found one by one.

use proof::Dice;
use silhouette::{Grid, STEPS};

/// A dense network: the plainest maximum flow there is (Edmonds and Karp 1972).
fn plain(nodes: usize, capacity: &mut [Vec<i64>]) -> i64 {
    let (source, sink) = (nodes, nodes + 1);
    let mut total = 0;
    loop {
        let mut parent = vec![usize::MAX; nodes + 2];
        parent[source] = source;
        let mut open = std::collections::VecDeque::from([source]);
        while let Some(at) = open.pop_front() {
            for to in 0..nodes + 2 {
                if parent[to] == usize::MAX && capacity[at][to] > 0 {
                    parent[to] = at;
                    open.push_back(to);
                }
            }
        }
        if parent[sink] == usize::MAX {
            return total;
        }
        let mut least = i64::MAX;
        let mut at = sink;
        while at != source {
            least = least.min(capacity[parent[at]][at]);
            at = parent[at];
        }
        at = sink;
        while at != source {
            capacity[parent[at]][at] -= least;
            capacity[at][parent[at]] += least;
            at = parent[at];
        }
        total += least;
    }
}

#[test]
fn the_flow_is_the_greatest_and_the_cut_costs_as_much() {
    for seed in 0..300 {
        let mut dice = Dice(seed);
        let (w, h) = (
            2 + (dice.bits() % 5) as usize,
            2 + (dice.bits() % 5) as usize,
        );
        let mut grid = Grid::new(w, h);
        let mut dense = vec![vec![0i64; w * h + 2]; w * h + 2];
        let (mut terminals, mut arcs) = (vec![], vec![]);
        for i in 0..w * h {
            let (x, y) = (i % w, i / w);
            let (keep, lose) = ((dice.bits() % 20) as i32, (dice.bits() % 20) as i32);
            grid.add_terminal(x, y, keep, lose);
            dense[w * h][i] = i64::from(keep);
            dense[i][w * h + 1] = i64::from(lose);
            terminals.push((x, y, keep, lose));
            for d in 4..8 {
                let (nx, ny) = (x as i32 + STEPS[d].0, y as i32 + STEPS[d].1);
                if nx < 0 || ny < 0 || nx >= w as i32 || ny >= h as i32 {
                    continue;
                }
                let capacity = (dice.bits() % 12) as i32;
                grid.set_arc(x, y, d, capacity);
                let j = ny as usize * w + nx as usize;
                (dense[i][j], dense[j][i]) = (i64::from(capacity), i64::from(capacity));
                arcs.push((x, y, nx as usize, ny as usize, capacity));
            }
        }
        let flow = grid.cut();
        assert_eq!(flow, plain(w * h, &mut dense), "seed {seed}");
        let side = |x, y| grid.on_source_side(x, y);
        let mut cost = 0i64;
        for (x, y, keep, lose) in terminals {
            cost += i64::from(if side(x, y) { lose } else { keep });
        }
        for (x, y, nx, ny, capacity) in arcs {
            cost += if side(x, y) != side(nx, ny) {
                i64::from(capacity)
            } else {
                0
            };
        }
        assert_eq!(flow, cost, "seed {seed}");
    }
}

#[test]
fn the_cut_of_a_block_is_the_least_of_all() {
    let count = [3usize, 2, 2];
    let [nx, ny, _] = count;
    let cells = count.iter().product::<usize>();
    let mut dice = proof::Dice(41);
    for _ in 0..40 {
        let mut thrown = || dice.within(0.0, 30.0) as i32;
        let ends: Vec<[i32; 2]> = (0..cells).map(|_| [thrown(), thrown()]).collect();
        let at = |i: usize| [i % nx, i / nx % ny, i / nx / ny];
        let mut arcs = vec![];
        for i in 0..cells {
            for (axis, stride) in [(0, 1), (1, nx), (2, nx * ny)] {
                if at(i)[axis] + 1 < count[axis] {
                    arcs.push((i, axis, i + stride, thrown()));
                }
            }
        }
        let mut grid = Grid::block(count);
        for (i, [keep, lose]) in ends.iter().enumerate() {
            grid.add_cell_terminal(i, *keep, *lose);
        }
        for (i, axis, _, price) in &arcs {
            grid.set_cell_arc(*i, *axis, *price);
        }
        let flow = grid.cut();
        let cost = |body: &dyn Fn(usize) -> bool| -> i64 {
            let of = |i: usize| i64::from(ends[i][usize::from(body(i))]);
            let parted = arcs.iter().filter(|(i, _, j, _)| body(*i) != body(*j));
            (0..cells).map(of).sum::<i64>() + parted.map(|a| i64::from(a.3)).sum::<i64>()
        };
        let least = (0..1u32 << cells)
            .map(|b| cost(&|i| b >> i & 1 == 1))
            .min()
            .unwrap();
        assert_eq!(flow, least);
        assert_eq!(cost(&|i| grid.cell_on_source_side(i)), least);
    }
}

#[test]
fn a_grid_is_cut_again_as_one_that_was_made_anew() {
    for seed in 0..100 {
        let mut dice = Dice(seed);
        let (w, h) = (7, 6);
        let mut below = |most: u64| (dice.bits() % most) as i32;
        let (mut again, mut anew) = (Grid::new(w, h), Grid::new(w, h));
        for i in 0..w * h {
            for d in 4..8 {
                let (nx, ny) = ((i % w) as i32 + STEPS[d].0, (i / w) as i32 + STEPS[d].1);
                if nx >= 0 && nx < w as i32 && ny < h as i32 {
                    let capacity = below(9);
                    again.set_arc(i % w, i / w, d, capacity);
                    anew.set_arc(i % w, i / w, d, capacity);
                }
            }
        }
        for round in 0..3 {
            for i in 0..w * h {
                let (keep, lose) = (below(30) - 10 * round, below(30));
                again.add_terminal(i % w, i / w, keep, lose);
                anew.add_terminal(i % w, i / w, keep, lose);
            }
            if round < 2 {
                again.cut();
            }
        }
        assert_eq!(again.cut(), anew.cut(), "seed {seed}");
        for i in 0..w * h {
            let side = |grid: &Grid| grid.on_source_side(i % w, i / w);
            assert_eq!(side(&again), side(&anew), "seed {seed}");
        }
    }
}
