//! An artifact whose type is forgotten.

use crate::Artifact;
use std::any::Any;
use std::sync::Arc;

/// An artifact of some kind, shared between its readers.
#[derive(Clone)]
pub struct AnyArtifact {
    kind: &'static str,
    inner: Arc<dyn Any + Send + Sync>,
}

impl AnyArtifact {
    /// Forgets the type, keeps the kind.
    pub fn new<A: Artifact>(artifact: A) -> Self {
        AnyArtifact {
            kind: A::KIND,
            inner: Arc::new(artifact),
        }
    }

    /// What it is called.
    pub fn kind(&self) -> &'static str {
        self.kind
    }

    /// Remembers the type, if it is this one.
    pub fn downcast<A: Artifact>(self) -> Option<Arc<A>> {
        self.inner.downcast().ok()
    }
}
