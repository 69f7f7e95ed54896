//! A program for another field on the engine: how often words occur in the files of a folder.
//!
//! ```text
//! cargo run -p engine --example words -- run engine/examples/words/words.toml \
//!     --input texts=engine/examples/words/texts --out words-out
//! cargo run -p engine --example words -- sweep engine/examples/words/words.toml letters \
//!     --input texts=engine/examples/words/texts
//! ```

mod application;
mod nouns;

fn main() -> std::process::ExitCode {
    command::main(&application::WORDS)
}
