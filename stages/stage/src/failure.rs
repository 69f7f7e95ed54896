//! Failures with a code: enums of which each variant is a kind of message.

use crate::Message;
use std::error::Error;

/// An error that is a message. Made by [`failures!`](crate::failures!).
pub trait Coded: Error {
    /// The message.
    fn message(&self) -> Message;
}

/// Recognises the errors of one type; see [`recognise`].
pub type Recognise = fn(&(dyn Error + 'static)) -> Option<Message>;

/// For a crate's list: how errors of this type become messages.
pub fn recognise<E: Coded + 'static>(error: &(dyn Error + 'static)) -> Option<Message> {
    error.downcast_ref::<E>().map(E::message)
}

/// Declares an enum of failures, each with its fields, its code and its English sentence; see
/// [`Template`](crate::Template) for what is between braces:
///
/// ```
/// stage::failures! {
///     /// Why there is no cake.
///     pub enum CakeError {
///         /// Too hot.
///         Burnt { degrees: f64 } = "fail-burnt": "the cake burnt at {degrees:.0} °C: bake at less",
///         /// Nothing to bake.
///         Empty = "fail-empty": "there is no dough",
///     }
/// }
/// # use stage::Coded;
/// let burnt = CakeError::Burnt { degrees: 300.0 };
/// assert_eq!(burnt.to_string(), "the cake burnt at 300 °C: bake at less");
/// assert_eq!(burnt.message().code(), "fail-burnt");
/// ```
///
/// `passes { Dough(DoughError) }` after the enum adds variants that are failures of another such enum, `wraps { … }` those
/// of other errors, whose sentences stay as they are.
#[macro_export]
macro_rules! failures {
    (
        $(#[$about:meta])*
        $vis:vis enum $enum:ident { $(
            $(#[doc = $doc:literal])*
            $variant:ident
            $({ $( $(#[doc = $field_doc:literal])* $field:ident : $ty:ty ),* $(,)? })?
            $(( $( $part:ident : $part_ty:ty ),* ))?
            = $code:literal : $english:literal
        ),* $(,)? }
        $(passes { $( $(#[doc = $pass_doc:literal])* $pass:ident ( $pass_ty:ty ) ),* $(,)? })?
        $(wraps { $( $(#[doc = $wrap_doc:literal])* $wrap:ident ( $wrap_ty:ty ) ),* $(,)? })?
    ) => {
        $(#[$about])*
        #[derive(Debug)]
        $vis enum $enum {
            $(
                $(#[doc = $doc])*
                $variant
                $({ $( $(#[doc = $field_doc])* $field: $ty ),* })?
                $(( $( $part_ty ),* ))?,
            )*
            $($( $(#[doc = $pass_doc])* $pass($pass_ty), )*)?
            $($( $(#[doc = $wrap_doc])* $wrap($wrap_ty), )*)?
        }

        impl $enum {
            /// Their kinds of messages.
            $vis const MESSAGES: &'static [$crate::Template] =
                &[$($crate::Template::new($code, $english)),*];
        }

        impl $crate::Coded for $enum {
            fn message(&self) -> $crate::Message {
                match self {
                    $(
                        Self::$variant $({ $($field),* })? $(( $($part),* ))? => {
                            const KIND: $crate::Template = $crate::Template::new($code, $english);
                            $crate::message!(KIND $($(, $field = $field)*)? $($(, $part = $part)*)?)
                        }
                    )*
                    $($( Self::$pass(why) => $crate::Coded::message(why), )*)?
                    $($( Self::$wrap(why) => $crate::Message::from(why.to_string()), )*)?
                }
            }
        }

        impl std::fmt::Display for $enum {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str($crate::Coded::message(self).as_str())
            }
        }

        impl std::error::Error for $enum {}

        $($(
            impl From<$pass_ty> for $enum {
                fn from(why: $pass_ty) -> Self {
                    Self::$pass(why)
                }
            }
        )*)?
        $($(
            impl From<$wrap_ty> for $enum {
                fn from(why: $wrap_ty) -> Self {
                    Self::$wrap(why)
                }
            }
        )*)?
    };
}
