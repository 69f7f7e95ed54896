//! How far a measuring is, for people.

use super::super::progress::{Progress, Step};
use super::super::show::SHOWN;
use crate::words::language::Words;
use crate::words::parts::{PARTS, part_of};
use maud::{Markup, html};

/// In a sentence; `nothing` if it was measured to its end and no girth came of it.
pub(crate) fn sentence(words: Words, progress: &Progress, nothing: bool) -> String {
    let state = match progress.state {
        "done" if nothing => "nothing",
        state => state,
    };
    let state = words.text(&format!("state-{state}"));
    if progress.state != "running" {
        let took = (progress.state == "done").then(|| words.duration(progress.seconds));
        return took.map_or(state.clone(), |took| format!("{state} ({took})"));
    }
    let running: Vec<&str> = progress
        .steps
        .iter()
        .filter(|s| s.state == "running")
        .map(|s| part_of(&s.node))
        .collect();
    let now = PARTS.iter().rev().find(|(part, _)| running.contains(part));
    match now {
        Some((part, _)) => format!("{state}: {}", words.text(&format!("part-{part}"))),
        None => state,
    }
}

/// How much of a node is done, of one.
fn share(step: &Step) -> f64 {
    match step.state {
        "open" => 0.0,
        "running" if step.of > 0 => (step.done as f64 / step.of as f64).min(1.0),
        "running" => 0.0,
        _ => 1.0,
    }
}

/// Part by part.
pub(crate) fn steps(words: Words, progress: &Progress) -> Markup {
    let left = progress.left().filter(|_| progress.goes_on());
    html! {
        @if !progress.steps.is_empty() {
            ol .steps {
                @for (part, _) in PARTS {
                    @let mine: Vec<&Step> = progress.steps.iter().filter(|s| part_of(&s.node) == part).collect();
                    @if !mine.is_empty() { (one(words, part, &mine)) }
                }
            }
            @if let Some(left) = left.filter(|l| *l >= 1.0) {
                p .soft { (words.with("time-left", &[("time", words.duration(left).into())])) }
            }
        }
    }
}

fn one(words: Words, part: &str, steps: &[&Step]) -> Markup {
    let any = |state: &str| steps.iter().any(|s| s.state == state);
    let done = steps.iter().all(|s| ["made", "found"].contains(&s.state));
    let state = match (any("failed"), any("cancelled"), done) {
        (true, ..) => "failed",
        (_, true, _) => "stopped",
        (_, _, true) => "done",
        _ if any("running") => "running",
        _ if any("made") || any("found") => "begun",
        _ => "open",
    };
    let all: f64 = steps.iter().map(|s| share(s)).sum::<f64>() / steps.len() as f64;
    let seconds: f64 = steps
        .iter()
        .filter(|s| s.state == "made")
        .map(|s| s.seconds)
        .sum();
    let name = words.text(&format!("part-{part}"));
    html! {
        li class=(state) {
            span .part { (name) }
            progress max="1" value=(format!("{all:.3}")) aria-label=(name) {}
            span .word {
                (words.text(&format!("step-{state}")))
                @if state == "done" && seconds >= 1.0 { " · " (words.duration(seconds)) }
            }
        }
    }
}

/// The pictures that there are.
pub(crate) fn pictures(words: Words, id: &str, progress: &Progress) -> Markup {
    let there = SHOWN
        .iter()
        .filter_map(|(node, _)| Some((*node, progress.pictures.get(*node)?)));
    html! {
        @for (node, (_, content)) in there {
            @let title = words.text(&format!("picture-{node}"));
            @let at = format!("/api/captures/{id}/pictures/{node}?of={}", content.get(..16).unwrap_or_default());
            figure class=(node) {
                a href=(at) { img src=(at) alt=(title); }
                figcaption { (title) }
            }
        }
    }
}
