//! Stories out of seeds.

use super::story::{Act, CAPTURES, NUMBERS, PROGRAMS, Setup, Story, Use, What};
use proof::Dice;

/// What belongs together: where one is frequent, so is the rest that it needs to matter.
#[derive(Clone, Copy)]
enum Theme {
    Runs,
    Sharing,
    Strangers,
    Sweeping,
    Programs,
    Disk,
    Network,
    Time,
}
use Theme::{Disk, Network, Programs, Runs, Sharing, Strangers, Sweeping, Time};

/// How many themes there are.
const THEMES: usize = 8;

/// How often something happens, what it belongs to, and what it is.
type Kind = (usize, Theme, fn(&mut Teller) -> What);

/// What may happen: how often where a story has no mixture of its own, and what it belongs to.
const KINDS: [Kind; 27] = [
    (29, Runs, |t| {
        let (capture, n) = t.wanted();
        What::Run { capture, n }
    }),
    (2, Runs, |t| What::Work {
        capture: t.below(t.captures),
        n: t.below(t.numbers),
    }),
    (1, Runs, |t| What::Plan {
        capture: t.below(t.captures),
        n: t.below(t.numbers),
    }),
    (2, Runs, |t| What::Strand { strand: t.below(4) }),
    (10, Sharing, |_| What::Upload),
    (3, Strangers, |_| What::Sign),
    (7, Sweeping, |t| What::Gc {
        most: [0, 300, 70_000][t.below(3)],
        keep: t.below(2),
    }),
    (7, Sweeping, |t| What::Forget {
        capture: t.below(t.captures),
    }),
    (4, Sweeping, |t| What::Pin { name: t.below(2) }),
    (1, Sweeping, |t| What::Unpin { name: t.below(2) }),
    (2, Sweeping, |_| What::Verify),
    (3, Sharing, |t| What::SweepStore {
        older_s: [0, 50, 1000][t.below(3)],
    }),
    (3, Programs, |t| What::Ask {
        program: t.below(PROGRAMS),
        capture: t.below(t.captures),
    }),
    (2, Programs, |t| What::Allow {
        program: t.below(PROGRAMS),
    }),
    (1, Programs, |t| What::Revoke {
        program: t.below(PROGRAMS),
    }),
    (1, Programs, |t| What::Plant {
        program: t.below(PROGRAMS),
    }),
    (1, Programs, |_| What::Loosen),
    (2, Sweeping, |t| What::Edit {
        capture: t.below(t.captures),
    }),
    (2, Disk, |t| What::Full(t.is(0.5))),
    (3, Network, |t| What::Cut(t.is(0.5))),
    (2, Disk, |t| What::PowerLoss(t.dice.bits())),
    (4, Disk, |t| What::Spoil {
        file: t.dice.bits(),
        how: t.dice.bits(),
    }),
    (2, Network, |t| What::SpoilThere {
        object: t.dice.bits(),
        how: t.dice.bits(),
    }),
    (2, Network, |t| What::FalseAnswers {
        count: t.dice.bits() % 5,
        how: t.dice.bits(),
    }),
    (4, Strangers, |t| match t.forges {
        true => {
            let (capture, n) = (t.below(t.captures), t.below(t.numbers));
            t.forged = Some((t.below(t.machines), capture, n));
            What::Forge {
                capture,
                n,
                node: t.below(4),
                signed: t.is(0.5),
            }
        }
        false => What::Time { s: 40 },
    }),
    (2, Time, |t| match t.is(0.6) {
        true => What::Time {
            s: [1, 40, 4000, 40_000][t.below(4)],
        },
        false => What::Clock {
            s: t.below(200_000) as i64 - 100_000,
        },
    }),
    (1, Time, |t| What::NewKey {
        days: t.below(3) as i64,
    }),
];

/// Stories in which all happens as often as usual; in the rest some of it not at all, and some of it often, so that
/// what is rare meets (Groce et al. 2012, swarm testing).
const USUAL_SHARE: f64 = 0.3;

/// By what the weights of what belongs together are multiplied in a story with a mixture of its own.
const THEME_FACTORS: [usize; 4] = [0, 1, 1, 6];

/// The same, of one kind beside those that it belongs to.
const KIND_FACTORS: [usize; 4] = [0, 1, 1, 2];

struct Teller {
    dice: Dice,
    machines: usize,
    forges: bool,
    /// How many captures and numbers it knows: where there are few, acts meet.
    captures: usize,
    numbers: usize,
    /// What a stranger made last: of a capture, with a number; and the machine that meets it.
    forged: Option<(usize, usize, usize)>,
    weights: Vec<usize>,
}

impl Teller {
    fn below(&mut self, most: usize) -> usize {
        (self.dice.bits() % most as u64) as usize
    }

    /// Of which capture and number something is wanted: as a rule what a stranger made last.
    fn wanted(&mut self) -> (usize, usize) {
        let any = (self.below(self.captures), self.below(self.numbers));
        let forged = self.forged.map(|(_, capture, n)| (capture, n));
        forged.filter(|_| self.is(0.7)).unwrap_or(any)
    }

    fn is(&mut self, share: f64) -> bool {
        self.dice.unit() < share
    }

    fn step(&mut self) -> u32 {
        // Most acts take some tens of steps.
        let most = [6, 30, 90][self.below(3)];
        self.below(most) as u32
    }

    /// A mixture of what happens. There are always runs.
    fn mixed(&mut self) {
        self.weights = KINDS.iter().map(|(weight, ..)| *weight).collect();
        if self.is(USUAL_SHARE) {
            return;
        }
        let themes = [0; THEMES].map(|_| THEME_FACTORS[self.below(THEME_FACTORS.len())]);
        for (i, (_, theme, _)) in KINDS.iter().enumerate().skip(1) {
            let factor = KIND_FACTORS[self.below(KIND_FACTORS.len())];
            self.weights[i] *= themes[*theme as usize] * factor;
        }
        self.captures = 1 + self.below(CAPTURES);
        self.numbers = 1 + self.below(NUMBERS);
    }

    fn what(&mut self) -> What {
        let all = self.weights.iter().sum();
        let mut at = self.below(all);
        for (i, (.., what)) in KINDS.iter().enumerate() {
            match at.checked_sub(self.weights[i]) {
                Some(left) => at = left,
                None => return what(self),
            }
        }
        unreachable!("below the sum of all")
    }

    fn act(&mut self, depth: usize) -> Act {
        let sound = self.is(0.6);
        let step = |teller: &mut Teller, share| (!sound && teller.is(share)).then(|| teller.step());
        let (kill, fail, lost) = (step(self, 0.5), step(self, 0.2), step(self, 0.3));
        let count = match depth {
            0 if self.is(0.35) => 1 + self.below(3),
            1 if self.is(0.1) => 1,
            _ => 0,
        };
        let met = self.forged.map(|(machine, ..)| machine);
        let any = self.below(self.machines);
        let machine = met.filter(|_| self.is(0.5)).unwrap_or(any);
        let mut beside: Vec<(u32, Act)> = Vec::new();
        for _ in 0..count {
            let (step, mut act) = (self.step(), self.act(depth + 1));
            if self.is(0.6) {
                act.machine = machine;
            }
            beside.push((step, act));
        }
        beside.sort_by_key(|(step, _)| *step);
        Act {
            machine,
            what: self.what(),
            kill,
            fail,
            lost,
            beside,
        }
    }
}

impl Story {
    /// The story of a seed.
    pub(super) fn new(seed: u64) -> Story {
        let mut dice = Dice(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        let machines = 2 + (dice.bits() % 4) as usize;
        let forges = dice.unit() < 0.4;
        let mut teller = Teller {
            dice,
            machines,
            forges,
            captures: CAPTURES,
            numbers: NUMBERS,
            forged: None,
            weights: vec![],
        };
        teller.mixed();
        // Keys have a last day in some stories, soon or over.
        let expires = teller.is(0.3);
        let last_day = |teller: &mut Teller| expires.then(|| teller.below(4) as i64 - 1);
        let setup = |teller: &mut Teller| Setup {
            uses: match teller.below(10) {
                0..2 => Use::Alone,
                2 => Use::ReadOnly,
                3 => Use::Believing,
                4..6 if forges => Use::Open,
                _ if forges => Use::Strict,
                4..8 => Use::Open,
                _ => Use::Strict,
            },
            ahead_s: teller.below(20_000) as i64 - 10_000,
            drift: teller.below(200_000) as i64 - 100_000,
            key_days: last_day(teller),
        };
        let machines = (0..machines).map(|_| setup(&mut teller)).collect();
        let honest = teller.is(0.8);
        let late = teller.is(0.5);
        let strange_days = last_day(&mut teller);
        let count = 4 + teller.below(16);
        let acts = (0..count).map(|_| teller.act(0)).collect();
        Story {
            machines,
            honest,
            late,
            strange_days,
            turn: seed as usize,
            acts,
        }
    }
}
