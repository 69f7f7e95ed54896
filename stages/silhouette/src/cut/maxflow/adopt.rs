//! Adoption: nodes cut off their tree find new parents or become free (§3.2.2 and §3.2.3).

use super::{FREE, Grid, NOBODY, ORPHAN, SOURCE, TERMINAL};

impl Grid {
    pub(super) fn orphan(&mut self, node: usize) {
        self.parent[node] = ORPHAN;
        self.orphans.push(node as u32);
    }

    /// Distance to the root, if the way up ends at a terminal; marks the way with the time.
    fn rooted(&mut self, start: usize) -> Option<u32> {
        let (mut node, mut steps) = (start, 0);
        let total = loop {
            if self.stamp[node] == self.time {
                break steps + self.distance[node];
            }
            match self.parent[node] {
                TERMINAL => {
                    self.stamp[node] = self.time;
                    self.distance[node] = 1;
                    break steps + 1;
                }
                p if p < TERMINAL => node = self.neighbour(node, p as usize),
                _ => return None,
            }
            steps += 1;
        };
        let (mut node, mut left) = (start, total);
        while self.stamp[node] != self.time {
            self.stamp[node] = self.time;
            self.distance[node] = left;
            left -= 1;
            node = self.neighbour(node, self.parent[node] as usize);
        }
        Some(total)
    }

    /// Finds parents for nodes that lost theirs, or sets them free.
    pub(super) fn adopt(&mut self) {
        let mut next = 0;
        while next < self.orphans.len() {
            let node = self.orphans[next] as usize;
            next += 1;
            let tree = self.tree[node];
            let mut best: Option<(u32, usize)> = None;
            for d in 0..8 {
                let other = self.neighbour(node, d);
                let inward = if tree == SOURCE {
                    self.arcs[other][7 - d]
                } else {
                    self.arcs[node][d]
                };
                if inward <= 0 || self.tree[other] != tree {
                    continue;
                }
                if let Some(far) = self.rooted(other)
                    && best.is_none_or(|(least, _)| far < least)
                {
                    best = Some((far, d));
                }
            }
            if let Some((far, d)) = best {
                self.parent[node] = d as u8;
                self.stamp[node] = self.time;
                self.distance[node] = far + 1;
                continue;
            }
            for d in 0..8 {
                let other = self.neighbour(node, d);
                if self.tree[other] != tree {
                    continue;
                }
                let inward = if tree == SOURCE {
                    self.arcs[other][7 - d]
                } else {
                    self.arcs[node][d]
                };
                if inward > 0 {
                    self.wake(other);
                }
                if self.parent[other] == 7 - d as u8 {
                    self.orphan(other);
                }
            }
            self.tree[node] = FREE;
            self.parent[node] = NOBODY;
        }
        self.orphans.clear();
    }
}
