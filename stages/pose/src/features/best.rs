//! The nearest of many features by description, and the next that is elsewhere.
//!
//! Likenesses are sums of whole numbers below 2²⁴, which single precision holds exactly.

/// A description's likeness to itself (structural).
pub(crate) const SAME: f32 = 512.0 * 512.0;
/// Features nearer to each other than this are one place with several directions. By hand: looked at three captures:
/// halved, size +0.07 % for one; doubled, no more than chance (docs/lab/numbers.md). \[px\]
pub(crate) const PLACE_PX: f32 = 2.0;
/// The two best so far.
pub(crate) struct Best {
    pub(crate) first: f32,
    pub(crate) at: usize,
    pub(crate) second: f32,
}

impl Default for Best {
    fn default() -> Self {
        Best {
            first: f32::MIN,
            at: usize::MAX,
            second: f32::MIN,
        }
    }
}

impl Best {
    /// Looks at one more; what is where the best is is no second.
    pub(crate) fn see(&mut self, j: usize, alike: f32, elsewhere: &impl Fn(usize, usize) -> bool) {
        if alike <= self.second {
            return;
        }
        let other = self.at != usize::MAX && elsewhere(self.at, j);
        if alike > self.first {
            if other {
                self.second = self.first;
            }
            (self.first, self.at) = (alike, j);
        } else if other {
            self.second = alike;
        }
    }

    /// Whether the nearest is nearer than `ratio` times the next; descriptions have length 512, so
    /// that squared distances are 2 (512² - likeness).
    pub(crate) fn ahead(&self, ratio: f64) -> bool {
        let distance = |s: f32| f64::from(2.0 * (SAME - s).max(0.0)).sqrt();
        self.at != usize::MAX
            && (self.second == f32::MIN || distance(self.first) < ratio * distance(self.second))
    }
}
