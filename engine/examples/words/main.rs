//! A program of another trade on the engine: how often words stand in the files of a folder.
//!
//! ```text
//! cargo run -p engine --example words -- run engine/examples/words/words.toml \
//!     --input texts=engine/examples/words/texts --out words-out
//! cargo run -p engine --example words -- sweep engine/examples/words/words.toml letters \
//!     --input texts=engine/examples/words/texts
//! ```

mod nouns;
mod trade;

fn main() -> std::process::ExitCode {
    command::main(&trade::WORDS)
}
