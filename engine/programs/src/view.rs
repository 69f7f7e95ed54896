//! What a program sees that keeps to what it is given: its installation, what it reads, files of the system's.

use crate::installed::{Installed, is_system};
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};

/// Files of the system's that programs need.
pub(crate) const ETC_FILES: [&str; 4] = [
    "/etc/ld.so.cache",
    "/etc/ld.so.conf",
    "/etc/ld.so.conf.d",
    "/etc/alternatives",
];
/// Files without which nobody reaches a network; certificates, and not the keys that are beside them.
pub(crate) const ETC_NETWORK: [&str; 12] = [
    "/etc/resolv.conf",
    "/etc/hosts",
    "/etc/nsswitch.conf",
    "/etc/ssl/certs",
    "/etc/ssl/openssl.cnf",
    "/etc/pki/tls/certs",
    "/etc/pki/tls/cert.pem",
    "/etc/pki/ca-trust",
    "/etc/ca-certificates",
    "/etc/crypto-policies",
    "/etc/services",
    "/etc/protocols",
];

/// What a program sees beside its own folders.
pub(crate) struct View<'a> {
    /// What its installation needs.
    pub(crate) installed: &'a Installed,
    /// What the node declares that it reads.
    pub(crate) reads: &'a [String],
    /// What nobody sees: the store.
    pub(crate) hidden: &'a Path,
    /// Whether it may reach the network.
    pub(crate) network: bool,
}

impl View<'_> {
    /// The folders in PATH that a program sees.
    pub(crate) fn path(&self, path: &OsStr) -> OsString {
        let seen = |folder: &PathBuf| {
            let shown = self
                .installed
                .paths
                .iter()
                .any(|shown| folder.starts_with(shown));
            is_system(folder) || shown || self.reads.iter().any(|shown| folder.starts_with(shown))
        };
        let folders = std::env::split_paths(path).filter(seen);
        std::env::join_paths(folders).unwrap_or_default()
    }
}
