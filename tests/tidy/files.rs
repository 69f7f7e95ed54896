//! What files of the repository may not do: fetch from a registry by its address (its own client knows the way), be
//! where git takes results for sources, remove what they did not make.

use std::path::Path;
use std::process::Command;

/// Hosts that hand out packages, cut in two, so that this file names none.
const HOSTS: [(&str, &str); 22] = [
    ("registry.npmjs", ".org"),
    ("registry.yarnpkg", ".com"),
    ("unpkg", ".com"),
    ("cdn.jsdelivr", ".net"),
    ("static.crates", ".io"),
    ("index.crates", ".io"),
    ("crates.io/", "api"),
    ("pypi.org/", "simple"),
    ("pypi.org/", "pypi"),
    ("files.pythonhosted", ".org"),
    ("conda.anaconda", ".org"),
    ("deb.debian", ".org"),
    ("ftp.debian", ".org"),
    ("security.debian", ".org"),
    ("snapshot.debian", ".org"),
    ("archive.ubuntu", ".com"),
    ("proxy.golang", ".org"),
    ("rubygems", ".org"),
    ("repo.maven.apache", ".org"),
    ("repo1.maven", ".org"),
    ("registry-1.docker", ".io"),
    ("static.rust-lang", ".org"),
];

/// The files that git knows, or that it would take.
pub(super) fn files() -> Vec<String> {
    let mut git = Command::new("git");
    git.args([
        "ls-files",
        "-z",
        "--cached",
        "--others",
        "--exclude-standard",
    ]);
    let out = git.current_dir(env!("CARGO_MANIFEST_DIR")).output();
    let out = out.expect("git lists what is in the repository");
    let names = String::from_utf8(out.stdout).expect("names in UTF-8");
    let names: Vec<String> = names.split_terminator('\0').map(str::to_owned).collect();
    assert!(names.len() > 500, "{} files", names.len());
    names
}

/// The host of the list that a text names.
fn named(text: &str) -> Option<String> {
    let text = text.to_lowercase();
    let hosts = HOSTS.iter().map(|(a, b)| format!("{a}{b}"));
    hosts.into_iter().find(|host| text.contains(host))
}

#[test]
fn no_file_names_the_host_of_a_registry() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut wrong = Vec::new();
    for name in files() {
        // Pictures and other bytes name nobody.
        let Ok(text) = std::fs::read_to_string(root.join(&name)) else {
            continue;
        };
        wrong.extend(named(&text).map(|host| format!("{name}: {host}")));
    }
    assert_eq!(
        wrong,
        Vec::<String>::new(),
        "use npm, cargo, pip or apt by the package's name"
    );
}

#[test]
fn folders_of_results_are_no_part_of_the_repository() {
    let mut git = Command::new("git");
    git.args([
        "check-ignore",
        "mannequin-out/report.html",
        "out/a",
        "docs/anna-out/run.json",
    ]);
    let out = git
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    let ignored = String::from_utf8_lossy(&out.stdout).lines().count();
    assert_eq!(ignored, 3);
}

#[test]
fn a_release_removes_no_wheel_that_is_beside_it() {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("packaging/build");
    let text = std::fs::read_to_string(script).unwrap();
    let line = text.lines().find(|line| line.starts_with("rm -rf"));
    let place = tempfile::tempdir().unwrap();
    let dist = place.path().join("dist");
    let names = [
        "tailor-0.2.0-cp39-abi3-linux_x86_64.whl",
        "tailor-0.1.0-x86_64-linux/tailor",
        "tailor-0.1.0-x86_64-linux.tar.gz",
        "tailor_0.1.0_amd64.deb",
        "SHA256SUMS",
    ];
    for name in names {
        let file = dist.join(name);
        std::fs::create_dir_all(file.parent().unwrap()).unwrap();
        std::fs::write(file, "x").unwrap();
    }
    let mut bash = Command::new("bash");
    let bash = bash.args(["-euc", line.unwrap()]).current_dir(place.path());
    assert!(bash.status().unwrap().success());
    let left: Vec<bool> = names.iter().map(|name| dist.join(name).exists()).collect();
    assert_eq!(left, [true, false, false, false, false]);
}

#[test]
fn hosts_are_distinguished_from_names_and_pages() {
    let fetch = format!("curl -sSf https://{}{}/a/-/a-1.tgz", HOSTS[0].0, HOSTS[0].1);
    assert!(named(&fetch).is_some());
    for fine in [
        "registry+https://github.com/rust-lang/crates.io-index",
        "npm pack axe-core@4.14.1",
        "https://docs.rs/clap",
        "see PyPI, or crates.io",
    ] {
        assert_eq!(named(fine), None, "{fine}");
    }
}
