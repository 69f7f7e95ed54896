//! The stage that finds people on photos.

use crate::body::Networks;
use crate::odd::odd;
use crate::turn::{NotFound, followed, not_found};
use rayon::prelude::*;
use shape::{Found, LOOKED_AT_MPX, People, Photo, PhotoId, Photos};
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;

stage::params! {
    /// Nothing is to be tuned.
    pub struct FindPeopleParams {}
}

stage::inputs! {
    /// What people are looked for on.
    pub struct FindPeopleInput {
        /// The photos.
        photos: Arc<Photos>,
    }
}

/// `silhouette.person`: photos → people.
pub struct FindPeople;

impl Stage for FindPeople {
    const NAME: &'static str = "silhouette.person";
    const VERSION: u32 = 6;
    const ABOUT: &'static str = "Finds the person on each photo by two learned networks: a coarse mask and joints, and whether the photos agree that it is a person.";
    type Params = FindPeopleParams;
    type Input = FindPeopleInput;
    type Output = People;

    fn run(_: &FindPeopleParams, input: FindPeopleInput, ctx: &Ctx<'_>) -> Result<People, Stop> {
        let networks = Networks::built_in()?;
        let smaller = input.photos.within(LOOKED_AT_MPX);
        let all: Vec<(PhotoId, &Photo)> = smaller.iter().collect();
        let steps = ctx.steps("photos", all.len());
        let one = |(id, photo): &(PhotoId, &Photo)| -> Result<(PhotoId, Vec<Found>), Stop> {
            let only: People = ctx.part("photo", &[photo.content()], || {
                Ok(of_one_photo(networks.people(&photo.decode()?)))
            })?;
            steps.tick()?;
            Ok((*id, only.views.get(PhotoId(0)).cloned().unwrap_or_default()))
        };
        let mut views = all.par_iter().map(one).collect::<Result<Vec<_>, Stop>>()?;
        // Where the first network finds nobody like the one on most photos, the second looks where that one is on these.
        if let Some(missing) = not_found(&views) {
            for (k, found) in looked_for(&networks, &missing, &all, ctx)? {
                views[k].1 = found;
            }
        }
        let all = followed(views.into_iter().collect());
        // Things are not reported: most captures of them are meant.
        if all.person {
            let reported = odd(&all, &smaller);
            reported.into_iter().for_each(|w| ctx.warn(w));
        }
        let (views, person) = (all.views, all.person);
        Ok(People { views, person }.of_photos(&smaller, &input.photos))
    }
}

/// Everybody on photos that show the one who turns, though that one was not found on them; by the photos' places.
fn looked_for(
    networks: &Networks,
    missing: &NotFound,
    all: &[(PhotoId, &Photo)],
    ctx: &Ctx<'_>,
) -> Result<Vec<(usize, Vec<Found>)>, Stop> {
    let NotFound { photos, square } = missing;
    let one = |(k, presence): &(usize, f32)| -> Result<Option<(usize, Vec<Found>)>, Stop> {
        let photo = all[*k].1;
        let place = stage::hash(format!("{square:?} {presence:?}").as_bytes());
        let only: People = ctx.part("photo again", &[photo.content(), place], || {
            let found = networks.people_with(&photo.decode()?, square, *presence);
            Ok(of_one_photo(found.unwrap_or_default()))
        })?;
        let found = only.views.get(PhotoId(0)).cloned().unwrap_or_default();
        Ok((!found.is_empty()).then_some((*k, found)))
    };
    let found = photos.par_iter().map(one);
    Ok(found
        .collect::<Result<Vec<_>, Stop>>()?
        .into_iter()
        .flatten()
        .collect())
}

/// What a part can be.
fn of_one_photo(found: Vec<Found>) -> People {
    People {
        views: [(PhotoId(0), found)].into_iter().collect(),
        person: false,
    }
}
