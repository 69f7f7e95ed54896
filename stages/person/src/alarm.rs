//! The stage that holds masks against where a person was seen.

use crate::regions::{Disagreement, disagreement};
use rayon::prelude::*;
use shape::{BodyPart, LostParts, MaskRuns, Masks, People, PhotoId, Photos, some_photos};
use stage::{Ctx, Message, Stage, Stop, Template, message};
use std::sync::Arc;

stage::messages! {
    LOST_HEAD = "warn-lost-head": "masks leave out the head or a part of it on {names}, where a learned sense of a person sees it: look at these masks";
    LOST_TRUNK = "warn-lost-trunk": "masks leave out a part of the trunk on {names}, where a learned sense of a person sees it: look at these masks";
    LOST_ARM = "warn-lost-arm": "masks leave out an arm or a part of it on {names}, where a learned sense of a person sees it: look at these masks";
    LOST_LEG = "warn-lost-leg": "masks leave out a leg or a part of it on {names}, where a learned sense of a person sees it: look at these masks";
    ADDED = "warn-kept-body": "masks have body on {names} where a learned sense of a person sees none: look at these masks";
}

stage::params! {
    /// How wide a piece of a part of the body a mask may leave out that the network is sure of, in its own pixels (some 7 mm of an
    /// adult). Fitted by `models/person/alarm.py` on true masks of six captures and the same without a limb.
    pub struct AlarmParams {
        /// Head.
        #[range(0.0..=256.0)]
        #[source(fitted = "models/person/alarm.py: true masks of six captures, and the same without a limb")]
        head_px: f64 = 10.9,
        /// Trunk.
        #[range(0.0..=256.0)]
        #[source(fitted = "models/person/alarm.py: true masks of six captures, and the same without a limb")]
        trunk_px: f64 = 8.2,
        /// Arms.
        #[range(0.0..=256.0)]
        #[source(fitted = "models/person/alarm.py: true masks of six captures, and the same without a limb")]
        arms_px: f64 = 6.0,
        /// Legs.
        #[range(0.0..=256.0)]
        #[source(fitted = "models/person/alarm.py: true masks of six captures, and the same without a limb")]
        legs_px: f64 = 6.3,
        /// How much body a mask may have beside a part of the learned one, as a share of it. By hand: true masks of ten
        /// captures have at most 12 %.
        #[range(0.0..=100.0)]
        #[source(by_hand = "true masks of ten captures: at most 12 %")]
        added_pct: f64 = 25.0,
    }
}

impl AlarmParams {
    /// By part, how wide a piece may be left out \[pixels of the network\], and what names it; a foot alone is below its sight.
    fn bounds(&self) -> [(BodyPart, f64, Template); 4] {
        [
            (BodyPart::Head, self.head_px, LOST_HEAD),
            (BodyPart::Trunk, self.trunk_px, LOST_TRUNK),
            (BodyPart::Arms, self.arms_px, LOST_ARM),
            (BodyPart::Legs, self.legs_px, LOST_LEG),
        ]
    }
}

stage::inputs! {
    /// Masks, and who is on the photos.
    pub struct AlarmInput {
        /// The masks.
        masks: Arc<Masks>,
        /// Who is on the photos.
        people: Arc<People>,
        /// The photos, for their names.
        photos: Arc<Photos>,
    }
}

/// `silhouette.alarm`: masks, people, photos → lost parts; warns where masks and people contradict each other.
pub struct Alarm;

impl Stage for Alarm {
    const NAME: &'static str = "silhouette.alarm";
    const VERSION: u32 = 4;
    const ABOUT: &'static str = "Finds masks that leave out or add a part of the body where a learned sense of a person sees otherwise, and warns of them by photo and part; of a thing it finds nothing.";
    type Params = AlarmParams;
    type Input = AlarmInput;
    type Output = LostParts;

    fn run(p: &AlarmParams, input: AlarmInput, ctx: &Ctx<'_>) -> Result<LostParts, Stop> {
        let views = input.masks.views.as_slice();
        let one = |(id, mask): &(PhotoId, MaskRuns)| {
            let found = input.people.subject(*id)?;
            Some((*id, disagreement(found, &mask.pixels())))
        };
        let seen: Vec<_> = views.par_iter().filter_map(one).collect();
        ctx.check()?;
        let photos = |odd: &dyn Fn(&[Disagreement; 5]) -> bool| -> Vec<PhotoId> {
            let of = seen.iter().filter(|(_, all)| odd(all));
            of.map(|(id, _)| *id).collect()
        };
        let mut lost: [Vec<PhotoId>; 5] = Default::default();
        for (part, most, _) in p.bounds() {
            lost[part as usize] = photos(&|all| all[part as usize].lost_px > most);
        }
        let added = photos(&|all| all.iter().any(|d| 100.0 * d.kept > p.added_pct));
        let parts = LostParts {
            photos: seen.len() as u32,
            lost,
            added,
        };
        let names = |ids: &[PhotoId]| {
            let of = ids.iter().filter_map(|id| input.photos.get(*id));
            some_photos(&of.map(|photo| photo.name.clone()).collect::<Vec<_>>())
        };
        for (part, _, left_out) in p.bounds() {
            if let Some(names) = names(parts.of(part)) {
                ctx.warn(Message::new(&left_out, [("names", names)]));
            }
        }
        if let Some(names) = names(&parts.added) {
            ctx.warn(message!(ADDED, names = names));
        }
        Ok(parts)
    }
}
