//! What happens in a story: data, so that parts of it can be left out and the rest stays the same.

/// How a machine uses the shared store.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Use {
    Alone,
    /// Nothing is signed, everybody is believed.
    Open,
    ReadOnly,
    /// Nothing is written, and those who sign are believed, a stranger's key among them.
    Believing,
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
    /// Its first key counts for so many days after the one on which the story begins; without, it has no last day.
    pub(super) key_days: Option<i64>,
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
    /// What other processes do before steps of it.
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
    /// A plan, of which processes of all machines make the strands.
    Plan {
        capture: usize,
        n: usize,
    },
    /// One strand of the last plan.
    Strand {
        strand: usize,
    },
    Upload,
    /// From now on it signs, and believes those who do; no stranger any more.
    Sign,
    /// It gets another key, which all machines trust, for so many days from today.
    NewKey {
        days: i64,
    },
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
    /// Wants what a program makes of a capture.
    Ask {
        program: usize,
        capture: usize,
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
    /// Anybody may write where permissions are.
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
    FalseAnswers {
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

impl What {
    /// Whether it runs stages.
    pub(super) fn runs(&self) -> bool {
        use What::{Ask, Plan, Run, Strand, Work};
        matches!(
            self,
            Run { .. } | Work { .. } | Plan { .. } | Strand { .. } | Ask { .. }
        )
    }
}

/// A story.
#[derive(Debug, Clone)]
pub(super) struct Story {
    pub(super) machines: Vec<Setup>,
    /// Whether the shared store creates only what is not there.
    pub(super) honest: bool,
    /// Whether by the machines' clocks files changed long ago.
    pub(super) late: bool,
    /// The same of a stranger's key as of the machines' keys.
    pub(super) strange_days: Option<i64>,
    /// Whose turn it is to be looked at as a whole in the end.
    pub(super) turn: usize,
    pub(super) acts: Vec<Act>,
}

/// How many numbers stories give to `mid`.
pub(super) const NUMBERS: usize = 3;
/// How many captures each machine has.
pub(super) const CAPTURES: usize = 2;

/// Programs that somebody may allow.
pub(super) const PROGRAMS: usize = 3;
