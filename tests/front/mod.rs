//! The program itself, as somebody uses it: stops, bad input, answers, what it keeps its hands off.

mod ahead;
mod answers;
mod bad_input;
mod causes;
mod confined;
mod doctor;
mod facts;
mod first_answer;
mod foreign;
mod foreign_measured;
mod forgetting;
mod german;
mod keeping;
mod layouts;
mod limits;
mod manual;
mod noise;
mod outs;
mod place;
mod privacy;
mod profile;
mod reports;
mod scans;
mod screens;
mod shown;
mod stops;
#[cfg(feature = "remote")]
mod strangers;
mod things;
mod words;
