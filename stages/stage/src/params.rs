//! Params: each is one spot with its name and unit, a sentence, a default and a range.

use crate::Value;
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
    /// What it is when nothing is said.
    pub default: Value,
    /// Least and greatest value.
    pub range: Option<(f64, f64)>,
    /// Whether it must be said.
    pub required: bool,
    /// What each entry holds, where it is a section of named entries: see [`Named`](crate::Named).
    pub entry: Option<Vec<ParamSpec>>,
}

/// What is wrong with one param.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mistake {
    /// The param as it was written; within a section `section.entry.key`.
    pub name: String,
    /// What is wrong, and what would fit.
    pub what: String,
}

/// What the user may tune. Made by [`params!`](crate::params!).
pub trait Params: Clone + Default + Send + Sync + 'static {
    /// Every param, in the order of the reference.
    fn specs() -> Vec<ParamSpec>;
    /// Reads what was said; the rest keeps its default. All mistakes come at once.
    fn read(said: &BTreeMap<String, Value>) -> Result<Self, Vec<Mistake>>;
    /// All values after defaults, in the order of the reference.
    fn values(&self) -> Vec<(&'static str, Value)>;
}

/// A type that a param may have.
pub trait ParamType: Sized + Clone {
    /// What a person would call it.
    const NAME: &'static str;
    /// The words it may be, where it is a choice.
    const CHOICES: &'static [&'static str] = &[];
    /// What each entry holds, where it is a section of named entries.
    fn entry() -> Option<Vec<ParamSpec>> {
        None
    }
    /// From what was written, with all that is wrong within it.
    fn read_within(name: &str, value: &Value, mistakes: &mut Vec<Mistake>) -> Option<Self> {
        let read = Self::read(value);
        if read.is_none() {
            let what = match Self::CHOICES {
                [] => format!("wants {}, but {value} is {}", Self::NAME, value.type_name()),
                words => format!("{value} is none of {}", words.join(", ")),
            };
            let name = name.to_owned();
            mistakes.push(Mistake { name, what });
        }
        read
    }
    /// From what was written. [`None`] when it does not fit.
    fn read(value: &Value) -> Option<Self>;
    /// To be written.
    fn value(&self) -> Value;
    /// The number that a range speaks of.
    fn number(&self) -> Option<f64> {
        None
    }
}

impl ParamType for f64 {
    const NAME: &'static str = "a number";
    fn read(value: &Value) -> Option<Self> {
        match value {
            Value::Float(x) if x.is_finite() => Some(*x),
            Value::Int(i) => Some(*i as f64),
            _ => None,
        }
    }
    fn value(&self) -> Value {
        Value::Float(*self)
    }
    fn number(&self) -> Option<f64> {
        Some(*self)
    }
}

macro_rules! whole {
    ($($t:ty),*) => {$(
        impl ParamType for $t {
            const NAME: &'static str = "a whole number";
            fn read(value: &Value) -> Option<Self> {
                match value {
                    Value::Int(i) => <$t>::try_from(*i).ok(),
                    _ => None,
                }
            }
            fn value(&self) -> Value {
                Value::Int(*self as i64)
            }
            fn number(&self) -> Option<f64> {
                Some(*self as f64)
            }
        }
    )*};
}
whole!(i64, u32, usize);

impl ParamType for bool {
    const NAME: &'static str = "a boolean";
    fn read(value: &Value) -> Option<Self> {
        match value {
            Value::Bool(b) => Some(*b),
            _ => None,
        }
    }
    fn value(&self) -> Value {
        Value::Bool(*self)
    }
}

impl ParamType for String {
    const NAME: &'static str = "a text";
    fn read(value: &Value) -> Option<Self> {
        match value {
            Value::Text(t) => Some(t.clone()),
            _ => None,
        }
    }
    fn value(&self) -> Value {
        Value::Text(self.clone())
    }
}

impl<T: ParamType> ParamType for Vec<T> {
    const NAME: &'static str = "a list";
    fn read(value: &Value) -> Option<Self> {
        match value {
            Value::List(l) => l.iter().map(T::read).collect(),
            _ => None,
        }
    }
    fn value(&self) -> Value {
        Value::List(self.iter().map(T::value).collect())
    }
}

/// Reads one param: for [`params!`](crate::params!).
#[doc(hidden)]
pub fn read_one<T: ParamType>(
    name: &'static str,
    range: Option<(f64, f64)>,
    required: bool,
    said: &BTreeMap<String, Value>,
    default: T,
    mistakes: &mut Vec<Mistake>,
) -> T {
    let Some(value) = said.get(name) else {
        if required {
            mistakes.push(Mistake {
                name: name.into(),
                what: format!("must be said: {name} is {}", wanted::<T>(range)),
            });
        }
        return default;
    };
    let Some(read) = T::read_within(name, value, mistakes) else {
        return default;
    };
    if let (Some((lo, hi)), Some(x)) = (range, read.number())
        && !(lo..=hi).contains(&x)
    {
        mistakes.push(Mistake {
            name: name.into(),
            what: format!("{value} is out of range: it must lie in {lo}..={hi}"),
        });
        return default;
    }
    read
}

/// What would fit, in words.
fn wanted<T: ParamType>(range: Option<(f64, f64)>) -> String {
    match (T::CHOICES, range) {
        ([], None) => T::NAME.to_owned(),
        ([], Some((lo, hi))) => format!("{} in {lo}..={hi}", T::NAME),
        (words, _) => format!("one of {}", words.join(", ")),
    }
}

/// Declares a stage's params: doc, optional `#[range(lo..=hi)]`, optional `#[must(say)]` where there is
/// no sense in a default, name, type, default.
#[macro_export]
macro_rules! params {
    (
        $(#[doc = $about:literal])*
        pub struct $struct:ident { $(
            $(#[doc = $doc:literal])*
            $(#[range($range:expr)])?
            $(#[must($must:ident)])?
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
            fn specs() -> Vec<$crate::ParamSpec> {
                let _default = Self::default();
                vec![ $( $crate::ParamSpec {
                    name: stringify!($name),
                    doc: [$($doc),*].map(|l: &str| l.trim()).join(" "),
                    type_name: <$ty as $crate::ParamType>::NAME,
                    choices: <$ty as $crate::ParamType>::CHOICES,
                    default: $crate::ParamType::value(&_default.$name),
                    range: $crate::params!(@range $($range)?),
                    required: $crate::params!(@must $($must)?),
                    entry: <$ty as $crate::ParamType>::entry(),
                }, )* ]
            }

            fn read(
                _said: &std::collections::BTreeMap<String, $crate::Value>,
            ) -> Result<Self, Vec<$crate::Mistake>> {
                let mut mistakes = Vec::new();
                const NAMES: &[&str] = &[$( stringify!($name), )*];
                for name in _said.keys().filter(|n| !NAMES.contains(&n.as_str())) {
                    mistakes.push($crate::Mistake {
                        name: name.clone(),
                        what: $crate::unknown("param", name, NAMES),
                    });
                }
                let _default = Self::default();
                let read = Self { $( $name: $crate::read_one(
                    stringify!($name), $crate::params!(@range $($range)?), $crate::params!(@must $($must)?), _said, _default.$name, &mut mistakes,
                ), )* };
                if mistakes.is_empty() { Ok(read) } else { Err(mistakes) }
            }

            fn values(&self) -> Vec<(&'static str, $crate::Value)> {
                vec![ $( (stringify!($name), $crate::ParamType::value(&self.$name)), )* ]
            }
        }
    };
    (@must) => { false };
    (@must say) => { true };
    (@range) => { None };
    (@range $range:expr) => {{
        let range = $range;
        Some((*range.start() as f64, *range.end() as f64))
    }};
}
