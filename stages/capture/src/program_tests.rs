//! Runs of the shell, as a foreign program.

use super::*;

const SHELL: Program = Program {
    name: "sh",
    package: "dash",
};

fn run(script: &str, limit_ms: u64, go_on: bool) -> Result<(String, Vec<String>), String> {
    let run = Run {
        program: SHELL,
        args: vec!["-c".into(), script.into()],
        what: "a script",
        limit: Duration::from_millis(limit_ms),
    };
    let (mut text, mut lines) = (String::new(), Vec::new());
    let status = run.run(
        whole(1000),
        |bytes| {
            text.push_str(&String::from_utf8_lossy(&bytes));
            Ok(())
        },
        |line| lines.push(line.to_owned()),
        || match go_on {
            true => Ok(()),
            false => Err(ProgramError::Broken {
                name: "sh",
                why: "asked to stop".into(),
            }),
        },
    );
    let status = status.map_err(|e: ProgramError| e.to_string())?;
    lines.push(format!("{:?}", status.code()));
    Ok((text, lines))
}

#[test]
fn output_and_messages_of_a_program_come_back() {
    let (text, lines) = run("printf abc; echo so >&2; exit 3", 60_000, true).unwrap();
    assert_eq!(text, "abc");
    assert_eq!(lines, ["so", "Some(3)"]);
    let long = run("head -c 2000 /dev/zero", 60_000, true).unwrap_err();
    assert!(long.contains("longer than 1000 bytes"), "{long}");
}

/// Whether a process is still there and runs.
fn runs(pid: &str) -> bool {
    let stat = std::fs::read_to_string(format!("/proc/{}/stat", pid.trim()));
    stat.is_ok_and(|s| !s.contains(") Z "))
}

#[test]
fn a_program_that_takes_too_long_or_is_not_wanted_is_ended_with_its_children() {
    for (go_on, part) in [(true, "was ended after"), (false, "asked to stop")] {
        let folder = tempfile::tempdir().unwrap();
        let note = folder.path().join("pid");
        let script = format!("sleep 600 & echo $! > {}; wait", note.display());
        let limit = if go_on { 1500 } else { 60_000 };
        let start = Instant::now();
        let why = run(&script, limit, go_on).unwrap_err();
        assert!(why.contains(part), "{why}");
        assert!(start.elapsed() < Duration::from_secs(30));
        // One that was stopped at once may not have got so far.
        let child = std::fs::read_to_string(&note).unwrap_or_default();
        // What is killed is gone a moment later.
        while !child.is_empty() && runs(&child) {
            assert!(start.elapsed() < Duration::from_secs(60), "{child}");
            std::thread::sleep(Duration::from_millis(10));
        }
    }
}

#[test]
fn a_program_that_is_not_there_is_named_with_its_package() {
    let run = Run {
        program: Program {
            name: "no-such-program",
            package: "no-such-package",
        },
        args: vec![],
        what: "turn.mp4",
        limit: Duration::from_secs(1),
    };
    let error: Result<_, ProgramError> = run.run(whole(9), |_| Ok(()), |_| (), || Ok(()));
    let error = error.unwrap_err().to_string();
    for part in ["no-such-program", "turn.mp4", "apt install no-such-package"] {
        assert!(error.contains(part), "{error}");
    }
}
