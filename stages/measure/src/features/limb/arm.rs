//! Joints of an arm along its line: wrist, elbow, and where the acromion is.

use crate::features::limb::bend::{Line, Told, bend, line, places};
use crate::features::limb::cuts::Cuts;
use crate::features::limb::follow::Knot;
use crate::features::limb::{Joint, Limb};
use nalgebra::Vector3;

/// Acromion to radiale against acromion to stylion of 6068 men and women (ANSUR II, 2012): means of
/// men and women, and a standard deviation that holds for both.
const RATIO: (f64, f64) = (0.560, 0.0115);
/// Acromion to stylion, as a share of stature; of the same people, and three times as wide: bodies from
/// elsewhere have shorter arms.
const LONG: (f64, f64) = (0.341, 0.030);
/// From the armpit up to the acromion along an arm that is raised straight aside, and what a hanging one
/// adds to that; their standard deviation. Shares of stature: hanging, 0.061 ± 0.007 of those people.
const ARMPIT: (f64, f64, f64) = (0.030, 0.025, 0.010);

/// Who is smaller than this has a child's limbs, or a mannequin's, of which the survey tells less; how
/// much less for each millimetre. \[mm\]
const GROWN: f64 = 1450.0;
const CHILD: f64 = 0.1;
/// How sure a wrist is by its narrowest girth, as a share of stature.
const WRIST: f64 = 0.006;
/// A bend of so much tells of the elbow. \[rad\]
const BENT: f64 = 15.0 * std::f64::consts::PI / 180.0;
/// A bend of so much is an elbow's wherever it is. \[rad\]
const SHARP: f64 = 35.0 * std::f64::consts::PI / 180.0;
/// How sure an elbow is by a bend of a right angle, as a share of stature; flatter bends, less.
const ELBOW: f64 = 0.004;
/// How far the shoulder's outline over the line of a hanging arm lies above the acromion: the flesh over
/// the joint, and what the square of the sine of its angle adds. Shares of stature.
const OVER: (f64, f64) = (0.028, 0.05);
/// How sure that is, in the same way.
const OUTLINE: (f64, f64) = (0.007, 0.02);
/// From here up an arm has its acromion beside its line, not on it, and the outline tells ever less; an
/// arm that hangs more steeply has clothes and flesh join it to the trunk below its armpit, and that
/// tells ever less. Cosines, and what is added to their standard deviations for each unit beyond.
const RAISED: (f64, f64) = (0.85, 0.3);
const HANGS: (f64, f64) = (0.75, 0.2);
/// Where the acromion is above the armpit that shows, as shares of stature: what lies outside is neck, or
/// not the shoulder.
const SEEN: (f64, f64) = (0.015, 0.16);
/// Where a straight arm's girth dips between forearm and upper arm is the elbow: from where to where
/// above the wrist it is looked for, as shares of stature; how deep a dip is at least, and from where on it
/// is sure, as shares of the girth; and how sure that is, as a share of stature.
const DIP: (f64, f64) = (0.10, 0.20);
const DEEP: (f64, f64) = (0.002, 0.01);
const DIPS: f64 = 0.007;

/// The narrowest section between hand and forearm: an index.
pub(crate) fn narrowest(knots: &[Knot], wide: std::ops::Range<f64>, beyond: f64) -> Option<usize> {
    let near = |s: f64, range: &std::ops::Range<f64>| range.contains(&s);
    let all = 0..knots.len();
    let palm = all
        .clone()
        .filter(|i| near(knots[*i].s, &wide))
        .max_by(|a, b| knots[*a].tape.total_cmp(&knots[*b].tape))?;
    let after = knots[palm].s..knots[palm].s + beyond;
    all.filter(|i| near(knots[*i].s, &after))
        .min_by(|a, b| knots[*a].tape.total_cmp(&knots[*b].tape))
}

/// What the joints of an arm are told from.
pub(crate) fn joints(cuts: &Cuts<'_>, limb: &mut Limb, stature: f64) -> Option<()> {
    let knots = &limb.knots;
    let wrist = narrowest(knots, 0.03 * stature..0.11 * stature, 0.09 * stature)?;
    let w = knots[wrist].s;
    let forearm = &knots[wrist..];
    // The fold of the armpit draws the line aside: what is not round tells no bend.
    let top = forearm.iter().rposition(|k| k.round > 0.9)?;
    let arm = &forearm[..=top];
    let bend = bend(arm, 0.055 * stature, 0.02 * stature).filter(|b| b.angle > BENT);
    let mut told = vec![
        // (y - x) (1 - r) = r (x - w)
        Told {
            a: -1.0,
            b: 1.0 - RATIO.0,
            c: -RATIO.0 * w,
            sigma: RATIO.1 * LONG.0 * stature,
        },
        Told {
            a: 0.0,
            b: 1.0,
            c: w + LONG.0 * stature,
            sigma: (LONG.1 * stature).hypot(WRIST * stature) + (GROWN - stature).max(0.0) * CHILD,
        },
    ];
    let elbow = bend.as_ref().map(|bend| Told {
        a: 1.0,
        b: 0.0,
        c: bend.s,
        sigma: ELBOW * stature / bend.angle.sin().clamp(0.25, 1.0),
    });
    // A slight bend far from where people's elbows are is none.
    let sharp = bend.as_ref().is_some_and(|b| b.angle > SHARP);
    told.extend(elbow.filter(|e| sharp || agrees(&told, e)));
    if !sharp && let Some((s, deep)) = dip(arm, w, stature) {
        let dip = Told {
            a: 1.0,
            b: 0.0,
            c: s,
            sigma: DIPS * stature * (DEEP.1 / deep).max(1.0),
        };
        told.extend(Some(dip).filter(|d| agrees(&told, d)));
    }
    // The upper arm's own line, from above the elbow.
    let ([x, _], _) = places(&told)?;
    let above = x + 0.03 * stature;
    let upper = line(arm.iter().filter(|k| k.s > above))
        .or_else(|| line(arm.iter().skip(top.saturating_sub(7))))?;
    let last = *arm.last()?;
    told.extend(shoulder(cuts, limb, &upper, &last, stature));
    let ([elbow, shoulder], cov) = places(&told)?;
    limb.bent = bend.map_or(0.0, |b| b.angle);
    limb.root_line = Some(upper);
    let joint = |s: f64, sigma: f64| Joint { s, sigma };
    limb.end = joint(w, WRIST * stature);
    limb.middle = joint(elbow, cov[0].sqrt());
    limb.root = joint(shoulder, cov[2].sqrt());
    limb.shared = cov[1];
    Some(())
}

/// What the shoulder's outline over a hanging arm and the armpit under a raised one tell of the acromion;
/// `last` is the upper arm's last section of its own.
fn shoulder(cuts: &Cuts<'_>, limb: &Limb, upper: &Line, last: &Knot, stature: f64) -> Vec<Told> {
    let at = |c: f64, sigma: f64| Told {
        a: 0.0,
        b: 1.0,
        c,
        sigma: sigma * stature,
    };
    let up = upper.along.z;
    let aside = (1.0 - up * up).max(0.0);
    let fold = last.s + upper.along.dot(&(limb.fold - last.centre));
    let above = |c: f64| (SEEN.0 * stature..SEEN.1 * stature).contains(&(c - fold));
    let mut told = Vec::new();
    if up > 0.5
        && let Some(out) = exit(cuts, last, upper.along, stature)
    {
        let c = last.s + out - (OVER.0 + OVER.1 * aside) * stature;
        let sigma = OUTLINE.0 + OUTLINE.1 * aside + RAISED.1 * (RAISED.0 - up).max(0.0);
        told.extend(above(c).then(|| at(c, sigma)));
    }
    let c = fold + (ARMPIT.0 + ARMPIT.1 * up.max(0.0)) * stature;
    told.push(at(c, ARMPIT.2 + HANGS.1 * (up - HANGS.0).max(0.0)));
    told
}

/// Where the girth dips between forearm and upper arm, and how deep, as a share of it. \[mm\] along the
/// line.
fn dip(arm: &[Knot], wrist: f64, stature: f64) -> Option<(f64, f64)> {
    let mean = |i: usize| (arm[i - 1].tape + arm[i].tape + arm[i + 1].tape) / 3.0;
    let tapes: Vec<(f64, f64)> = (1..arm.len().saturating_sub(1))
        .map(|i| (arm[i].s, mean(i)))
        .collect();
    let range = wrist + DIP.0 * stature..wrist + DIP.1 * stature;
    let most = |all: &[(f64, f64)]| all.iter().map(|t| t.1).fold(0.0, f64::max);
    let deep = |i: usize| {
        let beside = most(&tapes[..i]).min(most(&tapes[i..]));
        (beside - tapes[i].1) / tapes[i].1
    };
    let at = (0..tapes.len())
        .filter(|i| range.contains(&tapes[*i].0))
        .max_by(|a, b| deep(*a).total_cmp(&deep(*b)))?;
    (deep(at) > DEEP.0).then_some((tapes[at].0, deep(at)))
}

/// Whether a statement agrees with others, within three standard deviations.
fn agrees(told: &[Told], new: &Told) -> bool {
    places(told).is_none_or(|([x, y], cov)| {
        let off = new.a * x + new.b * y - new.c;
        let square = new.a * new.a * cov[0] + 2.0 * new.a * new.b * cov[1] + new.b * new.b * cov[2];
        off.abs() < 3.0 * (square + new.sigma * new.sigma).sqrt()
    })
}

/// How far from a knot, straight along a direction, the surface ends. \[mm\]
fn exit(cuts: &Cuts<'_>, from: &Knot, along: Vector3<f64>, stature: f64) -> Option<f64> {
    let most = 0.25 * stature;
    let far = cuts.crossings(from.centre, along, most);
    let out = far.into_iter().reduce(f64::min)?;
    (out > 0.0).then_some(out)
}
