//! What happens in a story: data, so that parts of it can be left out and the rest stays the same.

use proof::Dice;

/// How a machine uses the shared store.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Use {
    Alone,
    /// Nothing is signed, everybody is believed.
    Open,
    ReadOnly,
    /// What is written is signed, and only those who do so are believed.
    Strict,
}

/// A machine.
#[derive(Debug, Clone)]
pub(super) struct Setup {
    pub(super) uses: Use,
    /// Its clock is ahead by so much. \[s\]
    pub(super) ahead_s: i64,
    /// Its clock gains so much. \[µs/s\]
    pub(super) drift: i64,
}

/// One thing that somebody does, or that happens.
#[derive(Debug, Clone)]
pub(super) struct Act {
    pub(super) machine: usize,
    pub(super) what: What,
    /// The process is killed at that step.
    pub(super) kill: Option<u32>,
    /// That step fails.
    pub(super) fail: Option<u32>,
    /// The answer to what was asked in that step is lost.
    pub(super) lost: Option<u32>,
    /// What others do before steps of it.
    pub(super) beside: Vec<(u32, Act)>,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) enum What {
    Run {
        capture: usize,
        n: usize,
    },
    Work {
        capture: usize,
        n: usize,
    },
    Upload,
    Gc {
        most: u64,
        keep: usize,
    },
    Forget {
        capture: usize,
    },
    Pin {
        name: usize,
    },
    Unpin {
        name: usize,
    },
    Verify,
    SweepStore {
        older_s: u64,
    },
    Ask {
        program: usize,
    },
    Allow {
        program: usize,
    },
    Revoke {
        program: usize,
    },
    /// A permission that came with a cache.
    Plant {
        program: usize,
    },
    /// Anybody may write where permissions lie.
    Loosen,
    Edit {
        capture: usize,
    },
    Full(bool),
    Cut(bool),
    PowerLoss(u64),
    Spoil {
        file: u64,
        how: u64,
    },
    SpoilThere {
        object: u64,
        how: u64,
    },
    /// So many answers of the shared store are not true.
    Lies {
        count: u64,
        how: u64,
    },
    /// Somebody puts results of their own there.
    Forge {
        capture: usize,
        n: usize,
        node: usize,
        signed: bool,
    },
    Time {
        s: u64,
    },
    Clock {
        s: i64,
    },
}

/// A story.
#[derive(Debug, Clone)]
pub(super) struct Story {
    pub(super) machines: Vec<Setup>,
    /// Whether the shared store keeps to what it says of creating.
    pub(super) honest: bool,
    /// Whether the machines' clocks say that files changed long ago.
    pub(super) late: bool,
    pub(super) acts: Vec<Act>,
}

/// How many numbers stories give to `mid`.
pub(super) const NUMBERS: usize = 3;
/// How many captures each machine has.
pub(super) const CAPTURES: usize = 2;

/// Programs that somebody may allow.
pub(super) const PROGRAMS: usize = 3;

struct Teller {
    dice: Dice,
    machines: usize,
    forges: bool,
}

impl Teller {
    fn below(&mut self, most: usize) -> usize {
        (self.dice.bits() % most as u64) as usize
    }

    fn is(&mut self, share: f64) -> bool {
        self.dice.unit() < share
    }

    fn step(&mut self) -> u32 {
        // Most acts take some tens of steps.
        let most = [6, 30, 90][self.below(3)];
        self.below(most) as u32
    }

    fn what(&mut self) -> What {
        let (capture, n) = (self.below(CAPTURES), self.below(NUMBERS));
        let program = self.below(PROGRAMS);
        let name = self.below(2);
        let (file, how) = (self.dice.bits(), self.dice.bits());
        match self.below(100) {
            0..30 => What::Run { capture, n },
            30..34 => What::Work { capture, n },
            34..44 => What::Upload,
            44..51 => What::Gc {
                most: [0, 300, 70_000][self.below(3)],
                keep: self.below(2),
            },
            51..58 => What::Forget { capture },
            58..62 => What::Pin { name },
            62..63 => What::Unpin { name },
            63..65 => What::Verify,
            65..67 => What::SweepStore {
                older_s: [0, 50, 1000][self.below(3)],
            },
            67..70 => What::Ask { program },
            70..72 => What::Allow { program },
            72..73 => What::Revoke { program },
            73..74 => What::Plant { program },
            74..75 => What::Loosen,
            75..77 => What::Edit { capture },
            77..79 => What::Full(self.is(0.5)),
            79..82 => What::Cut(self.is(0.5)),
            82..84 => What::PowerLoss(file),
            84..88 => What::Spoil { file, how },
            88..90 => What::SpoilThere { object: file, how },
            90..92 => What::Lies {
                count: file % 5,
                how,
            },
            92..95 if self.forges => What::Forge {
                capture,
                n,
                node: self.below(4),
                signed: self.is(0.5),
            },
            92..98 => What::Time {
                s: [1, 40, 4000][self.below(3)],
            },
            _ => What::Clock {
                s: self.below(200_000) as i64 - 100_000,
            },
        }
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
        let machine = self.below(self.machines);
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
        };
        let setup = |teller: &mut Teller| Setup {
            uses: match teller.below(10) {
                0..2 => Use::Alone,
                2 => Use::ReadOnly,
                _ if forges => Use::Strict,
                3..8 => Use::Open,
                _ => Use::Strict,
            },
            ahead_s: teller.below(20_000) as i64 - 10_000,
            drift: teller.below(200_000) as i64 - 100_000,
        };
        let machines = (0..machines).map(|_| setup(&mut teller)).collect();
        let honest = teller.is(0.8);
        let late = teller.is(0.5);
        let count = 4 + teller.below(16);
        let acts = (0..count).map(|_| teller.act(0)).collect();
        Story {
            machines,
            honest,
            late,
            acts,
        }
    }
}
