//! Commands in blocks marked `sh` are understood; in blocks marked `sh run` they run.

use super::{pages, read, run};

/// The command lines of `tailor` in a page's blocks whose mark is so, without comments.
fn commands(text: &str, mark: &str) -> Vec<String> {
    let mut all = Vec::new();
    let mut inside = false;
    for line in text.lines() {
        if let Some(printed) = line.strip_prefix("```") {
            inside = !inside && printed.trim() == mark;
            continue;
        }
        let line = line.split(" # ").next().unwrap_or_default().trim();
        let own = line
            .strip_prefix("cargo run --release -- ")
            .map(|rest| format!("tailor {rest}"));
        let line = own.unwrap_or_else(|| line.to_owned());
        if inside && line.starts_with("tailor ") {
            all.push(line);
        }
    }
    all
}

#[test]
fn every_command_in_the_book_is_understood() {
    let mut wrong = Vec::new();
    let mut count = 0;
    for page in pages() {
        let text = read(&page);
        for line in ["sh", "sh run", "sh screen"]
            .map(|mark| commands(&text, mark))
            .concat()
        {
            count += 1;
            let words: Vec<&str> = line.split_whitespace().collect();
            if let Err(why) = tailor::check_arguments(&words) {
                wrong.push(format!("{page}: {line}\n{why}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(count > 10, "only {count} commands were found");
}

/// The lines in a page's sentences that show something.
fn shown(text: &str) -> Vec<&str> {
    let spans = text.split('`').skip(1).step_by(2);
    let whole = |span: &&str| span.starts_with("tailor show ") && span.contains(" --as ");
    spans.filter(whole).collect()
}

#[test]
fn show_as_sentences_have_it_is_understood_as_printed() {
    let mut count = 0;
    for page in pages() {
        for line in shown(&read(&page)) {
            count += 1;
            let words: Vec<&str> = line.split_whitespace().collect();
            tailor::check_arguments(&words).unwrap_or_else(|why| panic!("{page}: {line}\n{why}"));
        }
    }
    assert!(count > 2, "only {count} were found");
}

#[test]
fn commands_on_what_ships_run() {
    let mut count = 0;
    for page in pages() {
        for line in commands(&read(&page), "sh run") {
            count += 1;
            let out = run(&line);
            let printed = String::from_utf8_lossy(&out.stderr);
            assert!(out.status.success(), "{page}: {line}\n{printed}");
        }
    }
    assert!(count >= 4, "only {count} commands were found");
}

#[test]
fn a_command_that_is_not_there_is_found() {
    let text = "```sh\ntailor measure DIR --hight 3   # no\n```\n```text\ntailor nonsense\n```\n";
    let found = commands(text, "sh");
    assert_eq!(found, ["tailor measure DIR --hight 3"]);
    let words: Vec<&str> = found[0].split_whitespace().collect();
    assert!(
        tailor::check_arguments(&words)
            .unwrap_err()
            .contains("--hight")
    );
}
