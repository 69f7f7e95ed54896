//! The scene without its subject when nobody took a plate: out of all photos of the turn.

use crate::align::rectangle::Rectangle;
use crate::cut::least_cut::Known;
use crate::empty_scene::recurring::Recurring;
use crate::label::between_photos::Agreement;
use crate::label::color_cut::Settings;
use crate::label::color_cut::coarse;
use crate::raster::{as_mask, raster};

use crate::likelihood::body::{EVIDENT, STRANGE, body_cost};
use crate::likelihood::colors_beside::Nearby;
use crate::likelihood::disk_colors::{
    body_colors, colors_of, cost_elsewhere, disk_colors, mixture, on_the_disk,
};
use crate::likelihood::floor::Floor;
use crate::likelihood::gmm::Gmm;
use crate::likelihood::grain::missed;
use crate::likelihood::person::SURE;
use crate::likelihood::prepared::{Prepared, UNSEEN, prepare};
use crate::scene::backdrop::{Backdrop, differ};
use crate::scene::still_and_disk::{Scene, Shot, scene};
use rayon::prelude::*;
use shape::{Cameras, Image, Mask, PhotoId, Rgb, parts};

/// A part of the background that is seen amid the turn must be so large a share of the photo. By hand: looked at 0 in
/// its place (docs/lab/masks.md): mean IoU the same on three scenes, −0.11 on the mannequin.
const MIN_ISLAND_SHARE: f64 = 0.004;
/// Agreement of photos, each of which gives 1 at most, that makes a pixel the background's: as much as one other photo
/// gives at most, so that three photos agree (derived).
const MUST_AGREE: f32 = 1.0;
/// Agreement that suffices where the colour is none of the body's. By hand: looked at 1 in its place
/// (docs/lab/masks.md), no glimpses: mean IoU −0.0003 on eight scenes, their least photos −0.0014.
const MIN_AGREEMENT: f32 = 0.3;

/// Masks of reduced photos without a plate, true is body; `None` where a photo shows nothing that moves. `still` is what does
/// not change around the turn, `within` a rectangle that holds the body, and how many of its pixels became one; `people` the
/// log-odds of the body by a person's sense, photo by photo, or nothing. \[nats\]
pub fn without_plate(
    shots: &[Shot],
    still: &[bool],
    cameras: &Cameras,
    settings: &Settings,
    disk_side_mm: f64,
    within: Option<(Rectangle, usize)>,
    people: &[Vec<f32>],
) -> Vec<Option<Image<bool>>> {
    let radius = cameras.disk_radius_mm.unwrap_or(0.0);
    let smalls: Vec<Rgb> = shots.iter().map(|s| s.small.clone()).collect();
    let recurring = Recurring::of(&smalls);
    let mut backdrop = recurring.shown(None, MUST_AGREE);
    without_islands(&mut backdrop.seen);
    // What never changes may be the crown of a head, but then it is enclosed by what changes.
    let bare = still.iter().zip(&backdrop.seen.data);
    let turn = Turn {
        shots,
        cameras,
        settings,
        radius,
        disk_side_mm,
        within,
        people,
        bare: bare.map(|(still, seen)| *still && *seen).collect(),
    };
    let body = body_colors(shots, &backdrop, radius);
    if let Some(body) = &body {
        glimpsed(&mut backdrop, &recurring, &smalls, body, people);
        without_islands(&mut backdrop.seen);
    }
    let covered = on_the_disk(shots, &backdrop, body.as_ref(), radius);
    let mut ready = turn.ready(&backdrop, &covered);
    turn.together(&mut ready)
}

/// A turn whose photos are cut.
struct Turn<'a> {
    shots: &'a [Shot],
    cameras: &'a Cameras,
    settings: &'a Settings,
    radius: f64,
    disk_side_mm: f64,
    within: Option<(Rectangle, usize)>,
    /// Log-odds of the body by a person's sense, photo by photo; empty where nobody is seen.
    people: &'a [Vec<f32>],
    /// Pixels that are the background on all photos, or on all but one.
    bare: Vec<bool>,
}

impl Turn<'_> {
    /// The photos made ready: what each pixel costs as background, or by colours of the scene, beside it or elsewhere.
    fn ready(&self, backdrop: &Backdrop, covered: &[Image<bool>]) -> Vec<Prepared> {
        let (shots, radius) = (self.shots, self.radius);
        let around = scene(shots, backdrop.clone(), radius, covered);
        let of_disk = disk_colors(&around.disk, 0.0);
        let of_scene = colors_of(&around.still);
        let nearby = Nearby::of(&around.still);
        let mut ready: Vec<Prepared> = shots.par_iter().map(|s| self.one(s, &around)).collect();
        for (ready, person) in ready.iter_mut().zip(self.people) {
            ready.person.clone_from(person);
        }
        let evident = evident(shots, &ready, radius);
        missed(&mut ready, shots, &around, covered, evident.as_ref());
        shots.par_iter().zip(&mut ready).for_each(|(shot, ready)| {
            for i in 0..ready.cost.len() {
                if ready.cost[i] != UNSEEN {
                    continue;
                }
                let color = shot.small.data[i];
                if shot.shows_disk(i, radius) {
                    let as_disk = cost_elsewhere(of_disk.as_ref(), color);
                    ready.cost[i] = ready.cost[i].min(as_disk);
                } else {
                    let beside = nearby.cost(&shot.small, i).unwrap_or(UNSEEN);
                    let elsewhere = cost_elsewhere(of_scene.as_ref(), color);
                    ready.cost[i] = ready.cost[i].min(beside).min(elsewhere);
                }
            }
        });
        ready
    }

    /// One photo before the scene around, with what is certain of it.
    fn one(&self, shot: &Shot, around: &Scene) -> Prepared {
        let behind = around.behind(&shot.small, &shot.camera);
        let disk = (self.radius > 0.0).then(|| Floor::of_disk(shot.camera, self.radius));
        let mut ready = prepare(
            &shot.small,
            &behind,
            disk,
            usize::MAX,
            self.disk_side_mm,
            &|_, _| vec![],
        );
        if let Some((rectangle, factor)) = &self.within {
            rectangle.close(&mut ready.known, shot.small.width, *factor);
        }
        // The one photo that differs may show a hand that passes.
        let alike = |i: usize| !differ(shot.small.data[i], around.still.image.data[i]);
        for i in (0..ready.known.len()).filter(|i| self.bare[*i] && alike(*i)) {
            ready.known[i] = Known::Background;
        }
        ready
    }

    /// Each photo cut alone, then again by the evidence of all together.
    fn together(&self, ready: &mut [Prepared]) -> Vec<Option<Image<bool>>> {
        let cut = |ready: &Prepared| coarse(ready, self.settings).map(|(sides, _)| sides);
        let alone: Vec<Option<Image<bool>>> = ready.par_iter().map(cut).collect();
        let masks = self.shots.iter().zip(&alone);
        let masks: Vec<(PhotoId, Mask)> = masks
            .filter_map(|(shot, cut)| Some((shot.id, as_mask(cut.as_ref()?))))
            .collect();
        let agreement = Agreement::of(&masks, self.cameras);
        let again = ready.par_iter_mut().zip(self.shots);
        again
            .map(|(ready, shot)| {
                ready.add_odds(agreement.odds(shot.id));
                cut(ready)
            })
            .collect()
    }
}

/// The colours of what is evidently not the background, on all photos.
fn evident(shots: &[Shot], ready: &[Prepared], radius: f64) -> Option<Gmm> {
    let mut colors = Vec::new();
    for (shot, ready) in shots.iter().zip(ready) {
        let off = |i: &usize| ready.cost[*i] > EVIDENT && ready.known[*i] == Known::Unknown;
        let some = (0..ready.cost.len()).filter(off).step_by(7);
        let above = some.filter(|i| !shot.shows_disk(*i, radius));
        colors.extend(above.map(|i| shot.small.data[i]));
    }
    mixture(&colors)
}

/// Adds to the background what two photos suffice to show: that they have the same to the level, in a
/// colour that the body has not. Where a learned sense is sure of the body two do not suffice: a plain garment, near
/// the axis, is alike on both.
fn glimpsed(
    backdrop: &mut Backdrop,
    recurring: &Recurring<'_>,
    smalls: &[Rgb],
    body: &Gmm,
    people: &[Vec<f32>],
) {
    let hidden: Vec<Image<bool>> = smalls
        .par_iter()
        .enumerate()
        .map(|(k, small)| {
            let person = people.get(k).map_or(&[][..], Vec::as_slice);
            let hides = |(i, color)| {
                let sure = person.get(i).is_some_and(|odds| *odds > SURE);
                sure || body_cost(body, color) < STRANGE
            };
            let data = small.data.iter().copied().enumerate().map(hides);
            raster(small.width, small.height, data.collect())
        })
        .collect();
    let more = recurring.shown(Some(&hidden), MIN_AGREEMENT);
    for i in 0..backdrop.seen.data.len() {
        if !backdrop.seen.data[i] && more.seen.data[i] {
            backdrop.seen.data[i] = true;
            backdrop.image.data[i] = more.image.data[i];
        }
    }
}

/// Drops small parts of what is seen.
fn without_islands(seen: &mut Image<bool>) {
    let least = (seen.data.len() as f64 * MIN_ISLAND_SHARE) as usize;
    let (of, sizes) = parts(seen, true);
    for (seen, of) in seen.data.iter_mut().zip(&of.data) {
        *seen &= *of != u32::MAX && sizes[*of as usize] >= least;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIDE: usize = 40;

    fn amid(i: usize) -> bool {
        (14..26).contains(&(i % SIDE)) && (14..26).contains(&(i / SIDE))
    }

    /// Whether the middle of six photos is glimpsed, where the first two show the same blue and the rest a body that turns.
    fn sees(people: &[Vec<f32>]) -> bool {
        let mut dice = proof::Dice(3);
        let mut noisy = |color: [f64; 3]| color.map(|v| (v + dice.normal()).round() as u8);
        let mut photo = |k: usize| {
            let skin = [200.0 - 8.0 * k as f64, 150.0, 120.0];
            let amid_all = if k < 2 { [90.0, 120.0, 180.0] } else { skin };
            let all = (0..SIDE * SIDE).map(|i| noisy(if amid(i) { amid_all } else { [150.0; 3] }));
            raster(SIDE, SIDE, all.collect())
        };
        let photos: Vec<Rgb> = (0..6).map(&mut photo).collect();
        let of_body = photos[2..].iter().flat_map(|p| p.data.iter().enumerate());
        let of_body = of_body.filter(|(i, _)| amid(*i)).map(|(_, color)| *color);
        let body = Gmm::fit(&of_body.collect::<Vec<_>>(), 2).expect("clusters");
        let mut backdrop = Backdrop {
            image: Rgb::filled(SIDE, SIDE, [0; 3]),
            seen: Image::filled(SIDE, SIDE, false),
        };
        glimpsed(
            &mut backdrop,
            &Recurring::of(&photos),
            &photos,
            &body,
            people,
        );
        backdrop.seen.at(20, 20)
    }

    #[test]
    fn what_two_photos_share_is_background_unless_a_person_is_seen_there() {
        let person = |odds: f32| {
            let one = (0..SIDE * SIDE).map(|i| if amid(i) { odds } else { -6.0 });
            vec![one.collect::<Vec<f32>>(); 6]
        };
        assert!(sees(&[]) && sees(&person(1.0)));
        assert!(!sees(&person(4.7)));
    }
}
