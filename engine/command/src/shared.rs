//! `--store`: the store here is linked to one that machines share, for as long as a verb runs.

use super::fault::Fault;
use super::program::GlobalArgs;
use super::speech::CANCEL;
use super::text::count;
use buckets::{Objects, Patience, Seal};
use clap::ArgMatches;
use engine::store::remote::{Left, Manner, Sharing};
use std::sync::atomic::Ordering;
use std::time::Duration;

/// Verbs that read no result and make none.
pub(super) const NEEDS_NONE: [&str; 6] =
    ["stages", "check", "pipelines", "completions", "man", "mat"];

/// The verb that refuses a shared store.
pub(super) const REFUSES: &str = "serve";

/// The flags of a shared store.
pub(super) const OF_STORE: [&str; 5] = [
    "store",
    "store_read_only",
    "sign_key",
    "trust",
    "store_wait",
];

/// The place of an address.
#[cfg(feature = "remote")]
fn place(address: &str, patience: Patience) -> Result<Box<dyn Objects>, Fault> {
    let opened = buckets::open(address, patience);
    opened.map_err(|why| Fault::input(format!("--store {}: {why}", plain(address))))
}

/// There is none in this program.
#[cfg(not(feature = "remote"))]
fn place(address: &str, _patience: Patience) -> Result<Box<dyn Objects>, Fault> {
    Err(Fault::input(format!(
        "--store {}: this program was built without stores that machines share; build it with `--features remote`",
        plain(address)
    )))
}

/// Who signs what goes there, and who is believed.
#[cfg(feature = "remote")]
fn seal(global: &GlobalArgs) -> Result<Option<Box<dyn Seal>>, Fault> {
    use buckets::Keys;
    if global.sign_key.is_none() && global.trust.is_none() {
        return Ok(None);
    }
    let keys = Keys::read(global.sign_key.as_deref(), global.trust.as_deref());
    Ok(Some(Box::new(keys.map_err(Fault::input)?)))
}

/// Nobody: there is no shared store in this program.
#[cfg(not(feature = "remote"))]
fn seal(_global: &GlobalArgs) -> Result<Option<Box<dyn Seal>>, Fault> {
    Ok(None)
}

/// The words that give another process of this program the store that machines share (files by whole paths), and what
/// programs of a pipeline may.
pub(super) fn words(global: &GlobalArgs) -> Result<Vec<String>, Fault> {
    let mut words = super::programs::words(global);
    let Some(address) = &global.store else {
        return Ok(words);
    };
    words.extend(["--store".to_owned(), address.clone()]);
    for (word, file) in [("--sign-key", &global.sign_key), ("--trust", &global.trust)] {
        if let Some(file) = file {
            let file = std::path::absolute(file).map_err(Fault::input)?;
            words.extend([word.to_owned(), file.to_string_lossy().into_owned()]);
        }
    }
    Ok(words)
}

/// An address without what it may hold of secrets.
fn plain(address: &str) -> String {
    let (scheme, rest) = address.split_once("://").unwrap_or(("", address));
    let rest = rest.rsplit_once('@').map_or(rest, |(_, rest)| rest);
    let rest = rest.split(['?', '#']).next().unwrap_or_default();
    format!("{scheme}://{rest}")
}

/// Links the store to the one that `--store` names.
pub(super) fn begin(
    global: &GlobalArgs,
    verb: &str,
    private: bool,
) -> Result<Option<Sharing>, Fault> {
    let Some(address) = &global.store else {
        return Ok(None);
    };
    if private {
        return Err(Fault::input(
            "--private keeps nothing and --store shares it: give one of them",
        ));
    }
    if verb == REFUSES {
        return Err(Fault::input(
            "`serve` keeps captures on this machine alone: leave --store out",
        ));
    }
    if !(global.store_wait >= 0.0 && global.store_wait.is_finite()) {
        return Err(Fault::input("--store-wait: give seconds, such as 60"));
    }
    let patience = Patience::of(Duration::from_secs_f64(global.store_wait));
    let objects = place(address, patience)?;
    let report = |line: &str| crate::errln!("{line}");
    let manner = Manner {
        read_only: global.store_read_only,
        seal: seal(global)?,
        patience,
    };
    Sharing::begin(&global.cache, objects, manner, Box::new(report))
        .map(Some)
        .map_err(Fault::input)
}

/// The verb of a command line: of those below another one the lower.
pub(super) fn innermost(matches: &ArgMatches) -> &str {
    match matches.subcommand() {
        Some((name, below)) if below.subcommand().is_none() => name,
        Some((_, below)) => innermost(below),
        None => "",
    }
}

/// Waits for what is being uploaded. A strand is not done before it is.
pub(super) fn finish(
    sharing: Option<Sharing>,
    verb: &str,
    done: Result<(), Fault>,
    global: &GlobalArgs,
) -> Result<(), Fault> {
    let Some(sharing) = sharing else { return done };
    let name = sharing.name().to_owned();
    let patience = match CANCEL.load(Ordering::Relaxed) {
        true => 0.0,
        false => global.store_wait,
    };
    let left = sharing.finish(Duration::from_secs_f64(patience));
    if left.waiting == 0 && !left.unlisted {
        if left.sent > 0 && !global.quiet && !global.json {
            let sent = count(left.sent, "result");
            crate::errln!("store {name}: {sent} uploaded");
        }
        return done;
    }
    let text = waits(&name, &left);
    match (done, verb) {
        (Ok(()), "work" | "push") => match global.json {
            true => {
                crate::errln!("{text}");
                Err(Fault::stage(""))
            }
            false => Err(Fault::stage(text)),
        },
        (done, _) => {
            crate::errln!("{text}");
            done
        }
    }
}

fn waits(name: &str, left: &Left) -> String {
    let why = left
        .why
        .as_ref()
        .map_or(String::new(), |why| format!(" ({why})"));
    let what = match left.unlisted {
        true => "what waits in the cache".to_owned(),
        false => count(left.waiting, "result"),
    };
    format!(
        "store {name}: {what} could not be uploaded{why}: kept in the cache for the next run or `cache push`"
    )
}

#[cfg(test)]
mod tests {
    use super::innermost;
    use clap::Command;

    #[test]
    fn the_verb_of_a_push_is_push() {
        let below = Command::new("cache").subcommand(Command::new("push"));
        let program = Command::new("it")
            .subcommand(below)
            .subcommand(Command::new("work"));
        for (words, verb) in [
            (&["it", "cache", "push"][..], "push"),
            (&["it", "work"], "work"),
        ] {
            let matches = program.clone().get_matches_from(words);
            assert_eq!(innermost(&matches), verb);
        }
    }
}
