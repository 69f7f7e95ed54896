//! Every system call of forgetting, sweeping, programs and publishing fails once, and a process is killed before each:
//! nothing is wrong afterwards, and nothing is left of what was forgotten.
//!
//! `ENGINE_CALLS=1` takes every call, `ENGINE_CALLS=7` every seventh, from `ENGINE_CALLS_FIRST` on.
#![cfg(all(target_os = "linux", target_arch = "x86_64"))]

#[path = "../../examples/words/application.rs"]
mod application;
#[path = "../../examples/words/nouns.rs"]
mod nouns;
mod place;
#[cfg(feature = "remote")]
mod threads;
mod traced;

use place::{NEEDLES, OTHER, Place};
use std::io::{BufRead, Write};
use std::path::PathBuf;
use traced::{Ended, Fault};

#[test]
#[ignore = "the process that the other tests start"]
fn child() {
    let var = |name: &str| std::env::var(name).expect("started by another test");
    engine::permission::keep_permissions_in(PathBuf::from(var("CALLS_STATE")));
    let thread = std::fs::read_link("/proc/thread-self").unwrap();
    let thread = thread.file_name().unwrap().to_str().unwrap().to_owned();
    let mut out = std::io::stdout();
    out.write_all(format!("\nthread {thread}\n").as_bytes())
        .unwrap();
    out.flush().unwrap();
    let _ = std::io::stdin().lock().read_line(&mut String::new());
    let words = var("CALLS_WORDS");
    let code = command::run(&application::WORDS, words.split('\n').map(str::to_owned));
    std::process::exit(code.into());
}

fn number(name: &str, usual: usize) -> usize {
    std::env::var(name).map_or(usual, |n| n.parse().unwrap())
}

/// Whether what must hold does; else what does not.
type Right = Result<(), String>;

fn must(holds: bool, what: &str) -> Right {
    holds.then_some(()).ok_or_else(|| what.to_owned())
}

/// Asks a line with a fault at one call after the other; `hold` looks at what came of it.
fn each(place: &Place, line: &str, stride: usize, hold: &dyn Fn(&Ended) -> Right) {
    place.begin();
    let calls = place.asked(line, Fault::None).calls;
    assert!(calls > 50, "{calls}");
    let stride = number("ENGINE_CALLS", stride);
    let first = number("ENGINE_CALLS_FIRST", 0);
    println!("`{line}`: {calls} calls, every {stride}th from {first} on");
    let mut wrong = Vec::new();
    // Threads make some more or less each time.
    for n in (first..calls + calls / 20).step_by(stride) {
        for fault in [Fault::Fails(n), Fault::Killed(n)] {
            place.begin();
            let ended = place.asked(line, fault);
            if let Err(what) = hold(&ended) {
                wrong.push(format!("{fault:?} of {calls}: {what}; {ended:?}"));
            }
        }
    }
    let (many, all) = (wrong.len(), wrong.join("\n"));
    assert!(wrong.is_empty(), "`{line}`: {many}\n{all}");
}

/// No process has a number as large.
const KILLED: &str = "4194305-0-17f";

/// What a run that was killed leaves: half of a file.
fn half_of_a_file(place: &Place) {
    std::fs::write(place.cache().join("tmp").join(KILLED), NEEDLES[0]).unwrap();
}

/// And the folder of a program.
fn folder_of_a_program(place: &Place) {
    let folder = place.cache().join("exec").join(KILLED);
    std::fs::create_dir_all(folder.join("read/1/in")).unwrap();
    std::fs::write(folder.join("lock"), "").unwrap();
    std::fs::write(folder.join("read/1/in/counts.csv"), NEEDLES[0]).unwrap();
}

#[test]
fn forgetting_succeeds_only_if_nothing_is_left_whatever_call_fails() {
    let place = Place::new();
    place.sound("run PROGRAM --input IN=FIRST --allow-exec --quiet");
    place.sound("run PROGRAM --input IN=FIRST --set longest.most=1 --out OUT --quiet");
    place.sound("cache pin mine");
    place.sound("run PROGRAM --input IN=OTHER --quiet");
    half_of_a_file(&place);
    folder_of_a_program(&place);
    place.is_base();
    place.begin();
    assert!(place.left(&NEEDLES).is_some());
    let line = "cache forget FIRST";
    each(&place, line, 29, &|ended| {
        if ended.code == Some(0) {
            let left = place.left(&NEEDLES);
            must(left.is_none(), &format!("success, and left {left:?}"))?;
            must(place.left(&[OTHER]).is_some(), "the other one's is gone")?;
            let out = place.at("out").display().to_string();
            must(ended.output.contains(&out), "results are not named")?;
        }
        // What was cut off can be asked for again.
        let again = place.asked(line, Fault::None);
        let left = place.left(&NEEDLES);
        must(
            left.is_none(),
            &format!("then {again:?}, and left {left:?}"),
        )?;
        place.holds()
    });
}

#[test]
fn a_sweep_takes_nothing_that_stays_whatever_call_fails() {
    let place = Place::new();
    place.sound("run PROGRAM --input IN=FIRST --allow-exec --quiet");
    place.sound("cache pin mine");
    place.sound("run PROGRAM --input IN=FIRST --set longest.most=1 --quiet");
    place.sound("run PROGRAM --input IN=OTHER --quiet");
    half_of_a_file(&place);
    let (stays, all) = (place.kept(), place.blobs());
    assert!(
        stays.len() > 2 && stays.len() < all.len(),
        "{stays:?} of {all:?}"
    );
    place.is_base();
    let line = "cache gc --max-size 1";
    each(&place, line, 7, &|ended| {
        must(stays.is_subset(&place.blobs()), "what stays is gone")?;
        place.holds()?;
        if ended.code != Some(0) {
            place.sound(line);
        }
        must(place.blobs() == stays, "what goes is there")?;
        must(place.litter().is_empty(), "litter is there")?;
        place.holds()
    });
}

#[test]
fn a_program_s_result_is_whole_or_none_whatever_call_fails() {
    let place = Place::new();
    place.sound("run PROGRAM --input IN=OTHER --allow-exec --quiet");
    place.sound("run PROGRAM --input IN=OTHER --quiet");
    let last = place.last_run();
    place.is_base();
    place.begin();
    let line = "run PROGRAM --input IN=FIRST --out OUT --quiet";
    place.sound(line);
    let result = place.at("out/longest.txt");
    let right = std::fs::read(&result).unwrap();
    assert!(String::from_utf8_lossy(&right).contains(NEEDLES[0]));
    each(&place, line, 61, &|ended| {
        let made = std::fs::read(&result).ok();
        must(
            made.is_none() || made.as_ref() == Some(&right),
            "half a result",
        )?;
        must(
            made.is_some() || ended.code != Some(0),
            "success, and no result",
        )?;
        must(
            place.last_run() > last || ended.code != Some(0),
            "success, and another run is the last",
        )?;
        place.holds()?;
        let again = place.asked(line, Fault::None);
        let made = std::fs::read(&result).ok();
        must(
            again.code == Some(0) && made.as_ref() == Some(&right),
            &format!("again: {again:?}"),
        )?;
        place.sound("cache gc --max-size 1G");
        must(place.litter().is_empty(), "litter is there")?;
        place.holds()
    });
}

#[test]
fn a_check_that_succeeds_has_read_everything_whatever_call_fails() {
    let place = Place::new();
    place.sound("run PROGRAM --input IN=OTHER --allow-exec --quiet");
    for shelf in ["ac", "cas", "parts"] {
        place.spoil(shelf);
    }
    place.is_base();
    let all = |ended: &Ended| ended.output.contains("; put aside: 3 files");
    each(&place, "cache verify", 5, &|ended| {
        must(ended.code != Some(0) || all(ended), "success, and not all")?;
        place.sound("cache verify");
        place.holds()
    });
}

#[test]
fn nothing_runs_that_was_not_allowed_whatever_call_fails() {
    let place = Place::new();
    place.sound("run PROGRAM --input IN=OTHER --allow-exec --quiet");
    let script = place.at("longest.sh");
    let text = std::fs::read_to_string(&script).unwrap();
    std::fs::write(&script, format!("{text}echo itran >> \"$2\"\n")).unwrap();
    place.is_base();
    each(
        &place,
        "run PROGRAM --input IN=OTHER --quiet",
        3,
        &|ended| {
            must(ended.code != Some(0), "success")?;
            must(place.left(&["itran"]).is_none(), "it ran")
        },
    );
}

/// Exit codes of a line as it is, and where what has a name cannot be opened.
fn shut(place: &Place, line: &str, name: &'static str) -> [Option<i32>; 2] {
    [Fault::None, Fault::Shut(name)].map(|fault| {
        place.begin();
        let ended = place.asked(line, fault);
        assert_eq!(ended.call.is_some(), fault != Fault::None, "{ended:?}");
        ended.code
    })
}

#[test]
fn a_plan_that_cannot_be_looked_for_is_not_one_that_is_not_there() {
    let place = Place::new();
    place.sound("run PROGRAM --input IN=OTHER --allow-exec --quiet");
    place.sound("plan PROGRAM --strands --input IN=OTHER");
    place.is_base();
    assert_eq!(
        shut(&place, "cluster status PLAN", "plans"),
        [Some(0), Some(1)]
    );
}

#[cfg(feature = "remote")]
#[test]
fn what_waits_and_cannot_be_looked_for_is_not_taken_for_nothing() {
    let place = Place::new();
    std::fs::create_dir(place.at("store")).unwrap();
    place.sound("run PROGRAM --input IN=OTHER --allow-exec --quiet --store STORE");
    place.is_base();
    let line = "cache push --store STORE --store-wait 5";
    assert_eq!(shut(&place, line, "waiting"), [Some(0), Some(1)]);
}

#[cfg(feature = "remote")]
#[test]
fn an_upload_that_succeeds_has_brought_everything_whatever_call_fails() {
    let place = Place::new();
    std::fs::create_dir(place.at("store")).unwrap();
    place.sound("run PROGRAM --input IN=OTHER --allow-exec --quiet --store STORE");
    let right = place.objects();
    assert!(right.len() > 2, "{:?}", right.keys());
    place.all_waits();
    place.is_base();
    let line = "cache push --store STORE --store-wait 5";
    let whole = |place: &Place| {
        let there = place.objects();
        let all = right
            .iter()
            .all(|(name, bytes)| there.get(name) == Some(bytes));
        must(
            all && place.names("cache/waiting").is_empty(),
            "not all of it is there",
        )
    };
    each(&place, line, 11, &|ended| {
        must(ended.code != Some(101), "it panicked")?;
        let there = place.objects();
        let half = |(name, bytes): (&String, &Vec<u8>)| there.get(name).is_some_and(|b| b != bytes);
        must(!right.iter().any(half), "half a result")?;
        if ended.code == Some(0) {
            whole(&place).map_err(|what| format!("success, and {what}"))?;
        }
        place.sound(line);
        whole(&place).map_err(|what| format!("again, and {what}"))?;
        place.holds()
    });
}
