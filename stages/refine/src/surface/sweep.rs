//! Looks along each vertex' normal for the place where the pictures agree best: what a gradient
//! cannot see because another agreement is between.

use crate::evidence::agreement::agreement;
use crate::surface::energy::Forces;
use crate::surface::sight::Sight;
use crate::surface::step::DataTerm;
use rayon::prelude::*;
use shape::Adjacency;

/// For each vertex that is asked for, the best place along its normal \[mm\] and how sure that is (0..=1):
/// up to so many steps inward and outward.
///
/// Scores are gathered over two rings of neighbours, so that a lone coincidence does not win; the
/// place is the top of the parabola through the best step and its neighbours. Patches of neighbours overlap,
/// so only some of them are read ([`apart`]).
pub fn sweep(
    forces: &Forces<'_>,
    around: &Adjacency,
    [inward, outward]: [usize; 2],
    step_mm: f64,
    asked: impl Fn(usize) -> bool,
) -> Vec<Option<(f64, f64)>> {
    let count = forces.visible.len();
    let asked: Vec<bool> = (0..count).map(asked).collect();
    let first = wider(&asked, around);
    let near = wider(&first, around);
    let read: Vec<bool> = apart(around, count)
        .iter()
        .zip(&near)
        .map(|(a, n)| *a && *n)
        .collect();
    let steps = inward + outward + 1;
    let offset = |k: f64| (k - inward as f64) * step_mm;
    let scores = scores(forces, &read, steps, |k| offset(k as f64));
    let scores = gathered(&scores, around, steps, &first, &read);
    let scores = gathered(&scores, around, steps, &asked, &vec![true; count]);
    let best = |v: usize| {
        let (k, sure) = best(&scores[v * steps..(v + 1) * steps])?;
        Some((offset(k), sure))
    };
    let each = (0..count).map(|v| asked[v].then(|| best(v).unwrap_or((0.0, 0.0))));
    each.collect()
}

/// Vertices of which no two are neighbours, so many that every other has one of them for a neighbour.
pub fn apart(around: &Adjacency, count: usize) -> Vec<bool> {
    let mut taken = vec![false; count];
    for v in 0..count {
        taken[v] = !around.vertices(v as u32).iter().any(|j| taken[*j as usize]);
    }
    taken
}

/// Those and their neighbours.
fn wider(some: &[bool], around: &Adjacency) -> Vec<bool> {
    let one = |v: usize| some[v] || around.vertices(v as u32).iter().any(|j| some[*j as usize]);
    (0..some.len()).map(one).collect()
}

/// How well the pictures agree at each step of each vertex that is to be read, one row a vertex; 0 at other vertices.
fn scores(
    forces: &Forces<'_>,
    read: &[bool],
    steps: usize,
    offset: impl Fn(usize) -> f64 + Sync,
) -> Vec<f32> {
    let offset = &offset;
    (0..read.len())
        .into_par_iter()
        .with_min_len(64)
        .flat_map_iter(|v| {
            let (visible, frame) = (forces.visible.of(v), forces.visible.frame(v));
            let shown = read[v] && visible.len() >= 2;
            (0..steps).map(move |k| {
                if !shown {
                    return 0.0;
                }
                let a = agreement::<0>(
                    forces.pictures,
                    visible,
                    frame,
                    offset(k),
                    forces.window,
                    forces.rules.pairing,
                );
                a.score as f32
            })
        })
        .collect()
}

/// Each wanted row, twice, and those of its ring, on average: of those that were read.
fn gathered(
    scores: &[f32],
    around: &Adjacency,
    steps: usize,
    wanted: &[bool],
    read: &[bool],
) -> Vec<f32> {
    (0..wanted.len())
        .into_par_iter()
        .with_min_len(256)
        .flat_map_iter(|v| {
            let (mut sums, mut weight) = (vec![0.0f32; steps], 0.0f32);
            let mut add = |j: usize, w: f32| {
                if read[j] {
                    let row = &scores[j * steps..(j + 1) * steps];
                    sums.iter_mut().zip(row).for_each(|(s, r)| *s += w * r);
                    weight += w;
                }
            };
            if wanted[v] {
                add(v, 2.0);
                around
                    .vertices(v as u32)
                    .iter()
                    .for_each(|j| add(*j as usize, 1.0));
            }
            let weight = weight.max(1.0);
            sums.into_iter().map(move |s| s / weight)
        })
        .collect()
}

/// The best step, to a part of one, and how sure it is: sure where no place farther off comes close. [`None`]
/// where none is best but at an end.
fn best(row: &[f32]) -> Option<(f64, f64)> {
    let steps = row.len();
    let best = (0..steps).max_by(|a, b| row[*a].total_cmp(&row[*b]))?;
    let top = f64::from(row[best]);
    if top <= 0.0 || best == 0 || best + 1 == steps {
        return None;
    }
    let (l, r) = (f64::from(row[best - 1]), f64::from(row[best + 1]));
    let shift = 0.5 * (l - r) / (l - 2.0 * top + r).min(-1e-12);
    let rival = (0..steps)
        .filter(|k| k.abs_diff(best) > 2)
        .map(|k| f64::from(row[k]))
        .fold(0.0, f64::max);
    let sure = (1.0 - rival / top).clamp(0.0, 1.0);
    Some((best as f64 + shift.clamp(-0.5, 0.5), sure))
}

/// What searches along the normals have found so far.
#[derive(Debug, Clone, Default)]
pub(crate) struct Search {
    /// The best place of each vertex in the last search that asked for it \[mm\]; infinite where none was sure.
    pub places: Vec<[f32; 3]>,
}

impl Search {
    /// Replaces the photos' pull by one to the place that a search along the normals finds. A vertex that the
    /// slope has brought to within a pixel of the place that its last search found is not searched again.
    pub(crate) fn follow(
        &mut self,
        forces: &Forces<'_>,
        around: &Adjacency,
        reach_px: f64,
        now: &Sight,
        data_term: &mut DataTerm,
    ) {
        let step = forces.footprint;
        let reach = [reach_px, reach_px / 2.0].map(|r| r.ceil() as usize);
        self.places.resize(now.x.len(), [f32::INFINITY; 3]);
        let arrived = |v: usize| {
            let place = nalgebra::Vector3::from(self.places[v].map(f64::from));
            place.x.is_finite() && (place - now.x[v]).dot(&now.normals[v]).abs() <= step
        };
        let found = sweep(forces, around, reach, step, |v| !arrived(v));
        for (v, found) in found.iter().enumerate() {
            let Some((offset, sure)) = found else {
                continue;
            };
            let photo = forces.area(v) * now.seen[v].slope;
            let stiff = forces.area(v) * now.seen[v].stiffness;
            data_term.pull[v] += stiff * sure * offset - photo;
            data_term.stiffness[v] += stiff * (sure - 1.0);
            let place = now.x[v] + now.normals[v] * *offset;
            self.places[v] = match *sure > 0.0 {
                true => [place.x, place.y, place.z].map(|p| p as f32),
                false => [f32::INFINITY; 3],
            };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::solids::sphere;

    #[test]
    fn of_vertices_apart_no_two_are_neighbours_and_every_other_has_one_beside() {
        let mesh = sphere(10.0, 4);
        let around = Adjacency::new(&mesh);
        let taken = apart(&around, mesh.positions.len());
        for (v, own) in taken.iter().enumerate() {
            let ring = around.vertices(v as u32).iter();
            let beside = ring.filter(|j| taken[**j as usize]).count();
            assert_eq!(*own, beside == 0, "vertex {v}");
        }
        let share = taken.iter().filter(|t| **t).count() as f64 / taken.len() as f64;
        assert!(share > 0.2 && share < 0.4, "{share}");
    }

    #[test]
    fn a_place_is_sure_where_no_other_comes_close() {
        let at = |row: &[f32]| best(row);
        let (place, sure) = at(&[0.0, 0.1, 0.4, 0.8, 0.4, 0.1, 0.0]).unwrap();
        proof::near(place, 3.0, 1e-6);
        proof::near(sure, 1.0, 1e-6);
        let (place, sure) = at(&[0.0, 0.6, 0.0, 0.0, 0.4, 0.8, 0.6, 0.0]).unwrap();
        assert!(place > 5.0 && place < 5.5, "{place}");
        proof::near(sure, 0.25, 1e-6);
        assert_eq!(at(&[0.9, 0.5, 0.1]), None);
        assert_eq!(at(&[0.0, 0.0, 0.0]), None);
    }
}
