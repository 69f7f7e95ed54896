//! What stands still before the camera: the plate, or the median over photos of the turn.

use shape::Gray;

/// Grey reduced by a whole factor, means of blocks.
pub(crate) fn reduced(gray: &Gray, by: usize) -> Gray {
    let (width, height) = (gray.width / by, gray.height / by);
    let mut small = Gray::filled(width, height, 0.0);
    for y in 0..height {
        for x in 0..width {
            let mut sum = 0.0;
            for dy in 0..by {
                let row = gray.row(y * by + dy);
                sum += row[x * by..(x + 1) * by].iter().sum::<f32>();
            }
            *small.at_mut(x, y) = sum / (by * by) as f32;
        }
    }
    small
}

/// The median of each pixel over pictures of one size; `None` without pictures.
pub(crate) fn median(pictures: &[Gray]) -> Option<Gray> {
    let first = pictures.first()?;
    let mut out = first.clone();
    let mut all = vec![0.0; pictures.len()];
    for (i, value) in out.data.iter_mut().enumerate() {
        for (a, p) in all.iter_mut().zip(pictures) {
            *a = p.data[i];
        }
        all.sort_by(f32::total_cmp);
        *value = all[all.len() / 2];
    }
    Some(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_passes_by_is_not_in_the_median() {
        let pictures: Vec<Gray> = (0..5)
            .map(|i| {
                let mut g = Gray::filled(8, 8, 10.0);
                *g.at_mut(i, 3) = 200.0;
                g
            })
            .collect();
        assert_eq!(median(&pictures).unwrap(), Gray::filled(8, 8, 10.0));
        assert_eq!(reduced(&pictures[0], 2).at(0, 1), 57.5);
    }
}
