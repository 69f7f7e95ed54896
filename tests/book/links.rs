//! Links and the table of contents.

use super::{pages, place, read};

/// Where a page's links lead, without those that leave the repository: a file, and a place in it.
fn leading(text: &str) -> Vec<(String, String)> {
    let parts = text.split("](").skip(1);
    let ends = parts.filter_map(|part| part.split_once(')').map(|(link, _)| link));
    ends.filter(|link| !link.contains("://"))
        .map(|link| link.split_once('#').unwrap_or((link, "")))
        .map(|(file, at)| (file.to_owned(), at.to_owned()))
        .collect()
}

/// The files that a page's links lead to.
pub(crate) fn links(text: &str) -> Vec<String> {
    let files = leading(text).into_iter().map(|(file, _)| file);
    files.filter(|file| !file.is_empty()).collect()
}

/// What a heading is called in a link.
fn called(heading: &str) -> String {
    let letter = |c: char| match c {
        ' ' => Some('-'),
        _ if c.is_alphanumeric() || "-_".contains(c) => Some(c.to_ascii_lowercase()),
        _ => None,
    };
    let heading = heading.trim_start_matches('#').trim();
    heading.chars().filter_map(letter).collect()
}

/// The places of a page that a link may lead to.
fn places(text: &str) -> Vec<String> {
    let headings = text.lines().filter(|l| l.starts_with('#')).map(called);
    let marked = text.split("id=\"").skip(1);
    let marked = marked.filter_map(|part| part.split_once('"').map(|(id, _)| id.to_owned()));
    headings.chain(marked).collect()
}

#[test]
fn every_link_leads_to_a_file_and_a_place_in_it() {
    let mut broken = Vec::new();
    let mut into = 0;
    for page in pages().into_iter().chain(["CHANGELOG.md".to_owned()]) {
        let folder = place(&page).parent().unwrap().to_owned();
        for (file, at) in leading(&read(&page)) {
            let to = match file.as_str() {
                "" => place(&page),
                file => folder.join(file),
            };
            let found = match (to.exists(), at.is_empty()) {
                (exists, true) => exists,
                (false, _) => false,
                (true, false) => {
                    into += 1;
                    places(&std::fs::read_to_string(&to).unwrap()).contains(&at)
                }
            };
            if !found {
                broken.push(format!("{page}: {file}#{at}"));
            }
        }
    }
    assert_eq!(broken, Vec::<String>::new());
    assert!(into > 10, "only {into} links into a page were found");
}

/// `mdbook` makes no page of what SUMMARY does not list.
#[test]
fn pages_of_the_book_lead_to_pages_of_the_book() {
    let listed = links(&read("docs/SUMMARY.md"));
    let mut broken = Vec::new();
    for page in &listed {
        let pages = links(&read(&format!("docs/{page}"))).into_iter();
        let outside = pages.filter(|link| link.ends_with(".md") && !listed.contains(link));
        broken.extend(outside.map(|link| format!("{page}: {link}")));
    }
    assert_eq!(broken, Vec::<String>::new());
}

#[test]
fn every_chapter_is_in_the_table_of_contents() {
    let listed = links(&read("docs/SUMMARY.md"));
    let chapters = pages().into_iter().filter_map(|p| {
        let name = p.strip_prefix("docs/")?.to_owned();
        (name != "SUMMARY.md" && !name.contains('/')).then_some(name)
    });
    let missing: Vec<String> = chapters.filter(|name| !listed.contains(name)).collect();
    assert_eq!(missing, Vec::<String>::new(), "not in docs/SUMMARY.md");
    let laboratory = listed.into_iter().filter(|name| name.contains('/'));
    assert_eq!(laboratory.collect::<Vec<_>>(), Vec::<String>::new());
}
