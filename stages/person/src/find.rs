//! The stage that finds people on photos.

use crate::body::Networks;
use crate::odd::odd;
use crate::turn::followed;
use rayon::prelude::*;
use shape::{Found, People, Photo, PhotoId, Photos};
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
    const VERSION: u32 = 2;
    const ABOUT: &'static str = "Finds the person on each photo by two learned networks: a coarse mask and joints, and whether the photos agree that it is a person.";
    type Params = FindPeopleParams;
    type Input = FindPeopleInput;
    type Output = People;

    fn run(_: &FindPeopleParams, input: FindPeopleInput, ctx: &Ctx<'_>) -> Result<People, Stop> {
        let networks = Networks::built_in()?;
        let all: Vec<(PhotoId, &Photo)> = input.photos.iter().collect();
        let steps = ctx.steps("photos", all.len());
        let one = |(id, photo): &(PhotoId, &Photo)| -> Result<(PhotoId, Vec<Found>), Stop> {
            let only: People = ctx.part("photo", &[photo.content()], || {
                let found = networks.people(&photo.decode()?);
                Ok(People {
                    views: [(PhotoId(0), found)].into_iter().collect(),
                    person: false,
                })
            })?;
            steps.tick()?;
            Ok((*id, only.views.get(PhotoId(0)).cloned().unwrap_or_default()))
        };
        let views = all.par_iter().map(one).collect::<Result<Vec<_>, Stop>>()?;
        let all = followed(views.into_iter().collect());
        // Of things nothing is said: most captures of them are meant.
        if all.person {
            let reported = odd(&all, &input.photos);
            reported.into_iter().for_each(|w| ctx.warn(w));
        }
        let (views, person) = (all.views, all.person);
        Ok(People { views, person })
    }
}
