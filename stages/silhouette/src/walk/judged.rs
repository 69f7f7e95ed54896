//! Whether the masks of a walk are to be believed: warnings, or a refusal.

use crate::walk::doubt::{alike, middle, over_border, reported};
use crate::walk::features::Spot;
use crate::walk::find::Subject;
use crate::walk::floor_cut::FloorCut;
use crate::walk::params::{WalkCutError, WalkParams};
use crate::walk::space::Scene;
use shape::{Image, Photos};
use stage::{Message, message};

stage::messages! {
    LACKING = "warn-amid": "{share:.0 %} of the features amid the cameras are in no outline: is a part of the subject lacking, or is something beside it? look at the masks (`tailor show masks --as sheet`)";
    BORDER_CUT = "warn-border": "the subject runs over the border of {names}: what is cut off is lacking";
    SAME_COLOURS = "warn-same-colours": "subject and background have nearly the same colours there; look at the masks (`tailor show masks --as sheet`)";
    ODD_OUTLINE = "warn-unlike": "the outline is not what the other photos show; look at the masks (`tailor show masks --as sheet`)";
    BOTTOM = "warn-bottom": "what is under the subject is taken for part of it, down to {height:.0 mm}, where photos begin to cut it off; give its lower end (`--set masks.bottom_mm=…`, in the frame of the cameras)";
}

/// All that is judged; lists are by shot.
pub(crate) struct Judged<'a> {
    /// The photos.
    pub(crate) photos: &'a Photos,
    /// What was looked at.
    pub(crate) scene: &'a Scene<'a>,
    /// What was found.
    pub(crate) subject: &'a Subject,
    /// Where it ends below.
    pub(crate) cutter: &'a FloorCut,
    /// Outlines.
    pub(crate) sides: &'a [Image<bool>],
    /// What of the photos shows the subject above its end.
    pub(crate) standing: &'a [Image<bool>],
    /// What outlines share with those of the pass before.
    pub(crate) settled: &'a [f64],
}

/// A photo that is so much worse than is asked of the middle one is named.
/// By hand: looked at a walk (asclepius), at 0.7 and 1.4 of it: nothing changes.
const NAMED_BELOW: f64 = 0.1;
/// Share of a photo's border that a mask may touch.
/// By hand: looked at a walk (asclepius), at 0.7 and 1.4 of it: nothing changes.
const BORDER_SHARE: f64 = 0.002;
/// Names that are listed (structural).
const NAMES: usize = 6;

/// A warning comes at this part of what is refused.
/// By hand: looked at a walk (asclepius), at 0.7 and 1.4 of it: nothing changes.
const WARNED_PART: f64 = 3.0;

/// Share of the features amid the cameras, above the end, in whose photos the outlines
/// don't show them.
fn lacking(all: &Judged<'_>) -> f64 {
    let space = &all.scene.space;
    let is_subject = |s: &&Spot| space.amid(&s.at) && s.at.z > all.cutter.height;
    let shown = |(k, px): &(usize, [f64; 2])| {
        let (depth, px) = (&all.sides[*k], px.map(f64::round));
        let inside = px[0] >= 0.0 && px[1] >= 0.0;
        let (x, y) = (px[0] as usize, px[1] as usize);
        inside && x < depth.width && y < depth.height && depth.at(x, y)
    };
    let (mut count, mut lost) = (0usize, 0usize);
    for spot in all.scene.spots.iter().filter(is_subject) {
        count += 1;
        let seen = spot.sights.iter().filter(|s| shown(s)).count();
        lost += usize::from(2 * seen < spot.sights.len());
    }
    lost as f64 / count.max(1) as f64
}

/// What is measured of outlines; lists are by shot.
struct Measured {
    reported: Vec<f64>,
    agree: Vec<f64>,
    over: Vec<bool>,
    lacking: f64,
}

fn measured(all: &Judged<'_>) -> Measured {
    let Subject {
        block,
        solid,
        colors,
    } = all.subject;
    let shots = all.scene.shots;
    let kept = |k: usize| {
        let pairs = all.sides[k].data.iter().zip(&all.standing[k].data);
        Image {
            data: pairs.map(|(a, b)| *a && *b).collect(),
            ..all.sides[k]
        }
    };
    let agree = |k: usize| {
        let (w, h) = (shots[k].small.width, shots[k].small.height);
        let shown = block.shown(solid, &shots[k].camera, w, h);
        alike(&all.sides[k], &shown)
    };
    let every = 0..shots.len();
    Measured {
        reported: every
            .clone()
            .map(|k| reported(&shots[k], &all.sides[k], &colors[k]))
            .collect(),
        agree: every.clone().map(agree).collect(),
        over: every
            .map(|k| over_border(&kept(k)) > BORDER_SHARE)
            .collect(),
        lacking: lacking(all),
    }
}

/// What is reported of masks that are believed.
pub(crate) struct Judgement {
    /// Names and values. \[%\]
    pub(crate) metrics: [(&'static str, f64); 4],
    /// What is doubtful.
    pub(crate) warnings: Vec<Message>,
}

/// Whether the masks are to be believed.
///
/// # Errors
/// Where the masks would be a guess; the metrics are then in the error's words.
pub(crate) fn judged(p: &WalkParams, all: &Judged<'_>) -> Result<Judgement, WalkCutError> {
    let percent = |x: f64| 100.0 * x;
    let found = measured(all);
    let [reported, settled, agree] =
        [&found.reported[..], all.settled, &found.agree[..]].map(middle);
    let metrics = [
        ("right by colour", percent(reported)),
        ("settled", percent(settled)),
        ("agree", percent(agree)),
        ("features lacking", percent(found.lacking)),
    ];
    let asked = percent(p.least_agreement);
    if reported < p.least_by_color {
        return Err(WalkCutError::Alike(
            percent(reported),
            percent(p.least_by_color),
        ));
    }
    if settled < p.least_agreement {
        return Err(WalkCutError::Unsettled(percent(settled), asked));
    }
    if agree < p.least_agreement {
        return Err(WalkCutError::Contradict(percent(agree), asked));
    }
    if found.lacking > p.most_lacking {
        let most = percent(p.most_lacking);
        return Err(WalkCutError::Lacking(percent(found.lacking), most));
    }
    let cut_off: Vec<usize> = (0..found.over.len()).filter(|k| found.over[*k]).collect();
    if 2 * cut_off.len() > found.over.len() {
        let (count, of) = (cut_off.len(), found.over.len());
        return Err(WalkCutError::CutOff(count, of, names(all, &cut_off)));
    }
    let warnings = warnings(p, all, &found, &cut_off);
    Ok(Judgement { metrics, warnings })
}

/// Names of photos, the first few.
fn names(all: &Judged<'_>, which: &[usize]) -> String {
    let name = |k: &usize| {
        let photo = all.photos.get(all.scene.shots[*k].id);
        photo.map_or("", |p| p.name.as_str())
    };
    let list: Vec<&str> = which.iter().take(NAMES).map(name).collect();
    let more = if which.len() > NAMES { " …" } else { "" };
    format!("{}{more}", list.join(", "))
}

/// What is warned of though it is no reason to stop.
fn warnings(p: &WalkParams, all: &Judged<'_>, found: &Measured, cut_off: &[usize]) -> Vec<Message> {
    let mut warnings = vec![];
    if found.lacking > p.most_lacking / WARNED_PART {
        let share = 100.0 * found.lacking;
        warnings.push(message!(LACKING, share = share));
    }
    if !cut_off.is_empty() {
        let list = names(all, cut_off);
        warnings.push(message!(BORDER_CUT, names = list));
    }
    let which = |is: &dyn Fn(usize) -> bool| -> Vec<usize> {
        (0..found.reported.len()).filter(|k| is(*k)).collect()
    };
    let alike = which(&|k| found.reported[k] < p.least_by_color - NAMED_BELOW);
    if !alike.is_empty() {
        let list = names(all, &alike);
        warnings.push(message!(SAME_COLOURS).of_what(list));
    }
    let odd = which(&|k| found.agree[k].min(all.settled[k]) < p.least_agreement - NAMED_BELOW);
    if !odd.is_empty() {
        let list = names(all, &odd);
        warnings.push(message!(ODD_OUTLINE).of_what(list));
    }
    let (height, cell) = (all.cutter.height, all.subject.block.cell);
    let on_floor = all.scene.space.floor.is_some_and(|f| height <= f + cell);
    if !on_floor && height > p.bottom_mm {
        warnings.push(message!(BOTTOM, height = height));
    }
    warnings
}
