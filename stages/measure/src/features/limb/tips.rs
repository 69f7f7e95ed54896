//! Extremities of a surface: where the way from the crown is longest, and what hangs on each.
//!
//! A hand or a foot is a peak of the way from the crown. Going down from the peaks, the land around
//! each grows until it meets the land of another: a foot's meets the other's at the crotch, a hand's
//! that of the trunk at the armpit. Peaks that rise little over their meeting, as fingers and
//! toes do, are no extremities (persistence; Edelsbrunner, Letscher, Zomorodian 2002).

use crate::features::limb::graph::Graph;
use nalgebra::Point3;

/// An extremity and the limb that hangs on it.
pub(crate) struct Tip {
    /// Its node.
    pub(crate) node: u32,
    /// The way from the crown at which its land meets another's. \[mm\]
    pub(crate) meets: f64,
    /// The node where it does: crotch or armpit.
    pub(crate) fold: u32,
    /// How far it rises over that. \[mm\]
    pub(crate) long: f64,
}

/// Peaks of `way` that rise at least `least`, in falling order of the way. \[mm\]
pub(crate) fn tips(graph: &Graph, way: &[f64], least: f64) -> Vec<Tip> {
    let mut order: Vec<u32> = (0..way.len() as u32)
        .filter(|n| way[*n as usize].is_finite())
        .collect();
    order.sort_by(|a, b| {
        let (x, y) = (way[*a as usize], way[*b as usize]);
        y.total_cmp(&x).then(a.cmp(b))
    });
    // The land of each node, named by its peak; NONE for what is lower still (structural: no node).
    const NONE: u32 = u32::MAX;
    let mut land = vec![NONE; way.len()];
    let mut up: Vec<u32> = (0..way.len() as u32).collect();
    let mut met = vec![NONE; way.len()];
    for n in order {
        let here = way[n as usize];
        let mut around: Vec<u32> = graph
            .links(n)
            .iter()
            .filter(|m| land[**m as usize] != NONE)
            .map(|m| shape::root(&mut up, land[*m as usize]))
            .collect();
        around.sort_by(|a, b| way[*b as usize].total_cmp(&way[*a as usize]).then(a.cmp(b)));
        around.dedup();
        let Some(&first) = around.first() else {
            land[n as usize] = n;
            continue;
        };
        land[n as usize] = first;
        for other in &around[1..] {
            up[*other as usize] = first;
            if way[*other as usize] - here >= least {
                // Both rise: each ends here, where it has not ended before.
                for peak in [*other, first] {
                    if met[peak as usize] == NONE {
                        met[peak as usize] = n;
                    }
                }
            }
        }
    }
    let mut found: Vec<Tip> = (0..way.len())
        .filter(|n| met[*n] != NONE)
        .map(|n| Tip {
            node: n as u32,
            meets: way[met[n] as usize],
            fold: met[n],
            long: way[n] - way[met[n] as usize],
        })
        .collect();
    found.sort_by(|a, b| {
        let (x, y) = (way[a.node as usize], way[b.node as usize]);
        y.total_cmp(&x).then(a.node.cmp(&b.node))
    });
    found
}

/// Which nodes belong to an extremity: all about it that are beyond its meeting.
pub(crate) fn land(graph: &Graph, way: &[f64], tip: &Tip) -> Vec<bool> {
    let mut inside = vec![false; way.len()];
    let mut open = vec![tip.node];
    inside[tip.node as usize] = true;
    while let Some(n) = open.pop() {
        for m in graph.links(n) {
            if !inside[*m as usize] && way[*m as usize] > tip.meets {
                inside[*m as usize] = true;
                open.push(*m);
            }
        }
    }
    inside
}

/// Where an extremity's land ends.
pub(crate) struct Fold {
    /// The place. \[mm\]
    pub(crate) at: Point3<f64>,
    /// Its way from the extremity. \[mm\]
    pub(crate) way: f64,
}

/// The fold between an extremity's own land and the one that it meets. A web is flat, so at which node of it the way from the crown is
/// least is chance: the fold is midway between where that way has risen by the size of a node to either side. `from` are ways from
/// the extremity. \[mm\]
pub(crate) fn fold(
    graph: &Graph,
    way: &[f64],
    (tip, own, from): (&Tip, &[bool], &[f64]),
    node: f64,
) -> Fold {
    let far = graph.ways(tip.fold);
    let level = tip.meets + node;
    // How far it is to where the way has risen, on its own side or beyond, and the node after it.
    let risen = |side: bool| {
        let after = (0..way.len()).filter(|b| own[*b] == side && way[*b] > level);
        let links = after.flat_map(|b| graph.links(b as u32).iter().map(move |a| (*a as usize, b)));
        let across = links.filter(|(a, _)| way[*a] <= level).map(|(a, b)| {
            let share = (level - way[a]) / (way[b] - way[a]);
            (
                far[a] + share * (graph.at[a] - graph.at[b]).norm(),
                b as u32,
            )
        });
        across.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))
    };
    let (off, to) = match (risen(true), risen(false)) {
        (Some(near), Some(beyond)) if near.0 > beyond.0 => ((near.0 - beyond.0) / 2.0, near.1),
        (Some(near), Some(beyond)) => ((beyond.0 - near.0) / 2.0, beyond.1),
        _ => (0.0, tip.fold),
    };
    let line = graph.line(&far, to);
    let after = line.iter().position(|n| far[*n as usize] >= off);
    let b = line[after.unwrap_or(line.len() - 1)] as usize;
    let a = line[after.unwrap_or(line.len()).saturating_sub(1)] as usize;
    let share = ((off - far[a]) / (far[b] - far[a]).max(1e-9)).clamp(0.0, 1.0);
    Fold {
        at: graph.at[a].coords.lerp(&graph.at[b].coords, share).into(),
        way: from[a] + share * (from[b] - from[a]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use shape::Mesh;

    /// A cross of flat strips around the origin: four arms of some lengths, each a row of squares. \[mm\]
    fn cross(long: [u32; 4]) -> Mesh {
        let mut mesh = Mesh {
            positions: vec![
                [-5.0, -5.0, 0.0],
                [5.0, -5.0, 0.0],
                [5.0, 5.0, 0.0],
                [-5.0, 5.0, 0.0],
            ],
            faces: vec![[0, 1, 2], [0, 2, 3]],
            ..Mesh::default()
        };
        for (k, count) in (0u32..).zip(long) {
            let (mut a, mut b) = (k, (k + 1) % 4);
            let out = [[0.0, -10.0], [10.0, 0.0], [0.0, 10.0], [-10.0, 0.0]][k as usize];
            for _ in 0..count {
                let n = mesh.positions.len() as u32;
                for v in [a, b] {
                    let [x, y, z] = mesh.positions[v as usize];
                    mesh.positions.push([x + out[0], y + out[1], z]);
                }
                mesh.faces.extend([[b, a, n], [b, n, n + 1]]);
                (a, b) = (n, n + 1);
            }
        }
        mesh
    }

    #[test]
    fn a_fold_is_midway_over_a_flat_web_whichever_of_its_nodes_is_the_lowest() {
        let strip = |mm: f32| {
            let mut mesh = cross([60, 3, 60, 3]);
            mesh.positions.iter_mut().for_each(|p| p[1] *= mm);
            mesh
        };
        let graph = Graph::new(&strip(1.0), 1.0);
        let tip = (0..graph.at.len())
            .max_by(|a, b| graph.at[*a].y.total_cmp(&graph.at[*b].y))
            .unwrap();
        let from = graph.ways(tip as u32);
        // Ways that rise from a web 60 mm wide to either side, whose lowest node is anywhere in it.
        let found = [-25.0, -5.0, 15.0].map(|lowest| {
            let off = |p: &Point3<f64>| (p.y.abs() - 30.0).max(0.0) + 1e-3 * (p.y - lowest).abs();
            let way: Vec<f64> = graph.at.iter().map(off).collect();
            let met = (0..way.len())
                .min_by(|a, b| way[*a].total_cmp(&way[*b]))
                .unwrap();
            let own: Vec<bool> = graph.at.iter().map(|p| p.y > lowest).collect();
            let tip = Tip {
                node: tip as u32,
                meets: way[met],
                fold: met as u32,
                long: 0.0,
            };
            let fold = fold(&graph, &way, (&tip, &own, &from), 10.0);
            (fold.at.y, fold.way)
        });
        for (y, way) in found {
            assert!(y.abs() < 3.0, "{y}");
            // As far as the strip is wide.
            proof::near(way + y, from[0] + graph.at[0].y, 10.5);
        }
    }

    #[test]
    fn three_of_four_arms_of_a_cross_rise_from_the_end_of_the_fourth() {
        let mesh = cross([60, 40, 50, 3]);
        let graph = Graph::new(&mesh, 1.0);
        let end = (0..graph.at.len())
            .min_by(|a, b| graph.at[*a].x.total_cmp(&graph.at[*b].x))
            .unwrap();
        let way = graph.ways(end as u32);
        let found = tips(&graph, &way, 100.0);
        assert_eq!(found.len(), 3);
        for (tip, long) in found.iter().zip([600.0, 500.0, 400.0]) {
            assert!((tip.long - long).abs() < 30.0, "{} for {long}", tip.long);
            let own = land(&graph, &way, tip).iter().filter(|i| **i).count() as f64;
            assert!((own / (long / 5.0) - 1.0).abs() < 0.1, "{own} for {long}");
        }
        assert!(tips(&graph, &way, 2000.0).is_empty());
    }
}
