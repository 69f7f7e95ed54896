//! One graph in three languages: a pipeline, `build.ninja`, a Makefile.

use super::LENGTH;
use std::fmt::Write as _;
use std::path::Path;

/// The same graph for all three.
pub(crate) fn write(folder: &Path, width: usize) {
    let (mut goal, mut toml) = (Vec::new(), String::new());
    let mut ninja = String::from("rule cat\n  command = cat $in > $out\n");
    let (mut make, mut all) = (String::new(), String::from("all:"));
    for w in 0..width {
        std::fs::write(folder.join(format!("{w}.txt")), format!("source {w}\n")).unwrap();
        let _ = write!(toml, "[input.s{w}]\nfiles = \"{w}.txt\"\n");
        let (mut before, mut from) = (format!("{w}.txt"), format!("file = \"@s{w}\""));
        for l in 0..LENGTH {
            let (name, verb) = (format!("w{w}l{l}"), if l == 0 { "load" } else { "copy" });
            let _ = write!(
                toml,
                "[node.{name}]\nstage = \"bench.{verb}\"\nfrom = {{ {from} }}\n"
            );
            if l > 0 {
                let _ = writeln!(toml, "with = {{ n = {l} }}");
            }
            let _ = writeln!(ninja, "build {name}: cat {before}");
            let _ = write!(make, "{name}: {before}\n\tcat $< > $@\n");
            from = format!("text = \"{name}\"");
            before = name;
        }
        let _ = write!(all, " {before}");
        goal.push(before);
    }
    let write = |name: &str, text: String| std::fs::write(folder.join(name), text).unwrap();
    write("tailor.toml", format!("goal = {goal:?}\n{toml}"));
    write("build.ninja", ninja);
    write("Makefile", format!("{all}\n{make}"));
}
