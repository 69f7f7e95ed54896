//! Where a Chromium is to test pages in: then `cfg(chromium)` is set, and `CHROMIUM` has its place; without
//! one browser tests are reported as ignored. So are tests on Slurm's daemons without `cfg(slurm)`.
//! `stages/report` is built by this file, too.

/// Names under which it is installed.
const NAMES: [&str; 4] = [
    "chromium",
    "chromium-browser",
    "google-chrome-stable",
    "google-chrome",
];

/// What a Slurm on one machine needs.
const SLURM: [&str; 4] = ["munged", "slurmctld", "slurmd", "sbatch"];

fn main() {
    println!("cargo::rustc-check-cfg=cfg(slurm)");
    println!("cargo::rustc-check-cfg=cfg(chromium)");
    println!("cargo::rerun-if-env-changed=PATH");
    let paths = std::env::var_os("PATH").unwrap_or_default();
    let folders: Vec<_> = std::env::split_paths(&paths).collect();
    let there = |name: &&str| folders.iter().any(|f| f.join(name).is_file());
    if SLURM.iter().all(there) {
        println!("cargo::rustc-cfg=slurm");
    }
    let places = NAMES
        .iter()
        .flat_map(|name| folders.iter().map(move |f| f.join(name)));
    if let Some(place) = places.into_iter().find(|place| place.is_file()) {
        println!("cargo::rustc-cfg=chromium");
        println!("cargo::rustc-env=CHROMIUM={}", place.display());
    }
}
