//! What the photos of a turn say together: who is followed, and whether it is a person.

use shape::{ByPhoto, Crop, Found};

/// The network says that its square shows a person.
const PRESENT: f32 = 0.5;
/// Squares of one person share at least so much of their union: one may lie a third of its side beside the other.
const ONE_PERSON: f32 = 0.5;
/// So many of the photos must show the same person. By hand, between what was looked at: on the live man and woman, three
/// made bodies, the mannequin and a marble David all photos do, on a draped statue on a pedestal 15 of 25, on a squirrel
/// 21 of 36, on a temple 1 of 16.
const LEAST_SHARE: f64 = 0.75;

/// Puts the one who is followed first on each photo, whoever else is there behind; whether it is a person.
pub(crate) fn followed(views: ByPhoto<Vec<Found>>) -> (ByPhoto<Vec<Found>>, bool) {
    let mut views: Vec<_> = views.iter().map(|(id, f)| (id, f.clone())).collect();
    let mut same = 0;
    // Once with whoever is surest on each photo, once with who is followed then.
    for _ in 0..2 {
        let first = views.iter().filter_map(|(_, f)| f.first());
        let squares: Vec<Crop> = first.filter(|f| present(f)).map(|f| f.crop).collect();
        let Some(middle) = middle(&squares) else {
            break;
        };
        let apart = |f: &Found| -overlap(&f.crop, &middle);
        same = 0;
        for (_, found) in &mut views {
            let nearest = (0..found.len())
                .filter(|i| present(&found[*i]))
                .min_by(|a, b| apart(&found[*a]).total_cmp(&apart(&found[*b])));
            if let Some(nearest) = nearest {
                found[..=nearest].rotate_right(1);
                same += usize::from(-apart(&found[0]) >= ONE_PERSON);
            }
        }
    }
    let person = !views.is_empty() && same as f64 >= LEAST_SHARE * views.len() as f64;
    (views.into_iter().collect(), person)
}

/// Whether two squares are one person's.
pub(crate) fn alike(a: &Crop, b: &Crop) -> bool {
    overlap(a, b) >= ONE_PERSON
}

/// Whether the network that looked from near says that it is a person.
pub(crate) fn present(found: &Found) -> bool {
    found.presence >= PRESENT
}

/// The square in the middle of all, number by number; its turn is left out.
fn middle(squares: &[Crop]) -> Option<Crop> {
    let middle = |of: fn(&Crop) -> f32| {
        let mut all: Vec<f32> = squares.iter().map(of).collect();
        all.sort_by(f32::total_cmp);
        all.get(all.len() / 2).copied()
    };
    Some(Crop {
        centre_px: [middle(|c| c.centre_px[0])?, middle(|c| c.centre_px[1])?],
        side_px: middle(|c| c.side_px)?,
        angle: 0.0,
    })
}

/// What two squares share of their union, however they are turned.
fn overlap(a: &Crop, b: &Crop) -> f32 {
    let along = |k: usize| {
        let half = |c: &Crop| c.side_px / 2.0;
        let end = (a.centre_px[k] + half(a)).min(b.centre_px[k] + half(b));
        (end - (a.centre_px[k] - half(a)).max(b.centre_px[k] - half(b))).max(0.0)
    };
    let shared = along(0) * along(1);
    shared / (a.side_px * a.side_px + b.side_px * b.side_px - shared).max(f32::MIN_POSITIVE)
}

#[cfg(test)]
mod tests {
    use super::*;
    use shape::{Image, Joint, PhotoId};

    fn found(x: f32, side: f32, score: f32, presence: f32) -> Found {
        let joint = Joint {
            at_px: [x, 500.0],
            visibility: 1.0,
            presence: 1.0,
        };
        Found {
            score,
            presence,
            head_px: [0.0; 4],
            crop: Crop {
                centre_px: [x, 500.0],
                side_px: side,
                angle: 0.0,
            },
            body: Image::filled(0, 0, 0),
            joints: vec![joint; 33],
        }
    }

    fn turn(of: impl Fn(u32) -> Vec<Found>) -> ByPhoto<Vec<Found>> {
        (0..12).map(|i| (PhotoId(i), of(i))).collect()
    }

    #[test]
    fn the_one_on_the_axis_is_followed_past_a_surer_bystander() {
        let views = turn(|i| match i {
            3 | 4 => vec![
                found(900.0 + i as f32, 700.0, 0.99, 0.99),
                found(402.0, 810.0, 0.8, 0.9),
            ],
            _ => vec![found(400.0 + i as f32, 800.0, 0.9, 0.99)],
        });
        let (views, person) = followed(views);
        assert!(person);
        assert!(views.values().all(|f| f[0].crop.centre_px[0] < 420.0));
        assert_eq!(views.get(PhotoId(3)).unwrap().len(), 2);
    }

    #[test]
    fn what_is_seen_here_and_there_is_no_person() {
        let jumps = turn(|i| vec![found(100.0 * (i % 5) as f32, 300.0, 0.9, 0.9)]);
        assert!(!followed(jumps).1);
        let seldom = turn(|i| match i % 2 {
            0 => vec![found(400.0, 800.0, 0.9, 0.99)],
            _ => vec![],
        });
        assert!(!followed(seldom).1);
        let unsure = turn(|_| vec![found(400.0, 800.0, 0.9, 0.2)]);
        assert!(!followed(unsure).1);
        assert!(!followed(ByPhoto::default()).1);
    }
}
