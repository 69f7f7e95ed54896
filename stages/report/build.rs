//! Whether a Chromium is there to test pages in: then `cfg(chromium)` is set; without one browser
//! tests are reported as ignored.

/// Names under which it is installed; the tests start the same.
const NAMES: [&str; 4] = [
    "chromium",
    "chromium-browser",
    "google-chrome-stable",
    "google-chrome",
];

fn main() {
    println!("cargo::rustc-check-cfg=cfg(chromium)");
    println!("cargo::rerun-if-env-changed=PATH");
    println!("cargo::rerun-if-changed=build.rs");
    let paths = std::env::var_os("PATH").unwrap_or_default();
    let mut folders = std::env::split_paths(&paths);
    if folders.any(|folder| NAMES.iter().any(|name| folder.join(name).is_file())) {
        println!("cargo::rustc-cfg=chromium");
    }
}
