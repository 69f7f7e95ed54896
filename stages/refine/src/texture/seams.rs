//! Fewer seams: whole charts are given to the photo of a chart beside them.
//!
//! E = -Σ cosine + seam · edges between photos, over faces and edges (Lempitsky and Ivanov 2007, eq. 3). Faces that change one at
//! a time stay in small charts, for each loses its neighbours by it: of many photos that are near each other noise of the
//! normals decides which one shows a face best. A chart as a whole can go, and only does where E falls.

use crate::texture::charts::{Chart, NOWHERE, charts};
use rayon::prelude::*;

/// Gives charts to photos beside them until none lowers the energy. Of each face `quality` has the photos that show it, rising,
/// and the cosine between its normal and the way to each; `seam` is what an edge between two photos costs.
pub(crate) fn give_to_photos_beside(
    labels: &mut [u16],
    quality: &[Vec<(u16, f32)>],
    beside: &[Vec<u32>],
    seam: f64,
) {
    loop {
        let all = charts(beside, labels);
        let mut chart_of = vec![0u32; labels.len()];
        for (c, chart) in (0..).zip(&all) {
            chart.faces.iter().for_each(|f| chart_of[*f as usize] = c);
        }
        let better = |chart: &Chart| better(chart, labels, quality, beside, seam);
        let better: Vec<Option<u16>> = all.par_iter().map(better).collect();
        // Small charts first; what is beside one that goes is judged anew.
        let mut order: Vec<usize> = (0..all.len()).filter(|c| better[*c].is_some()).collect();
        order.sort_by_key(|c| (all[*c].faces.len(), *c));
        if order.is_empty() {
            return;
        }
        let mut wait = vec![false; all.len()];
        for c in order {
            let Some(photo) = better[c].filter(|_| !wait[c]) else {
                continue;
            };
            for f in &all[c].faces {
                labels[*f as usize] = photo;
                let around = beside[*f as usize].iter();
                around.for_each(|g| wait[chart_of[*g as usize] as usize] = true);
            }
        }
    }
}

/// The photo of a chart beside this one with which the energy is least, if it is less than now.
fn better(
    chart: &Chart,
    labels: &[u16],
    quality: &[Vec<(u16, f32)>],
    beside: &[Vec<u32>],
    seam: f64,
) -> Option<u16> {
    if chart.photo == NOWHERE {
        return None;
    }
    let edges = chart.faces.iter().flat_map(|f| &beside[*f as usize]);
    let mut photos: Vec<u16> = edges.map(|g| labels[*g as usize]).collect();
    photos.retain(|photo| *photo != chart.photo && *photo != NOWHERE);
    photos.sort_unstable();
    let of = |photos: &[u16]| {
        let less_seam = seam * photos.len() as f64;
        let loss = chart.faces.iter().map(|f| {
            let cosine = |photo| cosine(&quality[*f as usize], photo);
            Some(cosine(chart.photo)? - cosine(photos[0])?)
        });
        let gain = less_seam - loss.sum::<Option<f64>>()?;
        // More than rounding, so that no chart goes back and forth.
        (gain > less_seam * f64::from(f32::EPSILON)).then_some((photos[0], gain))
    };
    let all = photos.chunk_by(|a, b| a == b).filter_map(of);
    let most = all.reduce(|most, next| if next.1 > most.1 { next } else { most });
    most.map(|(photo, _)| photo)
}

/// How squarely a photo shows a face; `None` if it does not.
fn cosine(quality: &[(u16, f32)], photo: u16) -> Option<f64> {
    let at = quality.binary_search_by_key(&photo, |q| q.0).ok()?;
    Some(f64::from(quality[at].1))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A strip of faces, each beside the next.
    fn strip(count: u32) -> Vec<Vec<u32>> {
        let beside = |f: u32| {
            let both = [f.checked_sub(1), Some(f + 1).filter(|g| *g < count)];
            both.into_iter().flatten().collect()
        };
        (0..count).map(beside).collect()
    }

    #[test]
    fn small_charts_go_to_the_photo_beside_while_it_shows_them_as_well() {
        let count = 40;
        // Photo 1 shows all but the last ten, photo 0 the last twenty, far better than photo 1 does there.
        let of = |f: u32| match f {
            0..20 => vec![(1, 0.9), (2, 0.92)],
            20..30 => vec![(0, 0.9), (1, 0.5)],
            _ => vec![(0, 0.9)],
        };
        let quality: Vec<Vec<(u16, f32)>> = (0..count).map(of).collect();
        // Photo 2 in pieces of two faces, which no single face leaves.
        let label = |f: u32| match f {
            20.. => 0,
            f if f / 2 % 2 == 0 => 2,
            _ => 1,
        };
        let mut labels: Vec<u16> = (0..count).map(label).collect();
        give_to_photos_beside(&mut labels, &quality, &strip(count), 0.25);
        let left = charts(&strip(count), &labels);
        let sizes: Vec<usize> = left.iter().map(|c| c.faces.len()).collect();
        assert_eq!(sizes, [20, 20]);
        assert_eq!(labels[39], 0);
    }

    #[test]
    fn what_no_photo_shows_and_what_no_photo_beside_shows_stay() {
        let quality = [vec![], vec![(3, 0.8)], vec![(4, 0.9)]];
        let mut labels = [NOWHERE, 3, 4];
        give_to_photos_beside(&mut labels, &quality, &strip(3), 10.0);
        assert_eq!(labels, [NOWHERE, 3, 4]);
    }
}
