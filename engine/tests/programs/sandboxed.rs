//! What a program cannot do in the sandbox, whoever it is started by. Each line here got through once.

use crate::application::{Place, left, shell};
use programs::{Sandbox, sandbox};
use std::os::unix::net::UnixListener;
use std::path::PathBuf;

/// Whether there is a full sandbox here; printed where there is none.
#[track_caller]
pub(crate) fn full_sandbox() -> bool {
    match sandbox() {
        Sandbox::Bubblewrap(_) => true,
        other => {
            proof::passed_over(&other.lacks().unwrap_or_default());
            false
        }
    }
}

/// What a line of shell prints.
fn printed(place: &Place, line: &str) -> String {
    place.text(&shell(&format!("({line}) > \"$1\" 2>&1; true"), ""))
}

#[test]
fn a_program_has_no_power_even_as_root() {
    if !full_sandbox() {
        return;
    }
    let place = Place::new();
    let caps = printed(
        &place,
        "grep -E 'Cap(Prm|Eff|Bnd|Amb)|NoNewPrivs' /proc/self/status",
    );
    let set = |line: &str| line.split_whitespace().last().map(str::to_owned);
    let sets: Vec<String> = caps.lines().filter_map(set).collect();
    let none = "0000000000000000";
    assert_eq!(sets, [none, none, none, none, "1"], "{caps}");
    // By these a root without capabilities still reached the machine.
    for line in [
        "cat /proc/sys/kernel/hostname > /proc/sys/kernel/hostname",
        "cat /proc/sys/vm/swappiness > /proc/sys/vm/swappiness",
        "true >> /proc/sysrq-trigger",
        "mount -t tmpfs none /run",
        "unshare --user --map-root-user true",
        "mknod /tmp/disk b 7 0",
    ] {
        let reported = printed(&place, &format!("{line} && echo DONE"));
        assert!(!reported.contains("DONE"), "{line}: {reported}");
    }
}

#[test]
fn a_program_writes_nowhere_but_in_its_own_folders() {
    if !full_sandbox() {
        return;
    }
    let place = Place::new();
    let own = place.path("").display().to_string();
    for folder in [
        "/",
        "/dev",
        "/run",
        "/usr",
        "/usr/bin",
        "/etc",
        "/proc",
        "/sys",
        "/home",
        "/root",
        &own,
        "$(dirname $1)/../../..",
        "/proc/self/root",
    ] {
        let reported = printed(&place, &format!("echo x > {folder}/probe && echo DONE"));
        assert!(!reported.contains("DONE"), "{folder}: {reported}");
    }
    // These are its own, empty, and gone with it.
    let own = "for d in /tmp /dev/shm $HOME $TMPDIR .; do ls -A $d; echo x > $d/probe-of-a-program && echo own; done";
    assert_eq!(
        printed(&place, own),
        "own\nown\nown\nprobe-of-a-program\nown\nprobe-of-a-program\nown\n"
    );
    assert!(!PathBuf::from("/tmp/probe-of-a-program").exists());
    assert!(!PathBuf::from("/dev/shm/probe-of-a-program").exists());
}

#[test]
fn a_program_reaches_no_process_and_no_socket_outside() {
    if !full_sandbox() {
        return;
    }
    let place = Place::new();
    let path = place.path("socket");
    let _socket = UnixListener::bind(&path).unwrap();
    let by_path = format!(
        "python3 -c \"import socket; socket.socket(socket.AF_UNIX).connect('{}')\" && echo DONE",
        path.display()
    );
    let mut outside = std::process::Command::new("sleep")
        .arg("600")
        .spawn()
        .unwrap();
    let id = outside.id();
    for line in [
        by_path,
        format!("kill -0 {id} && echo DONE"),
        format!("ls /proc/{id} && echo DONE"),
        format!("kill -9 {id} && echo DONE"),
    ] {
        let reported = printed(&place, &line);
        assert!(!reported.contains("DONE"), "{line}: {reported}");
    }
    assert!(outside.try_wait().unwrap().is_none(), "it lives");
    outside.kill().unwrap();
    outside.wait().unwrap();
    // Shared memory of System V has no place in the file system.
    let reported = printed(&place, "ipcs -m | grep -c 0x; ls /proc | grep -c '^[0-9]'");
    let counts: Vec<u32> = reported.lines().map(|line| line.parse().unwrap()).collect();
    assert!(counts[0] == 0 && counts[1] < 10, "{reported}");
}

#[test]
fn what_was_not_declared_is_not_there() {
    if !full_sandbox() {
        return;
    }
    let place = Place::new();
    place.write("undeclared.txt", "personal");
    std::fs::create_dir_all(place.path("cache/cas")).unwrap();
    let (file, cache) = (place.path("undeclared.txt"), place.path("cache"));
    // Of the home folder at most what is in PATH.
    let path = std::env::var_os("PATH").unwrap();
    let on_path = |at: &PathBuf| std::env::split_paths(&path).any(|folder| folder.starts_with(at));
    let home = std::fs::read_dir(std::env::home_dir().unwrap()).unwrap();
    let mut hidden: Vec<PathBuf> = home.map(|entry| entry.unwrap().path()).collect();
    hidden.retain(|at| !on_path(at));
    let hidden = hidden.iter().map(|at| format!(" -e '{}'", at.display()));
    let hidden = format!(
        "test{} -e /no/such/file",
        hidden.map(|test| test + " -o").collect::<String>()
    );
    for line in [
        format!("cat {}", file.display()),
        format!("ls -d {}/cas", cache.display()),
        hidden,
        "cat /etc/shadow".to_owned(),
        "cat /etc/hostname".to_owned(),
        "grep -v nobody /etc/passwd | grep root".to_owned(),
        "ls /sys/class".to_owned(),
        "ls /var/log".to_owned(),
        "cat /dev/kmsg".to_owned(),
        "cat $(dirname $1)/../../../../format".to_owned(),
    ] {
        let reported = printed(&place, &format!("{line} && echo DONE"));
        assert!(!reported.contains("DONE"), "{line}: {reported}");
    }
    // The system's programs are.
    assert!(printed(&place, "python3 -c 'import json; print(json.dumps(7))'").contains('7'));
}

#[test]
fn who_leaves_his_session_and_his_environment_ends_with_the_program() {
    if !full_sandbox() {
        return;
    }
    let place = Place::new();
    let line = "setsid env -i sleep 4719.25 > /dev/null 2>&1 < /dev/null & echo a > $1";
    let text = place.graph(&shell(line, ""));
    place.made(&text);
    let entries = std::fs::read_dir("/proc").unwrap().flatten();
    let lines: Vec<Vec<u8>> = entries
        .filter_map(|e| std::fs::read(e.path().join("cmdline")).ok())
        .collect();
    let runs = lines
        .iter()
        .any(|l| l.split(|b| *b == 0).any(|w| w == b"4719.25"));
    assert!(!runs);
}

#[test]
fn disk_is_bounded_wherever_a_program_may_write() {
    if !full_sandbox() {
        return;
    }
    let place = Place::new();
    for file in [
        "$1",
        "$(dirname $1)/../x",
        "x",
        "/tmp/x",
        "/dev/shm/x",
        "$HOME/x",
    ] {
        let why = place.failure(&shell(&format!("truncate -s 5G {file} && sleep 20"), ""));
        let reported = ["more than 4294 MB", "Read-only", "Permission"]
            .iter()
            .any(|t| why.contains(t));
        assert!(reported, "{file}: {why}");
    }
}

#[test]
fn a_sparse_file_is_refused_by_name_and_not_read() {
    let place = Place::new();
    let why = place.failure(&shell("truncate -s 3900M $1", ""));
    assert!(
        why.contains("text.txt, which is a file with holes"),
        "{why}"
    );
}

#[test]
fn memory_is_counted_of_those_who_left_their_environment_too() {
    if !full_sandbox() {
        return;
    }
    let place = Place::new();
    let line = "setsid env -i /usr/bin/python3 -c 'x = bytearray(300_000_000); import time; time.sleep(30)' & wait";
    let why = place.failure(&shell(line, "memory_mb = 100\ntimeout_s = 10\n"));
    assert!(why.contains("took more than 100 MB"), "{why}");
}

#[test]
fn folders_as_deep_as_can_be_are_refused_and_removed() {
    let place = Place::new();
    let deep = "python3 -c 'import os
for i in range(3000):
    os.mkdir(\"d\"); os.chdir(\"d\")'";
    let shut = "mkdir -p $TMPDIR/shut/in; chmod 0 $TMPDIR/shut";
    let line = format!("{deep}; {shut}; cd $(dirname $1); {deep}; echo a > $1");
    let graph = place.graph(&shell(&line, ""));
    place.allow(&graph);
    let outcome = place.run(&graph, &(), &false.into()).unwrap();
    let why = outcome.failure(&graph).unwrap().1;
    assert!(why.contains("more than 100 folders in each other"), "{why}");
    assert_eq!(left(&place.path("cache")), Vec::<PathBuf>::new());
}

#[test]
fn what_is_declared_to_be_read_is_there_and_its_change_is_noticed() {
    let place = Place::new();
    place.write("declared.txt", "first");
    std::fs::create_dir_all(place.path("model/parts")).unwrap();
    place.write("model/parts/weights", "7");
    let (file, folder) = (place.path("declared.txt"), place.path("model"));
    let line = format!(
        "cat {} {}/parts/weights > $1",
        file.display(),
        folder.display()
    );
    let nodes = shell(&line, &format!("reads = [{file:?}, {folder:?}]\n"));
    assert_eq!(place.text(&nodes), "first7");
    place.write("declared.txt", "second");
    assert_eq!(place.text(&nodes), "second7");
    place.write("model/parts/weights", "8");
    assert_eq!(place.text(&nodes), "second8");
    let found = |nodes: &str| {
        let graph = place.graph(nodes);
        let outcome = place.made(&graph);
        !crate::application::is_made(&outcome, &graph, "x")
    };
    assert!(found(&nodes), "nothing changed");
    if full_sandbox() {
        let write = shell(
            &format!("echo x > {} && echo DONE > $1", file.display()),
            &format!("reads = [{file:?}]\n"),
        );
        place.failure(&write);
        assert_eq!(std::fs::read_to_string(&file).unwrap(), "second");
    }
    let refused = |reads: &str| {
        let graph = place.graph(&shell("echo a > $1", &format!("reads = [{reads:?}]\n")));
        place.allow(&graph);
        place
            .run(&graph, &(), &false.into())
            .err()
            .unwrap_or_default()
    };
    assert!(
        refused("/dev/zero").contains("is no plain file"),
        "{}",
        refused("/dev/zero")
    );
    assert!(refused("/no/such/file").contains("No such file"));
    assert!(refused(place.path("").to_str().unwrap()).contains("holds the cache"));
    let reported = place
        .open(&shell("echo a > $1", "reads = [\"model\"]\n"), &[])
        .err()
        .unwrap();
    assert!(reported.contains("named by its whole path"), "{reported}");
}
