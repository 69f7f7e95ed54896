//! Captures, a cache with runs on them, and a command line that is asked there; and what is there afterwards.

use crate::traced::{Ended, Fault, run};
use engine::past;
use engine::store::{Store, retention};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// What only the first capture has: words in its files, and its name.
pub(crate) const NEEDLES: [&str; 2] = ["needleword", "needlefolder"];
/// What only the second one has.
pub(crate) const OTHER: &str = "otherword";

/// The folder of a test: `base` is as each round begins, `work` is where it goes on.
pub(crate) struct Place(tempfile::TempDir);

fn copied(from: &Path, to: &Path) {
    fs::create_dir(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        let to = to.join(entry.file_name());
        match entry.file_type().unwrap().is_dir() {
            true => copied(&entry.path(), &to),
            false => _ = fs::copy(entry.path(), to).unwrap(),
        }
    }
}

/// All files below a folder.
fn below(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).into_iter().flatten() {
        let path = entry.unwrap().path();
        match path.is_dir() && !path.is_symlink() {
            true => found.extend(below(&path)),
            false => found.push(path),
        }
    }
    found
}

impl Place {
    /// Two captures, and a pipeline with a program; no run yet.
    pub(crate) fn new() -> Place {
        let place = Place(proof::in_memory());
        for (capture, word) in [(NEEDLES[1], NEEDLES[0]), ("other", OTHER)] {
            let folder = place.at(capture);
            fs::create_dir_all(&folder).unwrap();
            fs::write(folder.join("one.txt"), format!("{word} and more")).unwrap();
            fs::write(folder.join("two.txt"), format!("{word} {word}s")).unwrap();
        }
        let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/words");
        for file in ["words.toml", "program.toml", "longest.sh"] {
            fs::copy(example.join(file), place.at(file)).unwrap();
        }
        place
    }

    pub(crate) fn at(&self, name: &str) -> PathBuf {
        self.0.path().join("work").join(name)
    }

    pub(crate) fn cache(&self) -> PathBuf {
        self.at("cache")
    }

    /// As it is now each round begins.
    pub(crate) fn is_base(&self) {
        fs::rename(self.0.path().join("work"), self.0.path().join("base")).unwrap();
    }

    pub(crate) fn begin(&self) {
        let work = self.0.path().join("work");
        let _ = fs::remove_dir_all(&work);
        copied(&self.0.path().join("base"), &work);
    }

    /// Asks a command line; a word in capitals is a path.
    pub(crate) fn asked(&self, line: &str, fault: Fault) -> Ended {
        let path = |name: &str| self.at(name).display().to_string();
        let word = |word: &str| match word {
            "PROGRAM" => path("program.toml"),
            "WORDS" => path("words.toml"),
            "FIRST" => path(NEEDLES[1]),
            "OTHER" => path("other"),
            "IN=FIRST" => format!("texts={}", path(NEEDLES[1])),
            "IN=OTHER" => format!("texts={}", path("other")),
            "OUT" => path("out"),
            "STORE" => format!("file://{}", path("store")),
            "PLAN" => self.plan(),
            word => word.to_owned(),
        };
        let all = format!("words {line} --cache {}", path("cache"));
        let words: Vec<String> = all.split(' ').map(word).collect();
        run(&words, &path("state"), fault)
    }

    /// As [`Place::asked`], without a fault; it ends well.
    pub(crate) fn sound(&self, line: &str) -> Ended {
        let ended = self.asked(line, Fault::None);
        assert_eq!(ended.code, Some(0), "{line}: {ended:?}");
        ended
    }

    /// A file of the cache that has one of these words.
    pub(crate) fn left(&self, words: &[&str]) -> Option<PathBuf> {
        let has = |path: &PathBuf| {
            let bytes = fs::read(path).unwrap_or_default();
            let text = String::from_utf8_lossy(&bytes);
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            words
                .iter()
                .any(|word| text.contains(word) || name.contains(word))
        };
        below(&self.cache()).into_iter().find(has)
    }

    pub(crate) fn store(&self) -> Store {
        Store::open(&self.cache()).unwrap()
    }

    /// The contents of what the last run has, and of what is pinned.
    pub(crate) fn kept(&self) -> BTreeSet<String> {
        let pins = self.store().pins().unwrap().into_iter().map(|(_, run)| run);
        past::contents(&self.cache(), 1, &pins.collect()).unwrap()
    }

    /// Contents whose bytes are there.
    pub(crate) fn blobs(&self) -> BTreeSet<String> {
        let name = |path: PathBuf| path.file_name()?.to_str().map(str::to_owned);
        let all = below(&self.cache().join("cas")).into_iter();
        all.filter_map(name).collect()
    }

    /// The id of the last run.
    pub(crate) fn last_run(&self) -> String {
        past::ids(&self.cache()).swap_remove(0)
    }

    /// Cuts the last byte off the first file of a shelf.
    pub(crate) fn spoil(&self, shelf: &str) {
        let first = below(&self.cache().join(shelf)).swap_remove(0);
        let mut bytes = fs::read(&first).unwrap();
        bytes.pop();
        fs::write(&first, bytes).unwrap();
    }

    /// The names of all files in a folder and below it.
    pub(crate) fn names(&self, folder: &str) -> BTreeSet<String> {
        let name = |path: PathBuf| path.file_name()?.to_str().map(str::to_owned);
        let all = below(&self.at(folder)).into_iter();
        all.filter_map(name).collect()
    }

    /// All objects of the store by their name, without the line that names who wrote them.
    #[cfg(feature = "remote")]
    pub(crate) fn objects(&self) -> std::collections::BTreeMap<String, Vec<u8>> {
        let store = self.at("store");
        let object = |path: PathBuf| {
            let name = path.strip_prefix(&store).unwrap().display().to_string();
            let bytes = fs::read(&path).unwrap();
            let head = bytes.starts_with(b"stage shared");
            let lines = bytes.splitn(2, |byte| head && *byte == b'\n');
            (name, lines.last().unwrap_or_default().to_vec())
        };
        below(&store).into_iter().map(object).collect()
    }

    /// As if no result had reached the store yet: all wait for it, and nobody knows what is there.
    #[cfg(feature = "remote")]
    pub(crate) fn all_waits(&self) {
        let tag = self.names("cache/shared").pop_first().expect("a store");
        fs::remove_dir_all(self.at("cache/shared")).unwrap();
        fs::create_dir_all(self.at("cache/waiting")).unwrap();
        for key in self.names("cache/ac") {
            fs::write(self.at("cache/waiting").join(format!("{key}-{tag}")), "").unwrap();
        }
        for shelf in ["store/ac", "store/cas"] {
            let _ = fs::remove_dir_all(self.at(shelf));
        }
    }

    /// The name of a plan.
    fn plan(&self) -> String {
        self.names("cache/plans").pop_first().expect("a plan")
    }

    /// Everything in the cache is what it should be.
    pub(crate) fn holds(&self) -> Result<(), String> {
        let bad = self.cache().join("format").exists()
            && !retention::verify(&self.store()).is_ok_and(|bad| bad == 0);
        (!bad)
            .then_some(())
            .ok_or_else(|| "something is corrupt".into())
    }

    /// Files that somebody was writing, and folders of programs.
    pub(crate) fn litter(&self) -> Vec<PathBuf> {
        let all = ["tmp", "exec"].map(|name| below(&self.cache().join(name)));
        all.concat()
    }
}
