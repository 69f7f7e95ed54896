//! Links and the table of contents.

use crate::{pages, place, read};

/// Where a page's links lead, without those that leave the repository.
pub(crate) fn links(text: &str) -> Vec<String> {
    let parts = text.split("](").skip(1);
    let ends = parts.filter_map(|part| part.split_once(')').map(|(link, _)| link));
    ends.filter(|l| !l.contains("://") && !l.starts_with('#'))
        .map(|l| l.split('#').next().unwrap_or_default().to_owned())
        .collect()
}

#[test]
fn every_link_leads_to_a_file() {
    let mut broken = Vec::new();
    for page in pages() {
        let folder = place(&page).parent().unwrap().to_owned();
        let lost = links(&read(&page)).into_iter();
        let lost = lost.filter(|link| !folder.join(link).exists());
        broken.extend(lost.map(|link| format!("{page}: {link}")));
    }
    assert_eq!(broken, Vec::<String>::new());
}

#[test]
fn every_chapter_stands_in_the_table_of_contents() {
    let listed = links(&read("docs/SUMMARY.md"));
    let chapters = pages().into_iter().filter_map(|p| {
        let name = p.strip_prefix("docs/")?.to_owned();
        (name != "SUMMARY.md").then_some(name)
    });
    let missing: Vec<String> = chapters.filter(|name| !listed.contains(name)).collect();
    assert_eq!(missing, Vec::<String>::new(), "not in docs/SUMMARY.md");
}
