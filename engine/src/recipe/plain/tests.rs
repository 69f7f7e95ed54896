//! The plain reader beside the whole one, on a text changed in thousands of ways.

use super::tree;
use crate::recipe::toml_text::whole;

const PLAIN: &str = "about = \"größer\" # a comment\ngoal = [\"a\", \"b\",\n \"c\"]\n\n[input.s-1]\n\
    files = \"*.{jpg,png}\"\n[node.a]\nstage = \"x.y\"\nfrom = { t = \"@s-1\", u = \"b\" }\n\
    with = { n = -7, x = 0.25, on = true, w = [1.5, 2.0] }\n[sweep.s]\nwith = [\"v\"]\n[node.b]\n\
    stage = \"z\"\nn = 0\n";

#[test]
fn what_is_nested_deeply_is_left_to_the_whole_reader() {
    for (open, close) in [("{ a = ", "}"), ("[", "]")] {
        let text = format!("a = {}1{}", open.repeat(50_000), close.repeat(50_000));
        assert!(tree(&text).is_none());
    }
}

#[test]
fn plain_texts_are_read_as_the_whole_reader_reads_them() {
    let (full, mistakes) = whole(PLAIN);
    assert_eq!(mistakes, []);
    assert_eq!(items(&tree(PLAIN).unwrap()), items(&full));
}

/// Without the places of tables, which nobody asks for.
fn items(table: &super::Table<'_>) -> String {
    use super::Item;
    let mut text = String::new();
    for (key, spot) in table {
        let value = match &spot.item {
            Item::Table(inner) => format!("{{{}}}", items(inner)),
            other => format!("{other:?} at {:?}", spot.span),
        };
        text += &format!("{} at {:?}: {value}; ", key.name, key.span);
    }
    text
}

#[test]
fn what_is_changed_anywhere_is_left_to_the_whole_reader_or_read_as_it_does() {
    let mut taken = 0;
    let bytes: Vec<char> = PLAIN.chars().collect();
    for at in 0..bytes.len() {
        let put = "\"'[]{}=,.#\\\n\r\t -+_0179eatf\u{7f}\u{1}";
        let mut changed: Vec<Vec<char>> = vec![bytes.clone(), bytes.clone()];
        changed[0].remove(at);
        changed[1].truncate(at);
        for c in put.chars() {
            let (mut other, mut more) = (bytes.clone(), bytes.clone());
            other[at] = c;
            more.insert(at, c);
            changed.extend([other, more]);
        }
        for text in changed {
            let text: String = text.into_iter().collect();
            let Some(plain) = tree(&text) else { continue };
            let (full, mistakes) = whole(&text);
            assert_eq!(mistakes, [], "{text}");
            assert_eq!(items(&plain), items(&full), "{text}");
            taken += 1;
        }
    }
    assert!(taken > 1000, "only {taken} were plain");
}
