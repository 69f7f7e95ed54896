//! Patterns of files, and the order of their names.

use std::path::Path;

/// Whether a name fits a pattern: `*` is any run of characters within a folder, `{a,b}` either;
/// letters of the extension may be of either case. `*` takes no hidden file (`._0001.jpg`, which macOS
/// writes beside photos).
pub fn fits(pattern: &str, name: &str) -> bool {
    if let (Some(open), Some(close)) = (pattern.find('{'), pattern.find('}'))
        && open < close
    {
        let (head, tail) = (&pattern[..open], &pattern[close + 1..]);
        return pattern[open + 1..close]
            .split(',')
            .any(|w| fits(&format!("{head}{w}{tail}"), name));
    }
    // `first`: at the beginning of a name, where `*` takes no dot.
    fn glob(p: &[u8], n: &[u8], first: bool) -> bool {
        match (p.first(), n.first()) {
            (None, None) => true,
            (Some(b'*'), Some(b'.')) if first => false,
            (Some(b'*'), _) => {
                glob(&p[1..], n, false)
                    || n.first().is_some_and(|c| *c != b'/') && glob(p, &n[1..], false)
            }
            (Some(a), Some(b)) => a.eq_ignore_ascii_case(b) && glob(&p[1..], &n[1..], *b == b'/'),
            _ => false,
        }
    }
    glob(pattern.as_bytes(), name.as_bytes(), true)
}

/// Whether a pattern stays in the folder that it is of.
pub fn stays_inside(pattern: &str) -> bool {
    let words = expanded(pattern);
    let plain = |word: &str| !matches!(word, "" | "." | "..");
    words.iter().all(|w| w.split('/').all(plain))
}

/// Whether a file below `inner`, a path relative to the pattern's folder, might fit.
pub fn looks_into(pattern: &str, inner: &Path) -> bool {
    let inner: Vec<String> = inner
        .iter()
        .map(|name| name.to_string_lossy().into_owned())
        .collect();
    expanded(pattern).iter().any(|word| {
        let parts: Vec<&str> = word.split('/').collect();
        parts.len() > inner.len()
            && inner
                .iter()
                .zip(&parts)
                .all(|(name, part)| fits(part, name))
    })
}

/// A pattern without alternatives: one a way to choose.
fn expanded(pattern: &str) -> Vec<String> {
    let (Some(open), Some(close)) = (pattern.find('{'), pattern.find('}')) else {
        return vec![pattern.to_owned()];
    };
    if open > close {
        return vec![pattern.to_owned()];
    }
    let (head, tail) = (&pattern[..open], &pattern[close + 1..]);
    let words = pattern[open + 1..close].split(',');
    words
        .flat_map(|word| expanded(&format!("{head}{word}{tail}")))
        .collect()
}

/// A name as texts and numbers, so that `2.jpg` comes before `10.jpg`.
pub fn natural(name: &str) -> Vec<(String, u128)> {
    let mut parts = Vec::new();
    let mut rest = name;
    while !rest.is_empty() {
        let text = rest
            .find(|c: char| c.is_ascii_digit())
            .unwrap_or(rest.len());
        let tail = &rest[text..];
        let digits = tail
            .find(|c: char| !c.is_ascii_digit())
            .unwrap_or(tail.len());
        parts.push((
            rest[..text].to_lowercase(),
            tail[..digits].parse().unwrap_or(0),
        ));
        rest = &tail[digits..];
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_comes_before_ten() {
        let mut names = vec!["image_10.jpg", "image_2.jpg", "image_0.jpg"];
        names.sort_by_key(|n| natural(n));
        assert_eq!(names, ["image_0.jpg", "image_2.jpg", "image_10.jpg"]);
    }

    #[test]
    fn patterns_fit_what_they_describe() {
        assert!(fits("images/*.{jpg,jpeg,png}", "images/a.b.JPG"));
        assert!(!fits("*.jpg", "images/a.jpg"));
        assert!(!fits("*.{jpg,png}", "a.tif"));
        for hidden in ["._0001.jpg", "images/._0001.jpg", ".jpg"] {
            assert!(
                !fits("*.jpg", hidden) && !fits("images/*.jpg", hidden),
                "{hidden}"
            );
        }
        assert!(fits("images/a*.jpg", "images/a.b.jpg") && fits(".hidden/*.jpg", ".hidden/a.jpg"));
    }

    #[test]
    fn patterns_stay_in_their_folder_and_look_into_some_below() {
        for out in ["../a.jpg", "/etc/passwd", "a/../b", "{a,..}/b", "a//b", ""] {
            assert!(!stays_inside(out), "{out}");
        }
        assert!(stays_inside("images/*.{jpg,png}"));
        for (pattern, inner, looks) in [
            ("*.jpg", "", true),
            ("*.jpg", "out", false),
            ("images/*.jpg", "out", false),
            ("images/*.jpg", "images", true),
            ("images/*.jpg", "images/out", false),
            ("{a,b}/*.jpg", "b", true),
            ("*/a.txt", "out", true),
        ] {
            assert_eq!(
                looks_into(pattern, Path::new(inner)),
                looks,
                "{pattern} {inner}"
            );
        }
    }
}
