//! Screens of the program that docs show are those that `docs/screens/take` took; CI takes them anew.

use super::{pages, read};

/// Columns of a terminal as it comes.
const COLUMNS: usize = 80;

const SCREENS: [&str; 2] = ["docs/screens/measure.txt", "docs/screens/german.txt"];

#[test]
fn screens_fit_a_terminal_and_are_plain() {
    for name in SCREENS {
        let screen = read(name);
        assert!(screen.starts_with("$ "), "{name}");
        let strange = |l: &&str| l.chars().count() > COLUMNS || l.contains(char::is_control);
        let strange: Vec<_> = screen.lines().filter(strange).collect();
        assert_eq!(strange, [""; 0], "{name}");
    }
}

#[test]
fn what_a_page_shows_of_a_screen_is_on_it() {
    let screen = read(SCREENS[0]);
    let mut shown = 0;
    for page in pages() {
        let text = read(&page);
        // `…` replaces lines that are left out.
        let blocks = text.split("```text screen\n").skip(1);
        for block in blocks {
            let mut rest = screen.as_str();
            for line in block.split("```").next().unwrap().lines() {
                if ["", "…"].contains(&line) {
                    continue;
                }
                let at = rest.find(&format!("{line}\n"));
                let at =
                    at.unwrap_or_else(|| panic!("{page}: not on the screen, or not there: {line}"));
                rest = &rest[at + line.len()..];
            }
            shown += 1;
        }
    }
    assert!(shown > 0);
}
