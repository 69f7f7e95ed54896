//! Joints of a leg along its line: ankle, knee, hip.

use crate::features::limb::arm::narrowest;
use crate::features::limb::bend::{BENT_RAD, Constraint, bend, line, places};
use crate::features::limb::one::{Joint, Limb};

/// Height of the middle of the kneecap against the crotch's, of 6068 men and women (ANSUR II, 2012).
const KNEE: (f64, f64) = (0.576, 0.014);
/// From the middle of the kneecap to the crotch, as a share of stature; of the same people (ANSUR II).
const ABOVE_KNEE: (f64, f64) = (0.204, 0.0102);
/// Height of the crotch as a share of stature; of the same people (ANSUR II).
const CROTCH: (f64, f64) = (0.481, 0.0145);
/// Height of the trochanter against the crotch's; of the same people (ANSUR II).
const HIP: (f64, f64) = (1.07, 0.024);
/// How sure the crotch is where a leg's line ends, as a share of stature. By hand: looked at three scans, at 0.7 and
/// 1.4 of it: tapes move by at most 0.03 and 0.03 %.
const END_SIGMA: f64 = 0.008;
/// How sure a knee is by a bend of a right angle, as a share of stature. By hand: looked at two scans, at 0.7 and 1.4
/// of it: tapes move by at most 0.86 and 0.07 %, intervals change by at most 35 and 1 %.
const BEND_SIGMA: f64 = 0.005;
/// An ankle is at most so high, as a share of stature: what is higher is on its toes, or in boots, and its height tells
/// nothing of the knee's. By hand: looked at three scans, at 0.7 and 1.4 of it: tapes move by at most 0.1 and 0 %.
const HIGHEST_ANKLE: f64 = 0.09;
/// How far the ankle's joint is under its narrowest, as a share of stature: malleolus and girth of the ankle. By hand:
/// looked at three scans, at 0.7 and 1.4 of it: tapes move by at most 0.01 and 0.04 %.
const JOINT_UNDER: f64 = 0.025;
/// Where a leg's line ends lower than this share of stature, more than the thigh is hidden: crotches are at 0.42 at
/// least (ANSUR II).
const LOWEST_END: f64 = 0.40;

/// What the joints of a leg are estimated from; `ground` is the height of the soles. \[mm\]
pub(crate) fn joints(limb: &mut Limb, ground: f64, stature: f64) -> Option<()> {
    let knots = &limb.knots;
    // From the toes on: the instep's sections are long, the ankle's the shortest after them.
    let ankle = narrowest(knots, 0.06 * stature..0.16 * stature, 0.14 * stature)?;
    let a = knots[ankle].s;
    let high = knots[ankle].centre.z - ground;
    let flat = high < HIGHEST_ANKLE * stature;
    let sole = a - high.min(HIGHEST_ANKLE * stature);
    let shank = &knots[ankle..];
    let end = knots.last()?.s;
    let bend = bend(shank, 0.08 * stature, 0.03 * stature).filter(|b| b.angle > BENT_RAD);
    let mut reported = vec![
        match flat {
            // x = sole + r (y - sole)
            true => Constraint {
                a: 1.0,
                b: -KNEE.0,
                c: sole * (1.0 - KNEE.0),
                sigma: KNEE.1 * CROTCH.0 * stature,
            },
            false => Constraint {
                a: -1.0,
                b: 1.0,
                c: ABOVE_KNEE.0 * stature,
                sigma: ABOVE_KNEE.1 * stature,
            },
        },
        Constraint {
            a: 0.0,
            b: 1.0,
            c: sole + CROTCH.0 * stature,
            sigma: CROTCH.1 * stature,
        },
    ];
    if end - sole > LOWEST_END * stature {
        reported.push(Constraint {
            a: 0.0,
            b: 1.0,
            c: end,
            sigma: END_SIGMA * stature,
        });
    }
    if let Some(bend) = &bend {
        reported.push(Constraint {
            a: 1.0,
            b: 0.0,
            c: bend.s,
            sigma: BEND_SIGMA * stature / libm::sin(bend.angle).clamp(0.25, 1.0),
        });
    }
    let ([knee, crotch], cov) = places(&reported)?;
    let above = knee + 0.04 * stature;
    let thigh = line(knots.iter().filter(|k| k.s > above));
    limb.bent = bend.map_or(0.0, |b| b.angle);
    limb.root_line = thigh;
    limb.end = Joint {
        s: a - JOINT_UNDER * stature,
        sigma: 0.008 * stature,
        again: None,
    };
    limb.middle = Joint {
        s: knee,
        sigma: cov[0].sqrt(),
        again: None,
    };
    let c = crotch - sole;
    limb.root = Joint {
        s: sole + HIP.0 * c,
        sigma: libm::hypot(HIP.0 * cov[2].sqrt(), HIP.1 * c),
        again: None,
    };
    limb.shared = HIP.0 * cov[1];
    limb.crotch = crotch;
    Some(())
}
