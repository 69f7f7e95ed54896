//! What flows into a stage: typed ports on the inside, names and kinds on the outside.

use crate::{AnyArtifact, Artifact};
use std::sync::Arc;

/// One port, as the reference and the checker know it.
#[derive(Debug, Clone)]
pub struct PortSpec {
    /// Its name.
    pub name: &'static str,
    /// The kind of artifact it takes.
    pub kind: &'static str,
    /// Whether it may stay open.
    pub optional: bool,
    /// What it is for.
    pub doc: String,
}

/// An artifact of another kind than the port takes: a bug of the engine, since kinds are
/// checked when a pipeline is bound.
#[derive(Debug, thiserror::Error)]
#[error("bug: port `{port}` wants {wants} and got {got}")]
pub struct Wrong {
    /// The port.
    pub port: &'static str,
    /// The kind it wants.
    pub wants: &'static str,
    /// What came.
    pub got: &'static str,
}

/// A type that a port may have: `Arc<T>`, or `Option<Arc<T>>` where it may stay open.
pub trait Port: Sized {
    /// The kind of artifact.
    const KIND: &'static str;
    /// Whether it may stay open.
    const OPTIONAL: bool;
    /// From what the engine hands over.
    ///
    /// # Errors
    ///
    /// Nothing is there, or it is of another kind.
    fn take(name: &'static str, from: Option<AnyArtifact>) -> Result<Self, Wrong>;
}

impl<T: Artifact> Port for Arc<T> {
    const KIND: &'static str = T::KIND;
    const OPTIONAL: bool = false;
    fn take(port: &'static str, from: Option<AnyArtifact>) -> Result<Self, Wrong> {
        let from = from.ok_or(Wrong {
            port,
            wants: T::KIND,
            got: "nothing",
        })?;
        let got = from.kind();
        from.downcast().ok_or(Wrong {
            port,
            wants: T::KIND,
            got,
        })
    }
}

impl<T: Artifact> Port for Option<Arc<T>> {
    const KIND: &'static str = T::KIND;
    const OPTIONAL: bool = true;
    fn take(port: &'static str, from: Option<AnyArtifact>) -> Result<Self, Wrong> {
        from.map(|from| <Arc<T>>::take(port, Some(from)))
            .transpose()
    }
}

/// All ports of a stage. Made by [`inputs!`](crate::inputs!).
pub trait Input: Sized + Send {
    /// Every port, in order.
    fn ports() -> Vec<PortSpec>;
    /// From what the engine hands over: one entry a port, in order.
    ///
    /// # Errors
    ///
    /// A port is open that must not be, or is given another kind.
    fn take(from: Vec<Option<AnyArtifact>>) -> Result<Self, Wrong>;
}

/// Declares a stage's ports: doc, name, `Arc<Kind>` or `Option<Arc<Kind>>`.
#[macro_export]
macro_rules! inputs {
    (
        $(#[doc = $about:literal])*
        pub struct $struct:ident { $( $(#[doc = $doc:literal])* $name:ident : $ty:ty ),* $(,)? }
    ) => {
        $(#[doc = $about])*
        pub struct $struct { $( $(#[doc = $doc])* pub $name: $ty, )* }

        impl $crate::Input for $struct {
            fn ports() -> Vec<$crate::PortSpec> {
                vec![ $( $crate::PortSpec {
                    name: stringify!($name),
                    kind: <$ty as $crate::Port>::KIND,
                    optional: <$ty as $crate::Port>::OPTIONAL,
                    doc: [$($doc),*].map(|l: &str| l.trim()).join(" "),
                }, )* ]
            }

            fn take(from: Vec<Option<$crate::AnyArtifact>>) -> Result<Self, $crate::Wrong> {
                let mut _from = from.into_iter();
                Ok(Self { $( $name: <$ty as $crate::Port>::take(
                    stringify!($name), _from.next().flatten(),
                )?, )* })
            }
        }
    };
}
