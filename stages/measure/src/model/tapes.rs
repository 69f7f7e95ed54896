//! Tapes beside each other, so that an error of a level is one of the tape, too.

/// Tapes at even steps; gaps where no section tells one. Any unit.
#[derive(Debug, Clone)]
pub(crate) struct Tapes {
    /// Place of the first.
    pub from: f64,
    /// From one to the next.
    pub step: f64,
    /// In rising order of place.
    pub all: Vec<Option<f64>>,
}

impl Tapes {
    /// The tape at a place, between two that are known.
    pub(crate) fn at(&self, place: f64) -> Option<f64> {
        let k = (place - self.from) / self.step;
        let (below, t) = (k.floor(), k - k.floor());
        if below < 0.0 {
            return None;
        }
        let tape = |k: usize| self.all.get(k).copied().flatten();
        Some(tape(below as usize)? * (1.0 - t) + tape(below as usize + 1)? * t)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tape_is_known_between_two_that_are_known() {
        let all = vec![Some(1.0), Some(3.0), None, Some(4.0), Some(5.0)];
        let tapes = Tapes {
            from: -1.0,
            step: 0.5,
            all,
        };
        assert_eq!(tapes.at(-0.75), Some(2.0));
        assert_eq!(
            (tapes.at(-0.25), tapes.at(-1.1), tapes.at(1.0)),
            (None, None, None)
        );
    }
}
