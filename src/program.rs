//! The program: its catalog and its verbs, beside the engine's.

use crate::catalog::CATALOG;
use crate::cli::{
    compare, delivered, doctor, ending, follow, init, mat, measure_args, measure_verb, measuring,
    provenance, repeat, scoring, spoken::Spoken,
};
use clap::{ArgMatches, Args, Command, FromArgMatches};
use command::{Fault, Program, Verb};
use engine::Catalog;
use std::process::ExitCode;

/// The program.
static TAILOR: Program = PRODUCT;

const PRODUCT: Program = Program {
    cache_env: "TAILOR_CACHE",
    size_env: "TAILOR_MAX_SIZE",
    store_env: "TAILOR_STORE",
    sign_env: "TAILOR_SIGN_KEY",
    trust_env: "TAILOR_TRUST",
    pipeline: Some("body"),
    input: Some("photos"),
    verbs: &[
        Verb {
            name: "measure",
            arguments: |own| {
                with::<measure_args::Measure>(own, "Photos of one turn to girths, with a report")
            },
            run: |stated, global| measure_verb::measure(&read(stated)?, global),
            runs: true,
        },
        Verb {
            name: "doctor",
            arguments: |own| {
                with::<doctor::Doctor>(
                    own,
                    "What can be measured with these photos, before minutes are spent",
                )
            },
            run: |stated, global| doctor::doctor(&read(stated)?, global),
            runs: true,
        },
        Verb {
            name: "init",
            arguments: |own| {
                with::<init::Init>(own, "A commented capture.toml from what is in the photos")
            },
            run: |stated, global| spoken(init::init(&read(stated)?, global)),
            runs: true,
        },
        #[cfg(feature = "serve")]
        Verb {
            name: "serve",
            arguments: |own| {
                let about = "A page on this machine: drop photos, look at them, measure";
                with::<crate::serve::Serve>(own, about)
            },
            run: |stated, global| spoken(crate::serve::serve(&read(stated)?, global)),
            runs: true,
        },
        Verb {
            name: "compare",
            arguments: |own| {
                let about = "Variants, runs or folders of results side by side: params, girths, surfaces, time";
                with::<compare::CompareArgs>(own, about)
            },
            run: |stated, global| compare::compare_sides(&read(stated)?, global),
            runs: true,
        },
        Verb {
            name: "follow",
            arguments: |own| {
                let about = "One person over time: girths at the same level, changes with intervals, what grew and shrank";
                with::<follow::Following>(own, about)
            },
            run: |stated, global| follow::following(&read(stated)?, global),
            runs: false,
        },
        Verb {
            name: "repeat",
            arguments: |own| {
                let about = "How near captures of the same people come to each other: technical error, least significant change, correlation";
                with::<repeat::Repeating>(own, about)
            },
            run: |stated, global| repeat::repeating(&read(stated)?, global),
            runs: false,
        },
        Verb {
            name: "mat",
            arguments: |own| {
                let about = "A printable marker mat for the disk: PDF or SVG at true scale";
                with::<mat::MatArgs>(own, about)
            },
            run: |stated, global| spoken(mat::mat(&read(stated)?, global)),
            runs: false,
        },
        Verb {
            name: "score",
            arguments: |own| with::<scoring::Scoring>(own, "A result against ground truth"),
            run: |stated, global| scoring::scoring(&read(stated)?, global),
            runs: false,
        },
    ],
    jobs: &[("measure", |stated, _| measuring::ahead(&read(stated)?))],
    complete: provenance::completed,
    present: delivered::present,
    screen: ending::ending,
    errors: crate::errors::errors,
    references: crate::references::references,
    ..Program::new(
        "tailor",
        env!("CARGO_PKG_VERSION"),
        "Girths of a body from the photographs of one turn, as a stage graph with cached artifacts",
        &CATALOG,
    )
};

/// A verb's arguments and its help.
fn with<A: Args>(own: Command, about: &'static str) -> Command {
    A::augment_args(own).about(about)
}

/// What came of a verb that has no flag for the language: why nothing did in that of the environment.
fn spoken(done: Result<(), Fault>) -> Result<(), Fault> {
    Spoken::default().read(done)
}

/// What was given, as a verb's arguments.
fn read<A: FromArgMatches>(stated: &ArgMatches) -> Result<A, Fault> {
    A::from_arg_matches(stated).map_err(Fault::input)
}

/// The program over another catalog, one that adds to the product's: called as that calls its program, `NAME VERSION`.
pub const fn program_over(catalog: &'static Catalog) -> Program {
    let called = catalog.program;
    let mut end = 0;
    while end < called.len() && called.as_bytes()[end] != b' ' {
        end += 1;
    }
    let (name, rest) = called.split_at(end);
    let version = match rest.is_empty() {
        true => PRODUCT.version,
        false => rest.split_at(1).1,
    };
    Program {
        name,
        version,
        catalog,
        ..PRODUCT
    }
}

/// The program: its catalog, its verbs.
pub fn program() -> &'static Program {
    &TAILOR
}

/// Does what the arguments ask for. Exit codes: 0 done, 1 a stage failed, 2 input or pipeline wrong,
/// 130 cancelled.
pub fn main() -> ExitCode {
    stage::machine::give_large_memory_back();
    command::main(&TAILOR)
}

/// Whether a command line could be run, the program's name first: verbs, flags and values, not files.
///
/// # Errors
///
/// What is wrong with it, in words.
pub fn check_arguments(arguments: &[&str]) -> Result<(), String> {
    command::check_arguments(&TAILOR, arguments).map_err(|e| e.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_program_over_another_catalog_has_its_own_name() {
        static MINE: Catalog = Catalog {
            program: "my-tailor 0.1.0",
            ..CATALOG
        };
        static BARE: Catalog = Catalog {
            program: "mine",
            ..CATALOG
        };
        let [mine, bare, own] = [&MINE, &BARE, &CATALOG].map(program_over);
        assert_eq!((mine.name, mine.version), ("my-tailor", "0.1.0"));
        assert_eq!((bare.name, bare.version), ("mine", PRODUCT.version));
        assert_eq!((own.name, own.version), (PRODUCT.name, PRODUCT.version));
    }
}
