//! What does not show of a body, told by what does: the hip where thighs touch or a skirt hides the crotch, and
//! whether it is a whole body at all.

use crate::features::body::{Body, HipAt};
use crate::features::marks::farthest_back;
use crate::features::readings::{Reading, by_neck, size};
use crate::model::file::LevelModel;
use crate::model::predict::SIZES;

/// Tells the hip where no crotch shows, or one so low that thighs touch below the true one: in 99 of 100 people of
/// that stature the buttocks lie no higher than a crotch leaves them. The body is whole where stature, neck and
/// buttocks are those of one that the model knows: one that is cut off has its neck too low.
///
/// `absolute` says that its lengths are millimetres, `stands` that it stands on its ground.
pub(crate) fn tell_hip(body: &mut Body, model: &LevelModel, absolute: bool, stands: bool) {
    let size = size(body, absolute);
    let Some(told) = model.hidden(&size, body.stature, Reading::Buttock) else {
        return;
    };
    let (z, usual) = (body.ground + told.height_mm, model.usual() * told.sigma_mm);
    if matches!(body.about_crotch(), Some(HipAt::Between(_, high)) if high >= z + usual) {
        return;
    }
    let (low, high) = (z - SIZES * told.sigma_mm, z + SIZES * told.sigma_mm);
    let shows = farthest_back(body, low, high).and_then(|(z, is)| is.then_some(z));
    let share = shows.map(|z| (z - body.ground) / body.stature);
    let read = by_neck(body, absolute).map(|read| read.with(Reading::Buttock, share));
    body.whole = stands && read.is_some_and(|read| model.knows(&read));
    body.hip = body.whole.then_some(match shows {
        Some(_) => HipAt::Between(low, high),
        None => HipAt::Hidden(z, told.sigma_mm),
    });
}
