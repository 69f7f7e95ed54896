//! Levenberg–Marquardt: steps of damped normal equations that only ever lower a cost (Madsen, Nielsen
//! and Tingleff 2004, §3.2).

use nalgebra::{DMatrix, DVector, Rotation3, Vector3};
use shape::Pose;

/// Weight of a direction that is kept where it is, in standard deviations of its own size.
/// It is structural: large enough that nothing moves it, small enough to be solved.
pub(crate) const FIXED: f64 = 1e8;
/// The damping to begin with; least; most, where no step helps any more.
/// It is structural: how steps are searched, not where they end.
const DAMPING: [f64; 3] = [1e-4, 1e-12, 1e10];
/// Damping is multiplied by the first after a step that lowered the cost, else by the second.
/// It is structural: how steps are searched, not where they end.
const FACTORS: [f64; 2] = [0.2, 8.0];
/// Added to the diagonal, so that what nothing depends on has an inverse. Not squared units: shares.
/// It is structural: above what doubles round.
const FLOOR: f64 = 1e-12;
/// Cost of a point behind a camera, in place of its infinite one (structural: more than any point in front costs).
const BEHIND: f64 = 1e6;

/// Normal equations, and what else a step needs.
pub(crate) struct System<T> {
    /// Symmetric, undamped.
    pub(crate) matrix: DMatrix<f64>,
    /// Minus the gradient.
    pub(crate) right: DVector<f64>,
    /// What else.
    pub(crate) rest: T,
}

/// What is adjusted, and how it is judged.
pub(crate) trait Problem {
    /// What is adjusted.
    type State;
    /// What a step of it needs beside the solved unknowns.
    type Rest;
    /// The cost that is minimised.
    fn cost(&self, state: &Self::State) -> f64;
    /// The normal equations at a state; `damping` is for what is eliminated.
    fn system(&self, state: &Self::State, damping: f64) -> System<Self::Rest>;
    /// The state after a step.
    fn moved(&self, state: &Self::State, step: &DVector<f64>, rest: &Self::Rest) -> Self::State;
}

/// Adjusts in place; the costs before and after each accepted step, which never rise. Ends after
/// `steps` trials, or after one that lowers the cost by less than `gain` of itself.
pub(crate) fn descend<P: Problem>(
    problem: &P,
    state: &mut P::State,
    steps: usize,
    gain: f64,
) -> Vec<f64> {
    let [mut damping, least, most] = DAMPING;
    let mut now = problem.cost(state);
    let mut costs = vec![now];
    for _ in 0..steps {
        let System {
            mut matrix,
            right,
            rest,
        } = problem.system(state, damping);
        (0..right.len()).for_each(|i| {
            let d = &mut matrix[(i, i)];
            *d = *d * (1.0 + damping) + FLOOR;
        });
        let stepped = matrix
            .cholesky()
            .map(|c| problem.moved(state, &c.solve(&right), &rest));
        match stepped.map(|s| (problem.cost(&s), s)) {
            Some((better, stepped)) if better < now => {
                let gained = (now - better) / now.max(f64::MIN_POSITIVE);
                (*state, now) = (stepped, better);
                costs.push(now);
                damping = (damping * FACTORS[0]).max(least);
                if gained < gain {
                    break;
                }
            }
            _ => {
                damping *= FACTORS[1];
                if damping > most {
                    break;
                }
            }
        }
    }
    costs
}

/// Cauchy's loss c² ln(1 + s/c²) of a squared residual s in standard deviations; that of a point
/// behind its camera where there is none.
pub(crate) fn cauchy(squared: Option<f64>, c2: f64) -> f64 {
    squared.map_or(BEHIND, |s| c2 * libm::log1p(s / c2))
}

/// What a squared residual weighs by that loss.
pub(crate) fn weight(squared: f64, c2: f64) -> f64 {
    1.0 / (1.0 + squared / c2)
}

/// The camera farthest from the first: its place, how its translation changes as it goes farther away, how far it is.
pub(crate) fn farthest(poses: &[Pose]) -> Option<(usize, Vector3<f64>, f64)> {
    let from = poses.first()?.centre();
    let far = |c: &usize| (poses[*c].centre() - from).norm();
    let last = (1..poses.len()).max_by(|a, b| far(a).total_cmp(&far(b)))?;
    let (pose, size) = (&poses[last], far(&last).max(1e-9));
    Some((last, pose.rotation * (pose.centre() - from) / size, size))
}

/// The pose after a step.
pub(crate) fn pose_moved(pose: &Pose, step: &[f64]) -> Pose {
    let turn = Vector3::new(step[0], step[1], step[2]);
    let mut rotation = Rotation3::new(turn) * pose.rotation;
    rotation.renormalize();
    Pose {
        rotation,
        translation: pose.translation + Vector3::new(step[3], step[4], step[5]),
    }
}
