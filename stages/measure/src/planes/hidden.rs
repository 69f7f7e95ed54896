//! What does not show of a body, by what does: the hip where thighs touch or clothes hide the crotch, and whether it is a whole body
//! at all.

use crate::features::body::Body;
use crate::features::marks::farthest_back;
use crate::features::readings::{Reading, by_neck, size};
use crate::features::standing::Footing;
use crate::model::file::LevelModel;
use crate::model::predict::SIZES;
use shape::HipAt;

/// More likely whole than cut off (structural).
const EVEN: f64 = 0.5;

/// Finds the hip and whether the body is whole. Legs join at the crotch or below it: thighs that touch and clothes only lower that. So buttocks are
/// looked for from there up to where nobody of that stature has them. A body with legs is whole if its feet show, or its heights are more likely
/// those of a whole one than of one that is cut off; without legs if it reaches its ground and stature, neck and buttocks are those of a
/// body that the model knows.
///
/// `absolute` is whether its lengths are millimetres.
pub(crate) fn tell_hip(body: &mut Body, model: &LevelModel, absolute: bool, footing: Footing) {
    let size = size(body, absolute);
    let Some(usual) = model.hidden(&size, body.stature, Reading::Buttock) else {
        return;
    };
    let (z, far) = (body.ground + usual.height_mm, SIZES * usual.sigma_mm);
    let low = match body.about_crotch() {
        Some(HipAt::Between(low, _)) => low,
        _ => z - far,
    };
    let shows = farthest_back(body, low, z + far).and_then(|f| f.shows.then_some(f.z));
    let share = |z: f64| (z - body.ground) / body.stature;
    let read = by_neck(body, absolute).unwrap_or(size);
    let read = read.with(Reading::Buttock, shows.map(share));
    body.whole = match body.crotch {
        Some(crotch) => footing.feet || model.whole(&read, share(crotch)) > EVEN,
        None => footing.reaches_ground && body.neck.is_some() && model.knows(&read),
    };
    body.hip = body.whole.then_some(match shows {
        Some(_) => HipAt::Between(low, z + far),
        None => HipAt::Hidden(z, usual.sigma_mm),
    });
}
