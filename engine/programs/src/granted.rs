//! What is to be known of a program that may run, before it does: what its identity prints, and what it reads beside.

use crate::program::{Grant, Program};
use crate::{reads, run};
use std::path::{Path, PathBuf};

impl Program {
    /// What is wrong with it, if it was asked what it is.
    pub fn asked(&self) -> Option<Option<&str>> {
        self.granted.0.get().map(Grant::wrong)
    }

    /// Asks what it is, in the folder of a store; from then on it may run. What is wrong with it.
    pub fn ask(&self, folder: PathBuf, stop: &dyn Fn() -> bool) -> Option<&str> {
        let grant = self.granted(folder, stop);
        self.granted.0.get_or_init(|| grant).wrong()
    }

    /// What is to be known of it before it runs.
    fn granted(&self, folder: PathBuf, stop: &dyn Fn() -> bool) -> Grant {
        let program = self;
        let permission = program.permission();
        let identity = (!program.identity.is_empty()).then(|| {
            program.identities.get(permission, || {
                let printed = run::identity(program, &folder, stop);
                let printed = printed.map_err(|why| why.to_string())?;
                Ok(printed.unwrap_or_default())
            })
        });
        let content = |path: &String| {
            program.identities.get(stage::hash(path.as_bytes()), || {
                let reported = |why| format!("`reads`: {path}: {why}");
                // The cache is in nobody's key, and nobody's to see.
                match folder.starts_with(
                    Path::new(path)
                        .canonicalize()
                        .map_err(|why| reported(why.to_string()))?,
                ) {
                    true => Err(reported("holds the cache: name what is read of it".into())),
                    false => Ok(reads::content(path)
                        .map_err(|why| reported(why.to_string()))?
                        .to_hex()
                        .to_string()),
                }
            })
        };
        Grant {
            reads: program.reads.iter().map(content).collect(),
            stamps: program
                .reads
                .iter()
                .map(|path| reads::stamps(path).ok())
                .collect(),
            folder,
            identity,
        }
    }
}

impl Grant {
    /// Why something of it is not known.
    fn wrong(&self) -> Option<&str> {
        let known = self.identity.iter().chain(&self.reads);
        known
            .filter_map(|known| known.as_ref().err())
            .map(String::as_str)
            .next()
    }
}
