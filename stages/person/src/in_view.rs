//! The stage that stops a turn of whom nothing will come: most photos cut off the feet.

use shape::{People, Photos, some_photos};
use stage::{Ctx, Message, Stage, Stop, message};
use std::sync::Arc;

stage::messages! {
    WITHOUT_FEET = "people-without-feet": "the body is cut off at the lower edge of {names}; keep the whole person in view, with a margin below the feet: without feet heights are unknown, and no girth is given";
}

stage::failures! {
    /// Why the people on the photos cannot be measured.
    pub enum InViewError {
        /// Nothing will come of them.
        Hopeless(why: Message) = "fail-in-view": "{why} (if you are sure of the photos: --set in_view.stop=false)",
    }
}

stage::params! {
    /// What is done about people who cannot be measured.
    pub struct InViewParams {
        /// Whether feet that most photos cut off are an error.
        stop: bool = true,
    }
}

stage::inputs! {
    /// Who is on the photos.
    pub struct InViewInput {
        /// Who is on the photos.
        people: Arc<People>,
        /// The photos, for their names and sizes.
        photos: Arc<Photos>,
    }
}

/// `silhouette.in_view`: people, photos → the same people.
pub struct InView;

impl Stage for InView {
    const NAME: &'static str = "silhouette.in_view";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "Stops a turn on which most photos cut off the feet, for heights are unknown then; else the people stay as they are.";
    type Params = InViewParams;
    type Input = InViewInput;
    type Output = People;

    fn run(p: &InViewParams, input: InViewInput, _: &Ctx<'_>) -> Result<People, Stop> {
        let cut = input.people.without_feet(&input.photos);
        match cut.and_then(|names| some_photos(&names)) {
            Some(names) if p.stop => {
                let why = message!(WITHOUT_FEET, names = names);
                Err(InViewError::Hopeless(why).into())
            }
            _ => Ok(People::clone(&input.people)),
        }
    }
}
