//! Plans on Slurm's real daemons, and what goes wrong there.

use super::site::Site;
use std::collections::BTreeSet;
use std::process::Command;

#[test]
#[cfg_attr(not(slurm), ignore = "slurmctld, slurmd, munged are not installed")]
fn a_sweep_on_slurm_comes_to_what_it_does_here_each_result_once() {
    let site = Site::new(4);
    let all = "1,2,3,4,5,6,7,8,9,10,11";
    let plan = site.plan(all, &["x.s=0"]);
    let printed = site.submit(&plan);
    assert!(
        printed.contains("layer 1: job ") && printed.contains("elements for 11 strands"),
        "{printed}"
    );
    let again = site.submit(&plan);
    assert!(!again.contains(" sent: "), "{again}");
    site.settle();
    assert_eq!(
        site.jobs().len(),
        2,
        "one sbatch a layer, whatever the largest array"
    );
    let (code, text) = site.output(&["status", &plan[..12]]);
    assert_eq!(code, Some(0), "{text}");
    assert!(text.contains("layer 1: 11 of 11 strands done"), "{text}");
    assert_eq!(site.place.made(), 12, "event logs: each result once");
    assert!(site.submit(&plan).contains("nothing was sent"));
    let there = site.place.contents();
    assert_eq!(site.table(all, &["x.s=0"]), (11, 0));
    // The same in a store of its own, here.
    std::fs::rename(site.place.cache(), site.place.path("there")).unwrap();
    site.plan(all, &["x.s=0"]);
    assert_eq!(site.table(all, &["x.s=0"]), (11, 12));
    assert_eq!(site.place.contents(), there);
}

#[test]
#[cfg_attr(not(slurm), ignore = "slurmctld, slurmd, munged are not installed")]
fn a_failing_element_drops_only_what_reads_it() {
    let site = Site::new(1001);
    let plan = site.plan("1,13,2", &["x.s=0"]);
    site.submit(&plan);
    site.settle();
    let (code, text) = site.output(&["status", &plan]);
    assert_eq!(code, Some(1), "{text}");
    assert!(text.contains("layer 0: 1 of 1 strand done"), "{text}");
    assert!(
        text.contains("layer 1: 2 of 3 strands done; elements: 1 FAILED"),
        "{text}"
    );
    assert!(text.contains("nothing works on them"), "{text}");
    // What it is missing is sent again, and nothing else.
    let printed = site.submit(&plan);
    assert!(
        printed.contains("1 element for 3 strands") && !printed.contains("layer 0"),
        "{printed}"
    );
    site.settle();
    let (done, made) = site.table("1,13,2", &["x.s=0"]);
    assert_eq!((done, made), (2, 0));
}

#[test]
#[cfg_attr(not(slurm), ignore = "slurmctld, slurmd, munged are not installed")]
fn a_submitter_that_is_killed_at_the_first_layer_sends_nothing_twice() {
    killed_at(1);
}

#[test]
#[cfg_attr(not(slurm), ignore = "slurmctld, slurmd, munged are not installed")]
fn a_submitter_that_is_killed_at_the_last_layer_sends_nothing_twice() {
    killed_at(2);
}

/// Sends two plans, killed before and after it sends a layer of theirs.
fn killed_at(count: usize) {
    let site = Site::new(1001);
    let real = site.ask("sh", &["-c", "command -v sbatch"]);
    for (round, before) in [true, false].into_iter().enumerate() {
        let over = format!("{round},{}", round + 100);
        let plan = site.plan(&over, &["x.s=1", &format!("base.b={round}")]);
        // Kills who calls it, before or after what it does at that layer.
        let folder = site.place.path(&format!("bin{round}"));
        std::fs::create_dir(&folder).unwrap();
        let calls = folder.join("calls");
        let kill = format!(
            "[ \"$(wc -l < {})\" = {count} ] && kill -9 $PPID",
            calls.display()
        );
        let (first, last) = if before {
            (kill.as_str(), ":")
        } else {
            (":", kill.as_str())
        };
        let text = format!(
            "#!/bin/sh\necho x >> {}\n{first}\n{} \"$@\"\ncode=$?\n{last}\nexit $code\n",
            calls.display(),
            real.trim()
        );
        let wrapper = folder.join("sbatch");
        std::fs::write(&wrapper, text).unwrap();
        let made = Command::new("chmod").arg("+x").arg(&wrapper).status();
        assert!(made.unwrap().success());
        let path = format!("{}:{}", folder.display(), std::env::var("PATH").unwrap());
        let mut submit = site.tailor(&["submit", &plan, "--engine", "slurm"]);
        let killed = submit.env("PATH", path).output().unwrap();
        assert_eq!(
            killed.status.code(),
            None,
            "round {round}: it was not killed"
        );
        let before = site.jobs().len();
        site.submit(&plan);
        site.settle();
        assert_eq!(
            site.jobs().len(),
            2 * (round + 1),
            "{before} before: two layers a round"
        );
        let (code, text) = site.output(&["status", &plan]);
        assert_eq!(code, Some(0), "{text}");
    }
    assert_eq!(site.place.made(), 2 * 3, "each result once");
}

/// A plan of two strands in the midst of their stages, one of which is done something to; then all are let on.
fn disturbed(site: &Site, naps: f64, disturb: impl Fn(&str)) -> String {
    let plan = site.plan("1,2", &[&format!("x.s={naps}")]);
    site.submit(&plan);
    let second = format!("{}-L1", &plan[..12]);
    let running = || {
        let all = site.ask("squeue", &["-h", "-r", "-t", "R", "-o", "%i %j"]);
        let element = |line: &str| line.split(' ').next().unwrap().to_owned();
        let some = all.lines().filter(|l| l.contains(&second)).map(element);
        some.collect::<Vec<_>>()
    };
    let all_nap = || {
        let running = running();
        !running.is_empty() && napping(naps).len() == running.len()
    };
    site.wait("stages of the second layer", all_nap);
    let before = napping(naps);
    disturb(&running()[0]);
    let gone = || !before.is_subset(&napping(naps));
    site.wait("the end of one stage", gone);
    let_on(site, naps);
    plan
}

/// The processes that sleep for so long: `x` of a plan, in the midst of its stage. \[s\]
fn napping(naps: f64) -> BTreeSet<String> {
    let line = format!("sleep\0{naps}\0");
    let all = std::fs::read_dir("/proc").unwrap();
    let names = all.map(|e| e.unwrap().file_name().into_string().unwrap());
    let naps = |pid: &String| {
        let words = std::fs::read(format!("/proc/{pid}/cmdline"));
        words.is_ok_and(|words| words == line.as_bytes())
    };
    names.filter(naps).collect()
}

/// The processes of one element of an array of jobs ("2_0"), those first that began first. Slurm's own signals come in an order
/// that differs, and a program that outlives its stage writes the result.
fn processes(site: &Site, one: &str) -> Vec<String> {
    let (array, task) = one.split_once('_').unwrap();
    let conf = site.place.path("slurm").join("slurm.conf");
    let wanted = [
        format!("SLURM_CONF={}", conf.display()),
        format!("SLURM_ARRAY_JOB_ID={array}"),
        format!("SLURM_ARRAY_TASK_ID={task}"),
    ];
    let all = std::fs::read_dir("/proc").unwrap();
    let names = all.map(|e| e.unwrap().file_name().into_string().unwrap());
    let runs_for_it = |pid: &u32| {
        let environment = std::fs::read(format!("/proc/{pid}/environ")).unwrap_or_default();
        let has = |w: &String| environment.split(|b| *b == 0).any(|v| v == w.as_bytes());
        wanted.iter().all(has)
    };
    let mut pids: Vec<u32> = names
        .filter_map(|n| n.parse().ok())
        .filter(runs_for_it)
        .collect();
    pids.sort_unstable();
    pids.iter().map(u32::to_string).collect()
}

/// Ends all their sleep, until nothing is left on the site.
fn let_on(site: &Site, naps: f64) {
    site.wait("the end", || {
        for pid in napping(naps) {
            let _ = Command::new("kill").arg(pid).output();
        }
        site.ask("squeue", &["-h"]).trim().is_empty()
    });
}

#[test]
#[cfg_attr(not(slurm), ignore = "slurmctld, slurmd, munged are not installed")]
fn a_worker_that_is_requeued_in_the_midst_of_a_stage_loses_nothing() {
    let site = Site::new(1001);
    let plan = disturbed(&site, 4714.25, |one| {
        site.ask("scontrol", &["requeue", one]);
    });
    let (code, text) = site.output(&["status", &plan]);
    assert_eq!(code, Some(0), "{text}");
    assert_eq!(site.place.made(), 1 + 2, "none lost, none twice");
    assert!(site.place.run(&["cache", "verify"]).status.success());
}

#[test]
#[cfg_attr(not(slurm), ignore = "slurmctld, slurmd, munged are not installed")]
fn a_worker_that_is_killed_in_the_midst_of_a_stage_is_sent_again_and_loses_nothing() {
    let site = Site::new(1001);
    let naps = 4715.25;
    let plan = disturbed(&site, naps, |one| {
        let killed = Command::new("kill")
            .arg("-9")
            .args(processes(&site, one))
            .output();
        assert!(killed.unwrap().status.success());
    });
    let (code, text) = site.output(&["status", &plan]);
    assert_eq!(code, Some(1), "{text}");
    site.submit(&plan);
    let_on(&site, naps);
    assert_eq!(site.output(&["status", &plan]).0, Some(0));
    assert_eq!(site.place.made(), 1 + 2, "none lost, none twice");
    assert!(site.place.run(&["cache", "verify"]).status.success());
}

#[test]
#[cfg_attr(not(slurm), ignore = "slurmctld, slurmd, munged are not installed")]
fn a_plan_that_is_cancelled_keeps_what_is_done_and_goes_on() {
    let site = Site::new(1001);
    let plan = site.plan("1,2,3", &["x.s=30"]);
    site.submit(&plan);
    site.wait("the first layer", || site.place.made() == 1);
    let (code, text) = site.output(&["status", &plan]);
    assert_eq!(code, Some(0), "work is on its way: {text}");
    let (code, text) = site.output(&["cancel", &plan]);
    assert_eq!(code, Some(0), "{text}");
    site.settle();
    let (code, text) = site.output(&["status", &plan]);
    assert_eq!(code, Some(1), "{text}");
    assert!(
        text.contains("layer 0: 1 of 1") && text.contains(" CANCELLED"),
        "{text}"
    );
    let printed = site.submit(&plan);
    assert!(!printed.contains("layer 0"), "{printed}");
    assert_eq!(site.output(&["cancel", &plan]).0, Some(0));
}

#[test]
#[cfg_attr(not(slurm), ignore = "slurmctld, slurmd, munged are not installed")]
fn what_slurm_refuses_is_reported() {
    let site = Site::new(1001);
    let plan = site.plan("1", &["x.s=0"]);
    let (code, text) = site.output(&["submit", &plan, "--engine", "slurm", "--partition", "none"]);
    assert_eq!(code, Some(2), "{text}");
    assert!(
        text.contains("sbatch") && text.contains("partition"),
        "{text}"
    );
    let mut submit = site.tailor(&["submit", &plan, "--engine", "slurm"]);
    let ran = submit.env("PATH", "/nowhere").output().unwrap();
    let text = String::from_utf8_lossy(&ran.stderr).into_owned();
    assert_eq!(ran.status.code(), Some(2), "{text}");
    assert!(text.contains("is not here"), "{text}");
}
