//! What a surface shows of an arm along its line: wrist, bend, girths, armpit, shoulder; where its joints
//! are is estimated from this by the model's laws.

use crate::features::body::Body;
use crate::features::limb::arm_seen::ArmSeen;
use crate::features::limb::bend::{BENT_RAD, Line, hinge, line};
use crate::features::limb::cuts::Cuts;
use crate::features::limb::follow::Knot;
use crate::features::limb::one::Limb;
use nalgebra::{Point3, Vector3};
use std::ops::Range;

/// Where the palm is widest, from the fingertips on, as shares of stature: palms are 0.056 to 0.078 long, hands 0.096
/// to 0.133 (ANSUR II).
const PALM_SHARES: Range<f64> = 0.03..0.11;
/// How far beyond where the palm is widest the wrist is looked for, as a share of stature: palms are 0.078 long at most
/// (ANSUR II).
const HAND_SHARE: f64 = 0.09;
/// A wrist is where the hand stops narrowing: over the next so much of stature the girth falls by no more than that
/// share. Fat forearms narrow again farther up. By hand: looked at three scans, at 0.7 and 1.4 of each: tapes move by
/// at most 0 and 0.67 %, intervals change by at most 0 and 6 %.
const STEADY: (f64, f64) = (0.0155, 0.02);
/// How far above the wrist elbows are, as shares of stature: of 6 068 people 0.117 to 0.176 (ANSUR II), of 99 in 100
/// made bodies of all ages 0.115 to 0.169. A bend is looked for there and a little farther.
const ELBOW_SHARES: Range<f64> = 0.07..0.20;
/// A straight upper arm's line is drawn from here on above the wrist, as a share of stature: above the elbow of 99.6 in
/// 100 people (ANSUR II).
const UPPER_SHARE: f64 = 0.17;
/// The same above where the arm bends. By hand: looked at three scans, at 0.7 and 1.4 of it: tapes move by at most 0.03
/// and 0.31 %, intervals change by at most 0 and 3 %.
const BEND_SHARE: f64 = 0.03;
/// Arms that hang less steeply run out at neck and head, not at the shoulder. By hand: looked at three scans, at 0.7
/// and 1.4 of it: no tape changes. \[sine\]
const LEAST_RISE: f64 = 0.6;
/// Where the line leaves the surface above the armpit that shows, as shares of stature: what is outside is neck, or not
/// the shoulder. Acromia are 0.035 to 0.092 above axillae (ANSUR II).
const SHOULDER_SHARES: Range<f64> = 0.015..0.16;
/// Where girths of the arm are read, above the wrist, as shares of stature (structural: samples; the fitted laws weigh
/// them).
const TAPE_SHARES: [f64; 5] = [0.04, 0.08, 0.12, 0.16, 0.18];

/// The narrowest section between an extremity that is widest in a range, and so far beyond: an index.
pub(crate) fn narrowest(knots: &[Knot], wide: Range<f64>, beyond: f64) -> Option<usize> {
    let palm = widest(knots, wide)?;
    let after = knots[palm].s..knots[palm].s + beyond;
    (0..knots.len())
        .filter(|i| after.contains(&knots[*i].s))
        .min_by(|a, b| knots[*a].tape.total_cmp(&knots[*b].tape))
}

fn widest(knots: &[Knot], range: Range<f64>) -> Option<usize> {
    (0..knots.len())
        .filter(|i| range.contains(&knots[*i].s))
        .max_by(|a, b| knots[*a].tape.total_cmp(&knots[*b].tape))
}

/// The first section beyond the palm from which on the girth holds steady: an index.
fn wrist(knots: &[Knot], stature: f64) -> Option<usize> {
    let palm = widest(
        knots,
        PALM_SHARES.start * stature..PALM_SHARES.end * stature,
    )?;
    let last = knots[palm].s + HAND_SHARE * stature;
    let (far, fall) = (STEADY.0 * stature, STEADY.1);
    let least = |i: usize| {
        let next = knots[i + 1..].iter();
        let next = next.take_while(|k| k.s <= knots[i].s + far);
        next.map(|k| k.tape).reduce(f64::min)
    };
    (palm..knots.len())
        .take_while(|i| knots[*i].s < last)
        .find(|i| least(*i).is_some_and(|t| t >= (1.0 - fall) * knots[*i].tape))
}

/// Takes down what an arm shows: wrist, upper arm's line, features.
pub(crate) fn seen(cuts: &Cuts<'_>, limb: &mut Limb, body: &Body) -> Option<()> {
    let stature = body.stature;
    let knots = &limb.knots;
    let at = wrist(knots, stature)?;
    let w = knots[at].s;
    let forearm = &knots[at..];
    // The fold of the armpit draws the line aside: what is not round tells no bend.
    let top = forearm.iter().rposition(|k| k.round > 0.9)?;
    let arm = &forearm[..=top];
    let bend = hinge(
        arm,
        w + ELBOW_SHARES.start * stature..w + ELBOW_SHARES.end * stature,
        0.03 * stature,
    );
    let bend = bend.filter(|b| b.angle > BENT_RAD);
    let above = match bend {
        Some(bend) => bend.s + BEND_SHARE * stature,
        None => w + UPPER_SHARE * stature,
    };
    let upper = line(arm.iter().filter(|k| k.s > above))
        .or_else(|| line(arm.iter().skip(top.saturating_sub(7))))?;
    let last = *arm.last()?;
    let share = |mm: f64| mm / stature;
    let fold = last.s + upper.along.dot(&(limb.fold - last.centre));
    let rise = upper.along.z;
    let over = shoulder(cuts, &last, &upper, stature).map(|s| share(s - fold));
    let over = over.filter(|o| SHOULDER_SHARES.contains(o));
    let inward = -upper.along.dot(&body.left) * limb.side;
    let neck = body.neck.and_then(|z| Some(body.trunk(z)?.centre));
    let beside = neck.map(|n| share(-(n - last.centre).dot(&body.left) * limb.side));
    let values = [
        Some(share(last.s - w)),
        Some(rise),
        Some(inward),
        neck.map(|n| rise * share(n.z - last.centre.z)),
        beside.map(|x| inward * x),
        girth(forearm, w + TAPE_SHARES[0] * stature).map(share),
        girth(forearm, w + TAPE_SHARES[1] * stature).map(share),
        girth(forearm, w + TAPE_SHARES[2] * stature).map(share),
        girth(forearm, w + TAPE_SHARES[3] * stature).map(share),
        girth(forearm, w + TAPE_SHARES[4] * stature).map(share),
        over.map(|_| share(fold - w)),
        over,
        over.map(|o| o * rise),
        bend.map(|b| share(b.s - w)),
    ];
    limb.bent = bend.map_or(0.0, |b| b.angle);
    limb.root_line = Some(Line {
        point: upper.nearest(last.centre),
        ..upper
    });
    limb.seen = Some(ArmSeen {
        stature,
        wrist: w,
        last: last.s,
        values,
    });
    Some(())
}

/// The tape at a way along the arm. \[mm\]
fn girth(knots: &[Knot], s: f64) -> Option<f64> {
    let above = knots.iter().position(|k| k.s >= s)?;
    let (a, b) = (knots.get(above.checked_sub(1)?)?, &knots[above]);
    let t = (s - a.s) / (b.s - a.s).max(1e-9);
    Some(a.tape + t * (b.tape - a.tape))
}

/// Way at which the line of a hanging upper arm leaves the surface over the shoulder. \[mm\]
fn shoulder(cuts: &Cuts<'_>, last: &Knot, upper: &Line, stature: f64) -> Option<f64> {
    let out =
        (upper.along.z > LEAST_RISE).then(|| exit(cuts, last.centre, upper.along, stature))??;
    Some(last.s + out)
}

/// How far from a point, straight along a direction, the surface ends. \[mm\]
fn exit(cuts: &Cuts<'_>, from: Point3<f64>, along: Vector3<f64>, stature: f64) -> Option<f64> {
    let most = 0.25 * stature;
    let far = cuts.crossings(from, along, most);
    let out = far.into_iter().reduce(f64::min)?;
    (out > 0.0).then_some(out)
}
