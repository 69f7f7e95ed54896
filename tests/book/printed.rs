//! What a page shows under a command marked `sh screen` is what the program prints; a line `…` replaces some lines.

use super::{pages, read, run};

/// Each command of a page's blocks `sh screen`, and the block `text` that follows it.
fn screens(text: &str) -> Vec<(String, String)> {
    let blocks = text.split("```sh screen\n").skip(1);
    let screen = |block: &str| {
        let (command, rest) = block.split_once("```").expect("an open block");
        let shown = rest.split_once("```text\n").expect("no screen follows").1;
        let shown = shown.split_once("```").expect("an open block").0;
        (command.trim().to_owned(), shown.to_owned())
    };
    blocks.map(screen).collect()
}

/// Whether what is shown is printed, in this order.
fn holds(shown: &str, printed: &str) -> bool {
    let mut rest = printed;
    for part in shown.split("…\n").map(str::trim_end) {
        let Some(at) = rest.find(part) else {
            return false;
        };
        rest = &rest[at + part.len()..];
    }
    shown.ends_with("…\n") || rest.trim().is_empty()
}

#[test]
fn screens_are_what_the_program_prints() {
    let mut count = 0;
    for page in pages() {
        for (line, shown) in screens(&read(&page)) {
            count += 1;
            let out = run(&line);
            let printed = [out.stdout, out.stderr].concat();
            let printed = String::from_utf8_lossy(&printed);
            assert!(
                holds(&shown, &printed),
                "{page}: {line}\nshown:\n{shown}\nprinted:\n{printed}"
            );
        }
    }
    assert!(count >= 4, "only {count} screens were found");
}

#[test]
fn a_screen_that_differs_is_found() {
    let page = "```sh screen\ntailor x\n```\n\nIt prints:\n\n```text\na\n…\nc\n```\n";
    let (line, shown) = screens(page).remove(0);
    assert_eq!(line, "tailor x");
    assert!(holds(&shown, "a\nb\nc\n"));
    assert!(!holds(&shown, "a\nb\nd\n"));
    assert!(!holds(&shown, "a\nb\nc\nd\n"));
}
