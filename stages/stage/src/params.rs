//! Params: each is one spot with its name and unit, a sentence, a default and a range.

use crate::{Message, NumberSource, Value};
use std::collections::BTreeMap;

/// One param, as the reference and the checker know it.
#[derive(Debug, Clone)]
pub struct ParamSpec {
    /// Its name, with the unit where the type has none: `voxel_mm`.
    pub name: &'static str,
    /// What it does, a sentence or two.
    pub doc: String,
    /// What a person would call the type.
    pub type_name: &'static str,
    /// The words it may be, where it is a choice.
    pub choices: &'static [&'static str],
    /// What it is when nothing is given.
    pub default: Value,
    /// Least and greatest value.
    pub range: Option<(f64, f64)>,
    /// Whether it must be given.
    pub required: bool,
    /// Where its default comes from, where it is a number.
    pub source: NumberSource,
    /// Whether it is the seed of noise in what a method is given: replicates of a sweep give each their own.
    pub seed: bool,
    /// What each entry holds, where it is a section of named entries: see [`Named`](crate::Named).
    pub entry: Option<Vec<ParamSpec>>,
}

impl ParamSpec {
    /// Whether it is one number.
    pub fn is_number(&self) -> bool {
        matches!(self.default, Value::Int(_) | Value::Float(_))
    }
}

/// What is wrong with one param.
#[derive(Debug, Clone, PartialEq)]
pub struct Mistake {
    /// The param as it was written; within a section `section.entry.key`.
    pub name: String,
    /// What is wrong, and what would fit.
    pub what: Message,
}

/// What the user may tune. Made by [`params!`](crate::params!).
pub trait Params: Clone + Default + Send + Sync + 'static {
    /// The names, in the order of the reference.
    fn names(to: &mut Vec<&'static str>);
    /// Every param with these values as its defaults, in the order of the reference.
    fn specs_to(&self, to: &mut Vec<ParamSpec>);
    /// Reads what was given; the rest stays as it is here. Names that are unknown are passed over.
    fn read_onto(self, given: &BTreeMap<String, Value>, mistakes: &mut Vec<Mistake>) -> Self;
    /// All values after defaults, in the order of the reference.
    fn values_to(&self, to: &mut Vec<(&'static str, Value)>);

    /// Every param, in the order of the reference.
    fn specs() -> Vec<ParamSpec> {
        let mut specs = Vec::new();
        Self::default().specs_to(&mut specs);
        specs
    }

    /// All values after defaults, in the order of the reference.
    fn values(&self) -> Vec<(&'static str, Value)> {
        let mut values = Vec::new();
        self.values_to(&mut values);
        values
    }

    /// Reads what was given; the rest keeps its default.
    ///
    /// # Errors
    /// Everything that is wrong, at once: unknown names, values that do not fit or are out of range.
    fn read(given: &BTreeMap<String, Value>) -> Result<Self, Vec<Mistake>> {
        let mut names = Vec::new();
        Self::names(&mut names);
        let unknown = given.keys().filter(|n| !names.contains(&n.as_str()));
        let mut mistakes: Vec<Mistake> = unknown
            .map(|name| Mistake {
                name: name.clone(),
                what: crate::unknown("param", name, &names),
            })
            .collect();
        let read = Self::default().read_onto(given, &mut mistakes);
        if mistakes.is_empty() {
            Ok(read)
        } else {
            Err(mistakes)
        }
    }
}

/// Declares a stage's params: doc, optional `#[range(lo..=hi)]`, optional `#[must(give)]` where there is
/// no sense in a default, `#[chance(seed)]` where it is the seed of noise in what a method is given (not of a method's
/// own dice), `#[source(…)]` (where the default comes from: `structural`, or `derived`, `cited`, `fitted`, `by_hand`
/// with the evidence, as in `cited = "Lowe 2004, §4.1"`), name, type, default.
///
/// `#[group(flat)]` makes a field a group that several stages share: its type is made by this macro,
/// its params are among the other ones under their own names, with the defaults given here.
#[macro_export]
macro_rules! params {
    (
        $(#[doc = $about:literal])*
        pub struct $struct:ident { $(
            $(#[doc = $doc:literal])*
            $(#[range($range:expr)])?
            $(#[must($must:ident)])?
            $(#[chance($chance:ident)])?
            $(#[group($group:ident)])?
            $(#[source($source:ident $(= $what:literal)?)])?
            $name:ident : $ty:ty = $default:expr
        ),* $(,)? }
    ) => {
        $(#[doc = $about])*
        #[derive(Debug, Clone, PartialEq)]
        pub struct $struct { $( $(#[doc = $doc])* pub $name: $ty, )* }

        impl Default for $struct {
            fn default() -> Self {
                Self { $( $name: $default, )* }
            }
        }

        impl $crate::Params for $struct {
            fn names(_to: &mut Vec<&'static str>) {
                $( $crate::params!(@names $($group)?, _to, $name, $ty); )*
            }

            fn specs_to(&self, _to: &mut Vec<$crate::ParamSpec>) {
                $( $crate::params!(
                    @specs $($group)?, _to, $name, $ty, self.$name,
                    [$($doc),*], $crate::params!(@range $($range)?), $crate::params!(@must $($must)?),
                    $crate::params!(@chance $($chance)?), $crate::params!(@source $($source $($what)?)?)
                ); )*
            }

            fn read_onto(
                self,
                _given: &std::collections::BTreeMap<String, $crate::Value>,
                _mistakes: &mut Vec<$crate::Mistake>,
            ) -> Self {
                Self { $( $name: $crate::params!(
                    @read $($group)?, $name, self.$name, _given, _mistakes,
                    $crate::params!(@range $($range)?), $crate::params!(@must $($must)?)
                ), )* }
            }

            fn values_to(&self, _to: &mut Vec<(&'static str, $crate::Value)>) {
                $( $crate::params!(@values $($group)?, _to, $name, self.$name); )*
            }
        }
    };
    (@names flat, $to:ident, $name:ident, $ty:ty) => { <$ty as $crate::Params>::names($to) };
    (@names , $to:ident, $name:ident, $ty:ty) => { $to.push(stringify!($name)) };
    (@specs flat, $to:ident, $name:ident, $ty:ty, $value:expr, $doc:tt, $range:expr, $must:expr, $seed:expr, $source:expr) => {
        $crate::Params::specs_to(&$value, $to)
    };
    (@specs , $to:ident, $name:ident, $ty:ty, $value:expr, $doc:tt, $range:expr, $must:expr, $seed:expr, $source:expr) => {
        $to.push($crate::ParamSpec {
            name: stringify!($name),
            doc: $doc.map(|l: &str| l.trim()).join(" ").replace("\\[", "[").replace("\\]", "]"),
            type_name: <$ty as $crate::ParamType>::NAME,
            choices: <$ty as $crate::ParamType>::CHOICES,
            default: $crate::ParamType::value(&$value),
            range: $range,
            required: $must,
            source: $source,
            seed: $seed,
            entry: <$ty as $crate::ParamType>::entry(),
        })
    };
    (@read flat, $name:ident, $value:expr, $given:ident, $mistakes:ident, $range:expr, $must:expr) => {
        $crate::Params::read_onto($value, $given, $mistakes)
    };
    (@read , $name:ident, $value:expr, $given:ident, $mistakes:ident, $range:expr, $must:expr) => {
        $crate::read_one(stringify!($name), $range, $must, $given, $value, $mistakes)
    };
    (@values flat, $to:ident, $name:ident, $value:expr) => { $crate::Params::values_to(&$value, $to) };
    (@values , $to:ident, $name:ident, $value:expr) => {
        $to.push((stringify!($name), $crate::ParamType::value(&$value)))
    };
    (@must) => { false };
    (@must give) => { true };
    (@chance) => { false };
    (@chance seed) => { true };
    (@source) => { $crate::NumberSource::Unrecorded };
    (@source structural) => { $crate::NumberSource::Structural };
    (@source derived $what:literal) => { $crate::NumberSource::Derived($what) };
    (@source cited $what:literal) => { $crate::NumberSource::Cited($what) };
    (@source fitted $what:literal) => { $crate::NumberSource::Fitted($what) };
    (@source by_hand $what:literal) => { $crate::NumberSource::ByHand($what) };
    (@range) => { None };
    (@range $range:expr) => {{
        let range = $range;
        Some((*range.start() as f64, *range.end() as f64))
    }};
}

#[cfg(test)]
#[allow(unreachable_pub)]
mod tests {
    use super::*;

    crate::params! {
        /// What ovens share.
        pub struct Heat {
            /// How hot.
            #[range(0..=300)]
            #[source(cited = "the cookbook")]
            degrees: u32 = 180,
            /// Whether air is moved.
            fan: bool = false,
        }
    }

    crate::params! {
        /// An oven.
        pub struct Oven {
            /// How long.
            minutes: u32 = 40,
            /// Its heat.
            #[group(flat)]
            heat: Heat = Heat { degrees: 220, ..Heat::default() },
            /// How many trays.
            trays: u32 = 1,
        }
    }

    #[test]
    fn params_of_a_group_are_among_the_other_ones_with_the_defaults_given_there() {
        let names: Vec<&str> = Oven::specs().iter().map(|s| s.name).collect();
        assert_eq!(names, ["minutes", "degrees", "fan", "trays"]);
        assert_eq!(Oven::specs()[1].default, Value::Int(220));
        assert_eq!(Oven::specs()[1].range, Some((0.0, 300.0)));
        assert_eq!(Oven::specs()[1].source, NumberSource::Cited("the cookbook"));
        assert_eq!(Oven::specs()[0].source, NumberSource::Unrecorded);
        let given = BTreeMap::from([("fan".to_owned(), Value::Bool(true))]);
        let oven = Oven::read(&given).unwrap();
        assert_eq!((oven.heat.degrees, oven.heat.fan), (220, true));
        let values: Vec<&str> = oven.values().iter().map(|(name, _)| *name).collect();
        assert_eq!(values, names);
    }

    #[test]
    fn what_is_wrong_in_a_group_is_refused_with_all_else_that_is_wrong() {
        let given = [("degrees", 301), ("degreess", 1), ("heat", 1)];
        let given = given.map(|(name, v)| (name.to_owned(), Value::Int(v)));
        let mistakes = Oven::read(&given.into()).unwrap_err();
        let names: Vec<&str> = mistakes.iter().map(|m| m.name.as_str()).collect();
        assert_eq!(names, ["degreess", "heat", "degrees"]);
        assert!(mistakes[0].what.contains("degrees"), "{mistakes:?}");
    }
}
