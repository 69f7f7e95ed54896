//! A param that is one of some words.

use crate::{ParamType, Value};

/// An enum whose variants are words. Made by [`choice!`](crate::choice!).
pub trait Choice: Sized + Copy + PartialEq + 'static {
    /// The words, in the order of the variants.
    const WORDS: &'static [&'static str];
    /// The variants.
    const ALL: &'static [Self];
}

impl<C: Choice> ParamType for C {
    const NAME: &'static str = "a word";
    const CHOICES: &'static [&'static str] = C::WORDS;
    fn read(value: &Value) -> Option<Self> {
        let Value::Text(t) = value else { return None };
        C::WORDS.iter().position(|w| w == t).map(|i| C::ALL[i])
    }
    fn value(&self) -> Value {
        let i = C::ALL
            .iter()
            .position(|c| c == self)
            .expect("bug: a variant outside ALL");
        Value::Text(C::WORDS[i].into())
    }
}

/// Declares an enum whose variants a pipeline file calls by a word.
#[macro_export]
macro_rules! choice {
    (
        $(#[doc = $about:literal])*
        pub enum $enum:ident { $( $(#[doc = $doc:literal])* $variant:ident = $word:literal ),* $(,)? }
    ) => {
        $(#[doc = $about])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum $enum { $( $(#[doc = $doc])* $variant, )* }

        impl $crate::Choice for $enum {
            const WORDS: &'static [&'static str] = &[$($word),*];
            const ALL: &'static [Self] = &[$( $enum::$variant ),*];
        }
    };
}
