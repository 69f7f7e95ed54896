//! A plan as a file for other engines: one rule a strand.

use engine::strands::Plan;
use std::fmt::Write;
use std::path::Path;

/// What every rule runs.
#[derive(Debug, Clone, Copy)]
pub struct Rules<'a> {
    /// What the program is called: the folder of marks is named after it.
    pub called: &'a str,
    /// The plan's name.
    pub name: &'a str,
    /// The program.
    pub program: &'a Path,
    /// The store.
    pub cache: &'a Path,
    /// The flags that hold for the work, too: the store that machines share, what programs may.
    pub flags: &'a [String],
    /// Threads of a rule.
    pub threads: usize,
}

impl Rules<'_> {
    /// The command of a strand, for a shell.
    fn command(&self, strand: usize) -> String {
        let quoted = |path: &Path| super::slurm::quoted(&path.to_string_lossy());
        format!(
            "{} cluster work --plan {} --strand {strand} --cache {}{} --threads {} --quiet",
            quoted(self.program),
            self.name,
            quoted(self.cache),
            super::slurm::flags(self.flags),
            self.threads
        )
    }
}

/// For make: `make -k -j8 -f FILE`. Strands that are done are found, so it needs no files of its own.
pub fn makefile(plan: &Plan, rules: Rules<'_>) -> String {
    let all = strands(0..plan.strands.len());
    let mut text = format!(
        "# strands of the plan {}\n.PHONY: all {all}\nall: {all}\n",
        rules.name
    );
    for (at, strand) in plan.strands.iter().enumerate() {
        let reads = strands(strand.reads.iter().copied());
        let head = format!("s{at}: {reads}");
        let command = rules.command(at).replace('$', "$$");
        let _ = write!(text, "{}\n\t@{command}\n", head.trim_end());
    }
    text
}

fn strands(places: impl Iterator<Item = usize>) -> String {
    let names: Vec<String> = places.map(|at| format!("s{at}")).collect();
    names.join(" ")
}

/// For Snakemake: `snakemake --snakefile FILE --keep-going --cores 8`. A file in a folder named after
/// the plan marks a strand that is done.
pub fn snakefile(plan: &Plan, rules: Rules<'_>) -> String {
    let mark = |at: usize| format!("\"{}-{}/s{at}\"", rules.called, &rules.name[..12]);
    let marks = |places: &mut dyn Iterator<Item = usize>| {
        let all: Vec<String> = places.map(mark).collect();
        all.join(", ")
    };
    let mut text = format!("# strands of the plan {}\nrule all:\n", rules.name);
    let all = marks(&mut (0..plan.strands.len()));
    let _ = writeln!(text, "    input: {all}\n");
    for (at, strand) in plan.strands.iter().enumerate() {
        let _ = writeln!(text, "rule s{at}:");
        if !strand.reads.is_empty() {
            let reads = marks(&mut strand.reads.iter().copied());
            let _ = writeln!(text, "    input: {reads}");
        }
        let command = rules.command(at).replace('{', "{{").replace('}', "}}");
        let _ = writeln!(text, "    output: touch({})", mark(at));
        let _ = writeln!(text, "    threads: {}", rules.threads);
        let _ = writeln!(text, "    shell: {command:?}\n");
    }
    text
}
