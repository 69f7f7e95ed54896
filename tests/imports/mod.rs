//! What the files of a crate name of each other, read from their text.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Words of code: names, `::` and single marks.
fn words(text: &str) -> Vec<String> {
    let product = text.split("#[cfg(test)]\nmod tests").next().unwrap();
    let mut words = Vec::new();
    let mut rest = product.chars().peekable();
    while let Some(c) = rest.next() {
        match c {
            '/' if rest.peek() == Some(&'/') => {
                rest.by_ref().find(|c| *c == '\n');
            }
            '"' => {
                while let Some(c) = rest.next().filter(|c| *c != '"') {
                    if c == '\\' {
                        rest.next();
                    }
                }
            }
            // A quote, a mark that is written after a backslash, or a lifetime.
            '\'' => {
                let first = rest.next();
                if first == Some('\\') {
                    rest.next();
                    rest.by_ref().find(|c| *c == '\'');
                } else if rest.peek() == Some(&'\'') {
                    rest.next();
                }
            }
            ':' if rest.peek() == Some(&':') => {
                rest.next();
                words.push("::".to_owned());
            }
            c if c.is_alphanumeric() || c == '_' => {
                let mut word = String::from(c);
                while let Some(c) = rest.next_if(|c| c.is_alphanumeric() || *c == '_') {
                    word.push(c);
                }
                words.push(word);
            }
            c if c.is_whitespace() => {}
            c => words.push(c.to_string()),
        }
    }
    words
}

/// The paths of a tree of imports that begins at `at`, and where it ends.
fn paths(words: &[String], mut at: usize) -> (Vec<Vec<String>>, usize) {
    let word = |at: usize| words.get(at).map_or("", String::as_str);
    if word(at) == "{" {
        let mut all = Vec::new();
        at += 1;
        while word(at) != "}" && at < words.len() {
            let (some, end) = paths(words, at);
            all.extend(some);
            at = if word(end) == "," {
                end + 1
            } else {
                end.max(at + 1)
            };
        }
        return (all, at + 1);
    }
    let first = word(at).to_owned();
    if word(at + 1) == "::" {
        let (mut tails, end) = paths(words, at + 2);
        tails.iter_mut().for_each(|t| t.insert(0, first.clone()));
        return (tails, end);
    }
    // What it is called from here on.
    let end = if word(at + 1) == "as" { at + 3 } else { at + 1 };
    let path = if first == "self" { vec![] } else { vec![first] };
    (vec![path], end)
}

/// What a file names.
#[derive(Default)]
struct Named {
    /// Modules that it declares.
    children: BTreeSet<String>,
    /// Paths that it passes on.
    passed: Vec<Vec<String>>,
    /// All other paths.
    used: Vec<Vec<String>>,
}

fn named(words: &[String]) -> Named {
    let word = |at: usize| words.get(at).map_or("", String::as_str);
    let mut named = Named::default();
    for at in 0..words.len() {
        if word(at) == "mod" && word(at + 2) == ";" {
            named.children.insert(word(at + 1).to_owned());
        }
    }
    let mut at = 0;
    while at < words.len() {
        if word(at) == "use" {
            let (paths, end) = paths(words, at + 1);
            let public = word(at.wrapping_sub(1)) == "pub"
                || word(at.wrapping_sub(1)) == ")" && word(at.wrapping_sub(4)) == "pub";
            let to = if public {
                &mut named.passed
            } else {
                &mut named.used
            };
            to.extend(paths);
            at = end;
            continue;
        }
        let starts =
            ["crate", "super", "self"].contains(&word(at)) || named.children.contains(word(at));
        if starts
            && word(at + 1) == "::"
            && word(at.wrapping_sub(1)) != "::"
            && word(at.wrapping_sub(1)) != "$"
        {
            let mut path = vec![word(at).to_owned()];
            while word(at + 1) == "::" && word(at + 2) != "<" && word(at + 2) != "{" {
                path.push(word(at + 2).to_owned());
                at += 2;
            }
            named.used.push(path);
        }
        at += 1;
    }
    named
}

/// The files of a crate by the module that each is.
pub(crate) struct Crate {
    files: BTreeMap<Vec<String>, (PathBuf, Named)>,
}

impl Crate {
    pub(crate) fn read(src: &Path) -> Crate {
        let mut files = BTreeMap::new();
        let mut open = vec![(src.to_path_buf(), vec![])];
        while let Some((folder, module)) = open.pop() {
            for path in std::fs::read_dir(&folder)
                .unwrap()
                .map(|e| e.unwrap().path())
            {
                let stem = path.file_stem().unwrap().to_str().unwrap().to_owned();
                let inner = || [&module[..], std::slice::from_ref(&stem)].concat();
                if path.is_dir() {
                    open.push((path.clone(), inner()));
                } else if path.extension().is_some_and(|e| e == "rs") {
                    let own = match stem.as_str() {
                        "lib" | "main" if module.is_empty() => vec![],
                        "mod" => module.clone(),
                        _ => inner(),
                    };
                    let text = std::fs::read_to_string(&path).unwrap();
                    files.insert(own, (path, named(&words(&text))));
                }
            }
        }
        Crate { files }
    }

    /// A path as it is in a module, from the crate's root. `None` for another crate's.
    fn whole(&self, module: &[String], path: &[String]) -> Option<Vec<String>> {
        let (first, rest) = path.split_first()?;
        let mut whole = match first.as_str() {
            "crate" => vec![],
            "self" => module.to_vec(),
            "super" => module[..module.len().checked_sub(1)?].to_vec(),
            child if self.files[module].1.children.contains(child) => [module, &path[..1]].concat(),
            _ => return None,
        };
        for part in rest {
            if part == "super" {
                whole.pop();
            } else {
                whole.push(part.clone());
            }
        }
        Some(whole)
    }

    /// The module whose file defines what a path from the root names, followed through what is passed on.
    fn home(&self, whole: &[String], depth: usize) -> Vec<String> {
        let known = (0..=whole.len())
            .rev()
            .find(|n| self.files.contains_key(&whole[..*n]));
        let (module, rest) = whole.split_at(known.expect("bug: the root is a module"));
        let Some(name) = rest.first().filter(|_| depth < 9) else {
            return module.to_vec();
        };
        for passed in &self.files[module].1.passed {
            let through = passed.last().is_some_and(|last| last == name);
            if let Some(to) = self.whole(module, passed).filter(|_| through) {
                return self.home(&to, depth + 1);
            }
        }
        module.to_vec()
    }

    /// From each file to those that it needs, as names from the folder `root` on.
    pub(crate) fn arrows(&self, root: &Path) -> BTreeMap<String, BTreeSet<String>> {
        let name = |module: &Vec<String>| {
            let path = self.files[module].0.strip_prefix(root).unwrap();
            path.to_str().unwrap().replace('\\', "/")
        };
        let of = |(module, (_, named)): (&Vec<String>, &(PathBuf, Named))| {
            let wholes = named
                .used
                .iter()
                .filter_map(|path| self.whole(module, path));
            let homes = wholes.map(|whole| self.home(&whole, 0));
            let rest = homes.filter(|home| home != module);
            (name(module), rest.map(|home| name(&home)).collect())
        };
        self.files.iter().map(of).collect()
    }
}
