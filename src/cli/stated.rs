//! Flags as changes of a pipeline.

use crate::catalog::{CATALOG, PERSONAL};
use crate::graph::Graph;
use crate::recipe::{Overrides, Pipeline};
use command::Fault;
use stage::message;

stage::messages! {
    GIVEN = "cli-given": "`{flag}`: {what}";
}

/// The node that reads the photos, and its param that takes facts.
const PLACE: &str = "photos.facts";

/// The node that reads who is measured, and its param; what is given there is in no key of the photos.
const PERSON: &str = "person.facts";

/// The day, if it is to be read from the photos.
const BY_EXIF: (&str, &str) = ("date", "exif");

/// The param that takes a key of `capture.toml`.
pub(super) fn place(key: &str) -> String {
    let node = match PERSONAL.contains(&key) {
        true => PERSON,
        false => PLACE,
    };
    format!("{node}.{key}")
}

/// A flag as it was given, and the change of the pipeline that it is.
#[derive(Clone)]
pub(super) struct Stated {
    pub(super) flag: String,
    pub(super) set: String,
}

/// All that was given.
pub(super) struct All(pub(super) Vec<Stated>);

impl All {
    /// A flag with its value, and the key of capture.toml that it is.
    pub(super) fn put(
        &mut self,
        flag: &str,
        stated: &impl ToString,
        key: &str,
        value: &impl ToString,
    ) {
        let (stated, value) = (stated.to_string(), value.to_string());
        let mut put = |place: String| {
            let (flag, set) = (format!("{flag} {stated}"), format!("{place}={value}"));
            self.0.push(Stated { flag, set });
        };
        put(place(key));
        if (key, value.trim_matches('"')) == BY_EXIF {
            put(format!("{PLACE}.{key}"));
        }
    }
}

/// A built-in pipeline, or `over`, another one, as if it extended that, with what is given of the capture, and
/// over it what the user sets himself; a flag is named as it was given.
pub(super) fn opened(
    name: &str,
    over: Option<&str>,
    variant: Option<String>,
    stated: &[Stated],
    sets: &[String],
) -> Result<Graph, Fault> {
    let facts = stated.iter().map(|s| s.set.clone());
    let overrides = Overrides {
        variant,
        sets: facts.chain(sets.iter().cloned()).collect(),
    };
    let pipeline = match over {
        Some(over) => Pipeline::built_in_over(over, name, &CATALOG),
        None => Pipeline::built_in(name, &CATALOG),
    };
    let graph = pipeline.and_then(|p| p.graph(&overrides));
    graph.map_err(|mut mistakes| {
        for mistake in &mut mistakes.all {
            let field = |name: &str| mistake.what.fields().get(name).cloned();
            let given = stated
                .iter()
                .find(|s| field("set") == Some((&s.set).into()));
            if let (Some(given), Some(what)) = (given, field("what")) {
                mistake.what = message!(GIVEN, flag = &given.flag, what = what);
            }
        }
        Fault::mistakes(mistakes)
    })
}
