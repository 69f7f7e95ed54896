//! A param that is a section: entries that the user names, each with params of its own.
//!
//! In a pipeline file an entry is a table of the top level, called like the param:
//!
//! ```toml
//! [girth.mid_thigh]
//! part = "thigh"
//! at = 0.5
//! ```
//!
//! Every node whose stage has such a param gets it; `with` and `--set NODE.girth.mid_thigh.at=0.4`
//! change single entries of one node.

use crate::{Mistake, ParamSpec, ParamType, Params, Value};
use std::collections::BTreeMap;

/// Entries by name, in the order of their names.
#[derive(Debug, Clone, PartialEq)]
pub struct Named<P>(pub BTreeMap<String, P>);

impl<P> Default for Named<P> {
    fn default() -> Self {
        Named(BTreeMap::new())
    }
}

impl<P: Params> ParamType for Named<P> {
    const NAME: &'static str = "a section of named tables";

    fn entry() -> Option<Vec<ParamSpec>> {
        Some(P::specs())
    }

    fn read(value: &Value) -> Option<Self> {
        let mut mistakes = Vec::new();
        let read = Self::read_within("", value, &mut mistakes)?;
        mistakes.is_empty().then_some(read)
    }

    fn read_within(name: &str, value: &Value, mistakes: &mut Vec<Mistake>) -> Option<Self> {
        let Value::Table(entries) = value else {
            mistakes.push(no_table(name.to_owned(), value));
            return None;
        };
        let mut read = BTreeMap::new();
        for (entry, given) in entries {
            let at = format!("{name}.{entry}");
            let Value::Table(keys) = given else {
                mistakes.push(no_table(at, given));
                continue;
            };
            match P::read(keys) {
                Ok(params) => {
                    read.insert(entry.clone(), params);
                }
                Err(all) => {
                    let within = |m: Mistake| Mistake {
                        name: format!("{at}.{}", m.name),
                        what: m.what,
                    };
                    mistakes.extend(all.into_iter().map(within));
                }
            }
        }
        Some(Named(read))
    }

    fn value(&self) -> Value {
        let table = |params: &P| {
            let values = params.values().into_iter();
            Value::Table(values.map(|(key, v)| (key.to_owned(), v)).collect())
        };
        let entries = self.0.iter();
        Value::Table(entries.map(|(name, p)| (name.clone(), table(p))).collect())
    }
}

fn no_table(at: String, value: &Value) -> Mistake {
    let what = crate::param_type::unlike("a table", value);
    Mistake { name: at, what }
}

#[cfg(test)]
#[allow(unreachable_pub)]
mod tests {
    use super::*;

    crate::params! {
        /// A cake.
        pub struct Cake {
            /// How many eggs.
            #[range(0..=12)]
            #[must(give)]
            eggs: u32 = 2,
            /// Its name.
            called: String = String::new(),
        }
    }

    crate::params! {
        /// An oven.
        pub struct Oven {
            /// What is in it.
            cake: Named<Cake> = Named::default(),
        }
    }

    fn table(entries: &[(&str, Value)]) -> Value {
        let own = |(name, value): &(&str, Value)| ((*name).to_owned(), value.clone());
        Value::Table(entries.iter().map(own).collect())
    }

    #[test]
    fn entries_are_read_filled_up_and_written_in_one_way() {
        let given = [("plain".to_owned(), table(&[("eggs", Value::Int(3))]))];
        let given = BTreeMap::from([("cake".to_owned(), Value::Table(given.into()))]);
        let oven = Oven::read(&given).unwrap();
        assert_eq!(oven.cake.0["plain"].eggs, 3);
        let (name, value) = oven.values().remove(0);
        let text = "{ \"plain\" = { \"called\" = \"\", \"eggs\" = 3 } }";
        assert_eq!((name, value.to_string().as_str()), ("cake", text));
        assert_eq!(Oven::specs()[0].entry.as_ref().unwrap().len(), 2);
    }

    #[test]
    fn what_is_wrong_within_an_entry_is_refused_with_its_place() {
        let wrong = |entry: Value| {
            let given = BTreeMap::from([("cake".to_owned(), table(&[("a", entry)]))]);
            Oven::read(&given).unwrap_err()
        };
        for (entry, at, what) in [
            (Value::Int(1), "cake.a", "wants a table"),
            (table(&[]), "cake.a.eggs", "must be given"),
            (table(&[("eggs", Value::Int(13))]), "cake.a.eggs", "0..=12"),
            (
                table(&[("eggs", Value::Int(1)), ("egs", Value::Int(1))]),
                "cake.a.egs",
                "did you mean `eggs`",
            ),
        ] {
            let mistakes = wrong(entry);
            assert_eq!(mistakes.len(), 1, "{mistakes:?}");
            assert_eq!(mistakes[0].name, at);
            assert!(mistakes[0].what.contains(what), "{mistakes:?}");
        }
    }
}
