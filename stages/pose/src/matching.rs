//! Features of two photos that look alike, each other's nearest, well ahead of the next.

use shape::{Features, Keypoint};

/// Pairs of features: places in the two lists.
pub type Pairs = Vec<(u32, u32)>;

fn likeness(a: &[u8; 128], b: &[u8; 128]) -> i32 {
    a.iter()
        .zip(b)
        .map(|(x, y)| i32::from(*x) * i32::from(*y))
        .sum()
}

/// For each feature of `a` its nearest of `b` if it is nearer than `ratio` times the next one that
/// lies elsewhere. Candidates lie within `rise_px` of the feature's row and have a like scale.
fn nearest(a: &Features, b: &Features, ratio: f64, rise_px: f32) -> Vec<Option<u32>> {
    let mut rows: Vec<u32> = (0..b.points.len() as u32).collect();
    rows.sort_by(|p, q| {
        b.points[*p as usize]
            .y
            .total_cmp(&b.points[*q as usize].y)
            .then(p.cmp(q))
    });
    let heights: Vec<f32> = rows.iter().map(|i| b.points[*i as usize].y).collect();
    // Descriptors have length 512, so the squared distance is 2 (512² - likeness).
    let distance = |likeness: i32| f64::from(2 * (512 * 512 - likeness).max(0)).sqrt();
    let one = |(k, d): (&Keypoint, &[u8; 128])| {
        let low = heights.partition_point(|y| *y < k.y - rise_px);
        let high = heights.partition_point(|y| *y <= k.y + rise_px);
        let (mut first, mut second) = ((i32::MIN, u32::MAX), i32::MIN);
        for i in &rows[low..high] {
            let other = &b.points[*i as usize];
            if !(0.4..2.5).contains(&(other.scale / k.scale)) {
                continue;
            }
            let alike = likeness(d, &b.descriptors[*i as usize]);
            if alike > first.0 {
                let same = first.1 != u32::MAX && {
                    let f = &b.points[first.1 as usize];
                    (f.x - other.x).hypot(f.y - other.y) < 2.0
                };
                if !same {
                    second = first.0;
                }
                first = (alike, *i);
            } else if alike > second {
                let f = &b.points[first.1 as usize];
                if (f.x - other.x).hypot(f.y - other.y) >= 2.0 {
                    second = alike;
                }
            }
        }
        let ahead = second == i32::MIN || distance(first.0) < ratio * distance(second);
        (first.1 != u32::MAX && ahead).then_some(first.1)
    };
    a.points.iter().zip(&a.descriptors).map(one).collect()
}

/// Pairs that are each other's nearest.
pub fn mutual(a: &Features, b: &Features, ratio: f64, rise_px: f32) -> Pairs {
    let (ab, ba) = (nearest(a, b, ratio, rise_px), nearest(b, a, 1.0, rise_px));
    let pair = |(i, j): (usize, &Option<u32>)| {
        let j = (*j)?;
        (ba[j as usize] == Some(i as u32)).then_some((i as u32, j))
    };
    ab.iter().enumerate().filter_map(pair).collect()
}
