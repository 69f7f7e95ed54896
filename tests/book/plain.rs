//! The book is short and plain: words of all its pages, words of a sentence, no figure written by hand.

use super::links::links;
use super::read;

/// Words of all its pages.
const MOST_WORDS: usize = 20_000;

/// Words of a sentence.
const LONGEST: usize = 30;

/// Words that end with a point and no sentence.
const ABBREVIATIONS: [&str; 6] = ["eq.", "al.", "e.g.", "i.e.", "vs.", "no."];

/// The book's pages.
fn pages() -> Vec<String> {
    let listed = links(&read("docs/SUMMARY.md")).into_iter();
    listed.map(|name| format!("docs/{name}")).collect()
}

/// How many words a text has; lines of tables are none.
fn words(text: &str) -> usize {
    let words = text.split_whitespace();
    words
        .filter(|word| word.chars().any(char::is_alphanumeric))
        .count()
}

/// What follows the mark of a list's item.
fn item(line: &str) -> Option<&str> {
    let (mark, rest) = line.split_once(' ')?;
    let number = mark.strip_suffix('.').map(str::as_bytes);
    let numbered = number.is_some_and(|n| !n.is_empty() && n.iter().all(u8::is_ascii_digit));
    (numbered || ["-", "*"].contains(&mark)).then_some(rest)
}

/// A page's paragraphs and items of lists, without code, tables, headings and comments.
fn paragraphs(text: &str) -> Vec<String> {
    let (mut all, mut code) = (vec![String::new()], false);
    for line in text.lines() {
        let fence = line.starts_with("```");
        code ^= fence;
        let begun = line.trim();
        let left_out = ["|", "#", "<!--"].iter().any(|m| begun.starts_with(m));
        if fence || code || left_out || begun.is_empty() || line.starts_with("    ") {
            all.push(String::new());
            continue;
        }
        if item(begun).is_some() {
            all.push(String::new());
        }
        let last = all.last_mut().unwrap();
        *last += item(begun).unwrap_or(begun);
        last.push(' ');
    }
    all
}

/// A paragraph with a word in place of each piece of code, and without what its links lead to.
fn spoken(paragraph: &str) -> String {
    let pieces = paragraph.split('`').enumerate();
    let pieces = pieces.map(|(k, piece)| if k % 2 == 1 { "code" } else { piece });
    let text: String = pieces.collect();
    let mut parts = text.split("](");
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |text, part| {
        text + part.split_once(')').map_or("", |(_, rest)| rest)
    })
}

/// The sentences of a page.
fn sentences(text: &str) -> Vec<String> {
    let mut all = Vec::new();
    for paragraph in paragraphs(text) {
        let mut sentence: Vec<&str> = Vec::new();
        let spoken = spoken(&paragraph);
        for word in spoken.split_whitespace() {
            sentence.push(word);
            let bare = word.trim_end_matches(['*', '_', ')', '"', '”', ']']);
            let ends = bare.ends_with(['.', '!', '?']);
            if ends && !ABBREVIATIONS.contains(&bare.to_lowercase().as_str()) {
                all.push(sentence.join(" "));
                sentence.clear();
            }
        }
        all.push(sentence.join(" "));
    }
    all.retain(|sentence| !sentence.is_empty());
    all
}

/// Sentences that nobody reads in one breath.
fn too_long(text: &str) -> Vec<String> {
    let mut all = sentences(text);
    all.retain(|sentence| words(sentence) > LONGEST);
    all
}

#[test]
fn the_book_is_short() {
    let of = |page: &String| words(&read(page));
    let words: usize = pages().iter().map(of).sum();
    assert!(words <= MOST_WORDS, "{words} words");
}

#[test]
fn no_sentence_of_the_book_is_long() {
    let found = pages().into_iter().flat_map(|page| {
        let long = too_long(&read(&page)).into_iter();
        long.map(move |sentence| format!("{page}: {sentence}"))
    });
    assert_eq!(found.collect::<Vec<_>>(), Vec::<String>::new());
}

#[test]
fn no_figure_of_the_book_is_written_by_hand() {
    let mut by_hand = pages();
    by_hand.retain(|page| read(page).contains("*Written by hand"));
    assert_eq!(by_hand, Vec::<String>::new());
}

#[test]
fn a_long_sentence_is_found_wherever_it_is() {
    let of = |words: usize| vec!["word"; words].join(" ");
    let long = of(LONGEST + 1);
    assert_eq!(too_long(&format!("{}. And more.", of(LONGEST))), [""; 0]);
    for page in [
        format!("# Head\n\n{long}.\n"),
        format!("Short.\n- one\n- {long}\n1. two\n"),
        format!("{}\n[link](of many words) `{}` more.", of(28), of(9)),
        format!("{} et al. (2007) and {}.", of(15), of(15)),
    ] {
        assert_eq!(too_long(&page).len(), 1, "{page}");
    }
    let elsewhere = format!("```text\n{long}\n```\n\n    {long}\n\n| {long} |\n\n## {long}\n");
    assert_eq!(too_long(&elsewhere), [""; 0]);
}
