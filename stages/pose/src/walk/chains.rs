//! Matches of pairs of photos joined to points that each photo shows once.

use shape::{Features, Observation, PhotoId, Tracks, root};
use std::collections::BTreeMap;

/// What two photos have in common: their places in the list of photos, and pairs of features.
pub(crate) struct Link {
    pub(crate) photos: (usize, usize),
    pub(crate) matches: Vec<(u32, u32)>,
}

/// Sets of features, each with the photos that it is on.
struct Sets {
    parents: Vec<u32>,
    photos: BTreeMap<u32, Vec<usize>>,
}

impl Sets {
    /// Joins two sets, unless both are on one photo.
    fn join(&mut self, (a, on_a): (u32, usize), (b, on_b): (u32, usize)) {
        let [a, b] = [a, b].map(|of| root(&mut self.parents, of));
        if a == b {
            return;
        }
        let photos = |at: u32, on: usize| self.photos.get(&at).cloned().unwrap_or(vec![on]);
        let (mut all, other) = (photos(a, on_a), photos(b, on_b));
        if all.iter().any(|p| other.contains(p)) {
            return;
        }
        all.extend(other);
        shape::join(&mut self.parents, a, b);
        self.photos.remove(&a.max(b));
        self.photos.insert(a.min(b), all);
    }
}

/// Joins matches to points, those of the pairs with most matches first: a match that would put two
/// features of one photo into one point is wrong, or an earlier one was.
pub(crate) fn chained(views: &[(PhotoId, &Features)], links: &[Link]) -> Tracks {
    let mut first = vec![0u32];
    for (_, features) in views {
        first.push(first[first.len() - 1] + features.points.len() as u32);
    }
    let mut sets = Sets {
        parents: (0..first[views.len()]).collect(),
        photos: BTreeMap::new(),
    };
    let mut order: Vec<&Link> = links.iter().collect();
    order.sort_by_key(|l| (std::cmp::Reverse(l.matches.len()), l.photos));
    for link in order {
        let (v, w) = link.photos;
        for (i, j) in &link.matches {
            sets.join((first[v] + i, v), (first[w] + j, w));
        }
    }
    let mut groups: BTreeMap<u32, Vec<Observation>> = BTreeMap::new();
    for (v, (id, features)) in views.iter().enumerate() {
        for (i, k) in features.points.iter().enumerate() {
            let root = root(&mut sets.parents, first[v] + i as u32);
            if sets.photos.contains_key(&root) {
                groups.entry(root).or_default().push(Observation {
                    photo: *id,
                    at_px: [k.x, k.y],
                    scale_px: k.scale,
                });
            }
        }
    }
    Tracks {
        points: groups.into_values().collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use shape::Keypoint;

    #[test]
    fn a_match_that_contradicts_stronger_ones_joins_nothing() {
        let features = |count: u32| Features {
            points: (0..count)
                .map(|i| Keypoint {
                    x: i as f32,
                    y: 0.0,
                    scale: 2.0,
                    angle: 0.0,
                })
                .collect(),
            descriptors: vec![[0; 128]; count as usize],
        };
        let all = [features(3), features(3), features(3)];
        let views: Vec<(PhotoId, &Features)> =
            (0..3).map(|i| (PhotoId(i as u32), &all[i])).collect();
        let link = |photos, matches: &[(u32, u32)]| Link {
            photos,
            matches: matches.to_vec(),
        };
        let links = [
            // Feature 0 of the third photo is matched to 1 of the first.
            link((0, 2), &[(1, 0)]),
            link((0, 1), &[(0, 0), (1, 1), (2, 2)]),
            link((1, 2), &[(0, 0), (1, 1)]),
        ];
        let found = chained(&views, &links);
        let shown: Vec<Vec<(u32, f32)>> = found
            .points
            .iter()
            .map(|t| t.iter().map(|s| (s.photo.0, s.at_px[0])).collect())
            .collect();
        assert_eq!(
            shown,
            vec![
                vec![(0, 0.0), (1, 0.0), (2, 0.0)],
                vec![(0, 1.0), (1, 1.0), (2, 1.0)],
                vec![(0, 2.0), (1, 2.0)],
            ]
        );
    }
}
