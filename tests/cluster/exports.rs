//! Plans as rules of other engines.

use super::place::Place;
use std::os::unix::fs::PermissionsExt;
use std::process::Command;

#[test]
fn make_makes_each_strand_once_and_goes_on_beside_what_fails() {
    let place = Place::new();
    let (plan, strands) = place.plan("50,45,40");
    assert_eq!(strands, 4);
    let rules = place.path("rules.mk");
    let file = rules.display().to_string();
    let written = place.run(&["export", &plan[..10], "--as", "makefile", "-o", &file]);
    assert!(written.status.success());
    let make = || {
        let mut make = Command::new("make");
        make.args(["-k", "-j2", "-f"])
            .arg(&rules)
            .current_dir(place.path("."));
        let ran = make.output().unwrap();
        let stderr = String::from_utf8_lossy(&ran.stderr).into_owned();
        (ran.status.success(), stderr)
    };
    let (done, stderr) = make();
    assert!(done, "{stderr}");
    assert_eq!(place.made(), 4);
    assert!(make().0, "again: all is found");
    assert_eq!(place.made(), 4);
    assert_eq!(place.swept("50,45,40"), (0, 6));
    // A rule that cannot: the other rules go on.
    let text = std::fs::read_to_string(&rules).unwrap();
    std::fs::write(&rules, text.replace("--strand 2 ", "--strand 99 ")).unwrap();
    let (done, stderr) = make();
    assert!(
        !done && stderr.contains("strand 99 is not in the plan"),
        "{stderr}"
    );
}

#[test]
fn a_snakefile_has_a_rule_a_strand_with_what_it_reads() {
    let place = Place::new();
    let (plan, _) = place.plan("50,45");
    let ran = place.run(&["export", &plan, "--as", "snakemake", "--cpus", "2"]);
    let text = String::from_utf8(ran.stdout).unwrap();
    let mark = |at: usize| format!("\"tailor-{}/s{at}\"", &plan[..12]);
    assert!(text.contains(&format!(
        "    input: {}, {}, {}\n",
        mark(0),
        mark(1),
        mark(2)
    )));
    assert!(text.contains(&format!(
        "rule s0:\n    output: touch({})\n    threads: 2\n",
        mark(0)
    )));
    let second = format!(
        "rule s2:\n    input: {}\n    output: touch({})\n",
        mark(0),
        mark(2)
    );
    assert!(text.contains(&second), "{text}");
    assert_eq!(text.matches(" work --plan ").count(), 3);
}

/// Commands of a cluster that take what they are given, and keep it in a file.
const TAKES: [(&str, &str); 4] = [
    (
        "scontrol",
        "echo MaxArraySize = 1001; echo MaxJobCount = 10000",
    ),
    ("squeue", ":"),
    ("sbatch", "cat > taken; echo 7"),
    ("tailor-dask", "cat > taken; echo '{\"sent\": 1}'"),
];

#[test]
fn what_is_given_of_programs_reaches_those_who_work() {
    let place = Place::new();
    let (plan, _) = place.plan("50,45");
    let folder = place.path("site");
    std::fs::create_dir(&folder).unwrap();
    for (name, line) in TAKES {
        let file = folder.join(name);
        std::fs::write(&file, format!("#!/bin/sh\n{line}\n")).unwrap();
        std::fs::set_permissions(&file, PermissionsExt::from_mode(0o755)).unwrap();
    }
    let path = std::env::var("PATH").unwrap();
    let path = format!("{}:{path}", folder.display());
    let taken = |words: &[&str]| {
        let mut command = place.tailor(words);
        let ran = command.env("PATH", &path).current_dir(&folder).output();
        let ran = ran.unwrap();
        let stderr = String::from_utf8_lossy(&ran.stderr);
        assert!(ran.status.success(), "{words:?}: {stderr}");
        let kept = std::fs::read_to_string(folder.join("taken"));
        let _ = std::fs::remove_file(folder.join("taken"));
        kept.unwrap_or_default() + &String::from_utf8_lossy(&ran.stdout)
    };
    let flags = ["--sandbox", "required", "--allow-exec"];
    for verb in [
        ["submit", &plan, "--engine", "slurm"],
        ["submit", &plan, "--engine", "dask=tcp://127.0.0.1:1"],
        ["export", &plan, "--as", "makefile"],
        ["export", &plan, "--as", "snakemake"],
    ] {
        let plain = taken(&verb);
        assert!(
            plain.contains("--cache") && !plain.contains("--sandbox"),
            "{plain}"
        );
        let all = taken(&[&verb[..], &flags].concat());
        let words: String = all.replace(['"', '\''], "").replace(',', " ");
        assert!(words.contains("--sandbox required --allow-exec"), "{all}");
    }
}
