//! What was seen of a walk: tracks by photo and photos by track.

use shape::{PhotoId, Tracks};

/// Tracks, ready to be looked up: observations by track, tracks by photo; pixels as photos are stored.
pub(crate) struct Seen {
    /// Of each track, where which photo shows it.
    pub(crate) tracks: Vec<Vec<(PhotoId, [f64; 2])>>,
    /// Of each photo, the tracks that it shows, and where.
    pub(crate) by_photo: Vec<Vec<(usize, [f64; 2])>>,
}

impl Seen {
    /// Of tracks; `stored` turns upright pixels of a photo to those of its file.
    pub(crate) fn new(
        tracks: &Tracks,
        photos: usize,
        stored: impl Fn(PhotoId, [f64; 2]) -> [f64; 2],
    ) -> Seen {
        let mut by_photo = vec![Vec::new(); photos];
        let one = |(t, track): (usize, &Vec<shape::Observation>)| {
            track
                .iter()
                .filter(|s| (s.photo.0 as usize) < photos)
                .map(|s| {
                    let at = stored(s.photo, s.at_px.map(f64::from));
                    by_photo[s.photo.0 as usize].push((t, at));
                    (s.photo, at)
                })
                .collect()
        };
        let tracks = tracks.points.iter().enumerate().map(one).collect();
        Seen { tracks, by_photo }
    }

    /// Where two photos show the same.
    pub(crate) fn both(&self, a: PhotoId, b: PhotoId) -> Vec<(usize, [[f64; 2]; 2])> {
        let on_b = |t: usize| {
            let other = self.tracks[t].iter().find(|(photo, _)| *photo == b);
            other.map(|(_, at)| *at)
        };
        self.by_photo[a.0 as usize]
            .iter()
            .filter_map(|(t, at)| Some((*t, [*at, on_b(*t)?])))
            .collect()
    }
}
