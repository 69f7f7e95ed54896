//! Least cut of a grid between a source and a sink (Boykov and Kolmogorov 2004).
//!
//! Nodes are the pixels of a rectangle with their eight neighbours; arcs are implicit. Two search
//! trees grow from source and sink until they touch (growth), flow is pushed along the path
//! (augmentation), and nodes cut off their tree look for new parents (adoption), with distances
//! and time stamps as in §3.2.2 of the paper. Capacities are whole numbers, so sums are exact.

mod adopt;

use std::collections::VecDeque;

/// The eight neighbours (structural); the opposite of `d` is `7 - d`.
pub const STEPS: [(i32, i32); 8] = [
    (-1, -1),
    (0, -1),
    (1, -1),
    (-1, 0),
    (1, 0),
    (-1, 1),
    (0, 1),
    (1, 1),
];

/// Of no tree (structural).
const FREE: u8 = 0;
/// Of the source's tree (structural).
const SOURCE: u8 = 1;
/// Of the sink's tree (structural).
const SINK: u8 = 2;
/// A parent that is source or sink itself: beyond the eight neighbours (structural).
const TERMINAL: u8 = 8;
/// A parent that was cut off (structural).
const ORPHAN: u8 = 9;
/// No parent (structural).
const NOBODY: u8 = 10;

/// A grid on its way to its least cut.
pub struct Grid {
    /// Row length with a border of one node on each side.
    stride: usize,
    /// Residual capacity towards each neighbour.
    arcs: Vec<[i32; 8]>,
    /// Residual capacity from the source, or if negative to the sink.
    terminal: Vec<i32>,
    tree: Vec<u8>,
    parent: Vec<u8>,
    distance: Vec<u32>,
    stamp: Vec<u32>,
    queued: Vec<bool>,
    active: VecDeque<u32>,
    orphans: Vec<u32>,
    offsets: [isize; 8],
    /// Cells of a block along x, y and z; of a picture its columns, rows, and one.
    block: [usize; 3],
    time: u32,
    /// What it costs that all are on the source's side.
    lost: i64,
}

impl Grid {
    /// A grid without capacities.
    pub fn new(width: usize, height: usize) -> Self {
        let stride = width + 2;
        let offsets = STEPS.map(|(dx, dy)| dy as isize * stride as isize + dx as isize);
        Grid::with(width, height, offsets, [width, height, 1])
    }

    /// A block of cells with their six neighbours, x fastest, without capacities: a picture whose
    /// rows are those of all layers, with an empty layer before the first and behind the last.
    pub fn block(block: [usize; 3]) -> Self {
        let [nx, ny, nz] = block;
        let (stride, layer) = ((nx + 2) as isize, ((nx + 2) * ny) as isize);
        // The arcs of directions 2 and 5 stay empty.
        let offsets = [-layer, -stride, 0, -1, 1, 0, stride, layer];
        Grid::with(nx, ny * (nz + 2), offsets, block)
    }

    fn with(width: usize, height: usize, offsets: [isize; 8], block: [usize; 3]) -> Self {
        let stride = width + 2;
        let nodes = stride * (height + 2);
        Grid {
            stride,
            arcs: vec![[0; 8]; nodes],
            terminal: vec![0; nodes],
            tree: vec![FREE; nodes],
            parent: vec![NOBODY; nodes],
            distance: vec![0; nodes],
            stamp: vec![0; nodes],
            queued: vec![false; nodes],
            active: VecDeque::new(),
            orphans: Vec::new(),
            offsets,
            block,
            time: 0,
            lost: 0,
        }
    }

    fn node(&self, x: usize, y: usize) -> usize {
        (y + 1) * self.stride + x + 1
    }

    fn neighbour(&self, node: usize, d: usize) -> usize {
        (node as isize + self.offsets[d]) as usize
    }

    /// What it costs more than before to put a pixel on the sink's side (`keep`) or on the source's (`lose`); after a cut,
    /// too.
    pub fn add_terminal(&mut self, x: usize, y: usize, keep: i32, lose: i32) {
        let node = self.node(x, y);
        self.terminal[node] += keep - lose;
        self.lost += i64::from(lose);
    }

    /// What it costs to part a pixel from its neighbour `d`; both must be inside.
    pub fn set_arc(&mut self, x: usize, y: usize, d: usize, capacity: i32) {
        let node = self.node(x, y);
        let other = self.neighbour(node, d);
        self.arcs[node][d] = capacity;
        self.arcs[other][7 - d] = capacity;
    }

    /// Column and row of a cell of a block.
    fn place(&self, cell: usize) -> (usize, usize) {
        let [nx, ny, _] = self.block;
        (cell % nx, cell / nx + ny)
    }

    /// As [`add_terminal`](Self::add_terminal), of a cell of a block.
    pub fn add_cell_terminal(&mut self, cell: usize, keep: i32, lose: i32) {
        let (x, y) = self.place(cell);
        self.add_terminal(x, y, keep, lose);
    }

    /// What it costs to part a cell of a block from the next along x, y or z (0, 1, 2), which must be
    /// inside.
    pub fn set_cell_arc(&mut self, cell: usize, axis: usize, capacity: i32) {
        let (x, y) = self.place(cell);
        self.set_arc(x, y, [4, 6, 7][axis], capacity);
    }

    /// Whether a cell of a block ended on the source's side.
    pub fn cell_on_source_side(&self, cell: usize) -> bool {
        let (x, y) = self.place(cell);
        self.on_source_side(x, y)
    }

    /// Finds the least cut; returns the flow, which is its cost.
    pub fn cut(&mut self) -> i64 {
        let nodes = 0..self.terminal.len();
        for node in nodes.clone() {
            (self.tree[node], self.parent[node]) = match self.terminal[node] {
                0 => (FREE, NOBODY),
                more if more > 0 => (SOURCE, TERMINAL),
                _ => (SINK, TERMINAL),
            };
        }
        self.distance.fill(1);
        self.stamp.fill(0);
        self.time = 0;
        // Amid its own tree a node has nowhere to grow.
        for node in nodes {
            let tree = self.tree[node];
            let other = |d: usize| self.tree[self.neighbour(node, d)] != tree;
            if tree != FREE && (0..8).any(other) {
                self.wake(node);
            }
        }
        while let Some(node) = self.active.pop_front() {
            let node = node as usize;
            self.queued[node] = false;
            if self.tree[node] == FREE {
                continue;
            }
            // The node stays on the front as long as paths through it are found.
            while let Some((from, d)) = self.grow(node) {
                self.time += 1;
                self.augment(from, d);
                self.adopt();
                if self.tree[node] == FREE {
                    break;
                }
            }
        }
        let left = self
            .terminal
            .iter()
            .map(|t| i64::from(t.min(&0).unsigned_abs()));
        self.lost - left.sum::<i64>()
    }

    /// Whether a pixel ended on the source's side.
    pub fn on_source_side(&self, x: usize, y: usize) -> bool {
        self.tree[self.node(x, y)] == SOURCE
    }

    fn wake(&mut self, node: usize) {
        if !self.queued[node] {
            self.queued[node] = true;
            self.active.push_back(node as u32);
        }
    }

    /// Residual capacity in the direction in which the tree of `node` grows.
    fn outward(&self, node: usize, d: usize) -> i32 {
        if self.tree[node] == SOURCE {
            self.arcs[node][d]
        } else {
            self.arcs[self.neighbour(node, d)][7 - d]
        }
    }

    /// Grows the tree at a node; returns the arc (source's node, direction) where trees touch.
    fn grow(&mut self, node: usize) -> Option<(usize, usize)> {
        let tree = self.tree[node];
        for d in 0..8 {
            if self.outward(node, d) <= 0 {
                continue;
            }
            let other = self.neighbour(node, d);
            if self.tree[other] == FREE {
                self.tree[other] = tree;
                self.parent[other] = 7 - d as u8;
                self.stamp[other] = self.stamp[node];
                self.distance[other] = self.distance[node] + 1;
                self.wake(other);
            } else if self.tree[other] != tree {
                return Some(if tree == SOURCE {
                    (node, d)
                } else {
                    (other, 7 - d)
                });
            } else if self.stamp[other] <= self.stamp[node]
                && self.distance[other] > self.distance[node] + 1
            {
                // A shorter way to the root.
                self.parent[other] = 7 - d as u8;
                self.stamp[other] = self.stamp[node];
                self.distance[other] = self.distance[node] + 1;
            }
        }
        None
    }

    /// The next node towards the root, and the residual capacity of the arc in flow direction.
    fn step_up(&self, node: usize) -> Option<(usize, usize)> {
        let p = self.parent[node];
        (p < TERMINAL).then(|| (self.neighbour(node, p as usize), p as usize))
    }

    /// Pushes what fits through a path from root to root over the arc where trees touch.
    fn augment(&mut self, from: usize, d: usize) {
        let to = self.neighbour(from, d);
        let mut least = self.arcs[from][d];
        let mut node = from;
        while let Some((up, p)) = self.step_up(node) {
            least = least.min(self.arcs[up][7 - p]);
            node = up;
        }
        least = least.min(self.terminal[node]);
        node = to;
        while let Some((up, p)) = self.step_up(node) {
            least = least.min(self.arcs[node][p]);
            node = up;
        }
        least = least.min(-self.terminal[node]);
        self.arcs[from][d] -= least;
        self.arcs[to][7 - d] += least;
        node = from;
        while let Some((up, p)) = self.step_up(node) {
            self.arcs[node][p] += least;
            self.arcs[up][7 - p] -= least;
            if self.arcs[up][7 - p] == 0 {
                self.orphan(node);
            }
            node = up;
        }
        self.terminal[node] -= least;
        if self.terminal[node] == 0 {
            self.orphan(node);
        }
        node = to;
        while let Some((up, p)) = self.step_up(node) {
            self.arcs[up][7 - p] += least;
            self.arcs[node][p] -= least;
            if self.arcs[node][p] == 0 {
                self.orphan(node);
            }
            node = up;
        }
        self.terminal[node] += least;
        if self.terminal[node] == 0 {
            self.orphan(node);
        }
    }
}
