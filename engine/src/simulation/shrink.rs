//! The shortest story that fails.

use super::played::played;
use super::story::{Act, Story};

/// No more tries than that, whatever is found. \[stories\]
const MOST_TRIES: usize = 3000;

/// What is left of a story without what it fails without; and why it fails.
pub(super) fn shortest(story: Story, why: String) -> (Story, String) {
    let mut found = (story, why);
    let mut tries = 0;
    while tries < MOST_TRIES {
        let shorter = candidates(&found.0).into_iter().find_map(|story| {
            tries += 1;
            let why = played(&story).1?;
            Some((story, why))
        });
        match shorter {
            Some(shorter) => found = shorter,
            None => break,
        }
    }
    found
}

/// Stories with less in them: halves first, single things last.
fn candidates(story: &Story) -> Vec<Story> {
    let mut all = Vec::new();
    let mut with = |acts: Vec<Act>| {
        all.push(Story {
            acts,
            ..story.clone()
        });
    };
    let n = story.acts.len();
    let mut size = n.div_ceil(2);
    while size > 0 && n > 0 {
        for begin in (0..n).step_by(size) {
            let mut acts = story.acts.clone();
            acts.drain(begin..(begin + size).min(n));
            with(acts);
        }
        size /= 2;
    }
    for at in 0..n {
        for simpler in simpler(&story.acts[at]) {
            let mut acts = story.acts.clone();
            acts[at] = simpler;
            with(acts);
        }
    }
    // What somebody did beside may do as an act of its own.
    for at in 0..n {
        for (_, act) in &story.acts[at].beside {
            let mut acts = story.acts.clone();
            acts[at] = act.clone();
            with(acts);
        }
    }
    all
}

/// An act with less of what happens to it.
fn simpler(act: &Act) -> Vec<Act> {
    let mut all = Vec::new();
    if !act.beside.is_empty() {
        for at in 0..act.beside.len() {
            let mut fewer = act.clone();
            fewer.beside.remove(at);
            all.push(fewer);
            for inner in simpler(&act.beside[at].1) {
                let mut fewer = act.clone();
                fewer.beside[at].1 = inner;
                all.push(fewer);
            }
        }
    }
    let without = |change: &dyn Fn(&mut Act)| {
        let mut act = act.clone();
        change(&mut act);
        act
    };
    if act.kill.is_some() {
        all.push(without(&|act| act.kill = None));
    }
    if act.fail.is_some() {
        all.push(without(&|act| act.fail = None));
    }
    if act.lost.is_some() {
        all.push(without(&|act| act.lost = None));
    }
    all
}
