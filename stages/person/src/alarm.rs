//! The stage that holds masks against where a person was seen.

use crate::odd::some;
use crate::regions::{Disagreement, Region, disagreement};
use rayon::prelude::*;
use shape::{Masks, People, PhotoId, Photos};
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;

stage::params! {
    /// When masks are warned of.
    pub struct AlarmParams {
        /// How much of a region of the body a mask may lose or add beyond the learned mask's own width. By hand, above
        /// what 92 true masks of five captures do: at most 9 % in all regions but one pair of feet, which has 20 %.
        #[range(0.0..=100.0)]
        most_pct: f64 = 25.0,
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

/// `silhouette.alarm`: masks, people, photos → masks, unchanged; warns where they contradict each other.
pub struct Alarm;

impl Stage for Alarm {
    const NAME: &'static str = "silhouette.alarm";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "Warns of masks that leave out or add a part of the body where a learned sense of a person sees otherwise; hands them on unchanged.";
    type Params = AlarmParams;
    type Input = AlarmInput;
    type Output = Masks;

    fn run(p: &AlarmParams, input: AlarmInput, ctx: &Ctx<'_>) -> Result<Masks, Stop> {
        let views = input.masks.views.as_slice();
        let one = |(id, mask): &(PhotoId, shape::Mask)| {
            let found = input.people.subject(*id)?;
            Some((*id, disagreement(found, mask)))
        };
        let seen: Vec<_> = views.par_iter().filter_map(one).collect();
        ctx.check()?;
        let most = p.most_pct / 100.0;
        let names = |odd: &dyn Fn(&[Disagreement; 5]) -> bool| {
            let of = seen.iter().filter(|(_, all)| odd(all));
            let of = of.filter_map(|(id, _)| input.photos.get(*id));
            some(of.map(|photo| photo.name.clone()).collect())
        };
        for region in Region::ALL {
            if let Some(names) = names(&|all| all[region as usize].lost > most) {
                ctx.warn(lost(region, &names));
            }
        }
        if let Some(names) = names(&|all| all.iter().any(|d| d.kept > most)) {
            ctx.warn(format!("masks have body on {names} where a learned sense of a person sees none: look at these masks"));
        }
        Ok(Masks::clone(&input.masks))
    }
}

/// What is said of a region that masks leave out.
fn lost(region: Region, names: &str) -> String {
    let mut told = Vec::with_capacity(1);
    match region {
        Region::Head => told.push(format!("masks leave out the head or a part of it on {names}, where a learned sense of a person sees it: look at these masks")),
        Region::Trunk => told.push(format!("masks leave out a part of the trunk on {names}, where a learned sense of a person sees it: look at these masks")),
        Region::Arms => told.push(format!("masks leave out an arm or a part of it on {names}, where a learned sense of a person sees it: look at these masks")),
        Region::Legs => told.push(format!("masks leave out a leg or a part of it on {names}, where a learned sense of a person sees it: look at these masks")),
        Region::Feet => told.push(format!("masks leave out a foot or a part of it on {names}, where a learned sense of a person sees it: look at these masks")),
    }
    told.concat()
}
