//! Whose captures are given: files read, people recognised by names.

use crate::girth_file::{GirthFile, find};
use shape::Unit;
use std::path::{Path, PathBuf};

/// How it is decided whose captures are the same person's.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum By {
    /// What is left of the folder's name without `-out` and digits at its end: `anna-1`, `anna-2026-05-01`
    Name,
    /// The folder that the capture is in
    Folder,
    /// All are one person
    One,
}

/// A capture that was measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Capture {
    /// What people call it: the folder's name.
    pub name: String,
    /// Whose it is.
    pub person: String,
    /// The folder of results.
    pub folder: PathBuf,
    /// What was measured.
    pub girths: GirthFile,
}

/// Whose capture it is, by the name of its folder.
fn person(name: &str) -> &str {
    let name = name.strip_suffix("-out").unwrap_or(name);
    let short = name.trim_end_matches(|c: char| c.is_ascii_digit() || "-_. ".contains(c));
    match short.is_empty() {
        true => name,
        false => short,
    }
}

fn last(path: Option<&Path>) -> String {
    let name = path.and_then(Path::file_name);
    name.map_or_else(String::new, |n| n.to_string_lossy().into_owned())
}

/// Reads captures: folders of results, their `girths.json`, or captures beside whose folder the results are.
///
/// # Errors
///
/// One that was not measured or cannot be read, the same twice, or one without a scale.
pub fn captures(paths: &[PathBuf], by: By) -> Result<Vec<Capture>, String> {
    let mut all: Vec<Capture> = Vec::new();
    for path in paths {
        let file = find(path)?;
        let file = file
            .canonicalize()
            .map_err(|e| format!("{}: {e}", file.display()))?;
        let text = std::fs::read(&file).map_err(|e| format!("{}: {e}", file.display()))?;
        let girths = GirthFile::read(&String::from_utf8_lossy(&text))
            .map_err(|e| format!("{}: {e}", file.display()))?;
        let folder = file.parent().unwrap_or(Path::new("/")).to_owned();
        let name = last(Some(&folder));
        if girths.unit == Unit::Relative {
            return Err(format!(
                "{name}: its lengths are relative, for nothing of known length was given or known lengths contradict each other, so they cannot be compared with those of another capture: \
                 give one when measuring, such as --stature"
            ));
        }
        if all.iter().any(|c| c.folder == folder) {
            return Err(format!("{} is given twice", folder.display()));
        }
        let person = match by {
            By::Name => person(&name).to_owned(),
            By::Folder => last(folder.parent()),
            By::One => "one".into(),
        };
        all.push(Capture {
            name,
            person,
            folder,
            girths,
        });
    }
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn people_are_recognised_by_what_is_left_of_a_name() {
        for (name, want) in [
            ("anna-1", "anna"),
            ("anna_2-out", "anna"),
            ("anna-2026-05-01", "anna"),
            ("anna", "anna"),
            ("p01 b", "p01 b"),
            ("2026-05-01", "2026-05-01"),
        ] {
            assert_eq!(person(name), want);
        }
    }

    #[test]
    fn captures_without_a_scale_and_the_same_twice_are_refused() {
        let place = tempfile::tempdir().unwrap();
        let put = |name: &str, text: &str| {
            let folder = place.path().join(name);
            std::fs::create_dir(&folder).unwrap();
            std::fs::write(folder.join("girths.json"), text).unwrap();
            folder
        };
        let one = put("anna-1", r#"{"unit":"cm","girths":[]}"#);
        let relative = put("anna-2", r#"{"unit":"relative","girths":[]}"#);
        let read = captures(std::slice::from_ref(&one), By::Name).unwrap();
        assert_eq!(
            (read[0].name.as_str(), read[0].person.as_str()),
            ("anna-1", "anna")
        );
        let why = captures(&[one.clone(), relative], By::Name).unwrap_err();
        assert!(why.starts_with("anna-2: its lengths are relative"), "{why}");
        let why = captures(&[one.clone(), one.join("girths.json")], By::Name).unwrap_err();
        assert!(why.ends_with("is given twice"), "{why}");
    }
}
