//! Shadows that a lamp or a flash casts on walls, measured where surely nobody is: how often, and how dark.

use crate::likelihood::grounds::{DARKEST_LIGHTS, Ground};
use crate::likelihood::neighbourhoods::{mean, places};
use crate::likelihood::noise::{Cast, Noise};
use crate::likelihood::person::surely_nobody;
use shape::Rgb;

/// A colour in another light is the wall's within so many standard deviations (derived: 0.3 % of a normal distribution is
/// beyond).
pub(crate) const SAME_SIGMAS: f32 = 3.0;
/// Fewer neighbourhoods show nothing of a distribution (structural: samples).
pub(crate) const FEW: usize = 40;

impl Cast {
    /// Of a photo before what is expected of it, where the network is sure that a pixel is no person's: `odds` are its
    /// log-odds, row by row. `None` where it shows no such shadows, or nobody.
    pub(crate) fn measure(
        [photo, expected]: [&Rgb; 2],
        ground: &dyn Fn(usize, usize) -> Ground,
        odds: &[f32],
        noise: &Noise,
        reach: usize,
    ) -> Option<Cast> {
        let sure = |(x, y): &(usize, usize)| {
            surely_nobody(odds, y * photo.width + x) && ground(*x, *y) == Ground::Wall
        };
        let walls: Vec<(usize, usize)> = places(photo, reach).filter(sure).collect();
        let mut lights: Vec<f32> = walls
            .iter()
            .filter_map(|(x, y)| shaded([photo, expected], *x, *y, noise, reach))
            .collect();
        lights.sort_by(f32::total_cmp);
        let darkest = *lights.get(lights.len() / 100)?;
        let share = lights.len() as f32 / walls.len() as f32;
        (lights.len() >= FEW).then_some(Cast { share, darkest })
    }
}

/// The light of a neighbourhood that is darker than what a subject nearby makes of a wall.
fn shaded(both: [&Rgb; 2], x: usize, y: usize, noise: &Noise, reach: usize) -> Option<f32> {
    let change = Change::at(both, x, y, reach);
    let alike = change.other < SAME_SIGMAS * noise.bounced(Ground::Wall);
    (alike && change.light < DARKEST_LIGHTS[Ground::Wall as usize]).then_some(change.light)
}

/// How a photo's neighbourhood differs from what is expected of it.
pub(crate) struct Change {
    /// How many times as bright it is.
    pub(crate) light: f32,
    /// All that it differs by. \[levels\]
    pub(crate) all: f32,
    /// What is left where it is as bright. \[levels\]
    pub(crate) other: f32,
}

impl Change {
    /// Of the neighbourhood about a pixel.
    pub(crate) fn at([photo, expected]: [&Rgb; 2], x: usize, y: usize, reach: usize) -> Self {
        let [p, e] = [photo, expected].map(|image| mean(image, x, y, reach));
        let bright = |c: [f32; 3]| c.iter().sum::<f32>() + 3.0;
        let light = bright(p) / bright(e);
        let off = |times: f32| {
            let squares = (0..3).map(|c| (p[c] - times * e[c]).powi(2));
            squares.sum::<f32>().sqrt()
        };
        Change {
            light,
            all: off(1.0),
            other: off(light),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::likelihood::background::background_cost;
    use crate::likelihood::noise::FLAT;

    /// A wall, and a photo of it whose columns 10 to 29 are in another light of each channel.
    fn wall(light: [f32; 3]) -> [Rgb; 2] {
        let mut expected = Rgb::filled(120, 90, [0; 3]);
        for (i, p) in expected.data.iter_mut().enumerate() {
            let (x, y) = ((i % 120) as u8, (i / 120) as u8);
            *p = [120 + x % 11, 140 + y % 7, 90 + (x + y) % 5];
        }
        let mut photo = expected.clone();
        for (i, p) in photo.data.iter_mut().enumerate() {
            if (10..30).contains(&(i % 120)) {
                (0..3).for_each(|c| p[c] = (f32::from(p[c]) * light[c]).round() as u8);
            }
        }
        [photo, expected]
    }

    fn seen([photo, expected]: &[Rgb; 2], odds: f32) -> Option<Cast> {
        let odds = vec![odds; photo.data.len()];
        let on = |_: usize, _: usize| Ground::Wall;
        Cast::measure([photo, expected], &on, &odds, &Noise::even(2.0), 1)
    }

    #[test]
    fn shadows_are_measured_where_surely_nobody_is() {
        let shadow = wall([0.5; 3]);
        let cast = seen(&shadow, -5.0).unwrap();
        assert!((cast.share - 1.0 / 6.0).abs() < 0.02, "{cast:?}");
        assert!((cast.darkest - 0.5).abs() < 0.02, "{cast:?}");
        assert_eq!(seen(&shadow, -1.0), None, "a person may be there");
        assert_eq!(seen(&wall([0.95; 3]), -5.0), None, "a little darker");
        assert_eq!(seen(&wall([0.5, 0.5, 0.9]), -5.0), None, "another colour");
    }

    #[test]
    fn where_shadows_are_cast_a_darker_wall_is_still_the_wall() {
        let [photo, expected] = wall([0.5; 3]);
        let cost = |cast: Option<Cast>| {
            let noise = Noise {
                cast,
                ..Noise::even(2.0)
            };
            let on = |_: usize, _: usize| Ground::Wall;
            background_cost(&photo, &expected, noise, &on, 1, [15, 20, 10, 10])
        };
        let cast = seen(&[photo.clone(), expected.clone()], -5.0);
        let with = cost(cast).into_iter().fold(0.0, f32::max);
        let without = cost(None).into_iter().fold(f32::MAX, f32::min);
        assert!(
            with < FLAT + 5.0 && without > FLAT + 15.0,
            "{with} {without}"
        );
    }
}
