//! The program itself, as somebody uses it: stops, bad input, answers.

mod answers;
mod bad_input;
mod place;
mod stops;
