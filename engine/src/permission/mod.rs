//! Which programs of a pipeline this user lets run, and what of them is to be known before they do.

pub mod listing;
mod permit;

pub use listing::programs;
#[cfg(test)]
pub(crate) use permit::permissions_here;
pub use permit::{
    PermitError, Settled, allow, is_allowed, keep_permissions_in, permissions, settle,
};
