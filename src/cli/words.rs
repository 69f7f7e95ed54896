//! Arguments of a verb out of words: for who does not come from the command line, and means the same.

use clap::{Args, Command};
use command::Fault;
use std::ffi::OsString;

/// The arguments that these words mean; the folder comes last, after `--`.
///
/// # Errors
///
/// What `clap` reports of them.
pub(crate) fn arguments<A: Args>(words: Vec<OsString>) -> Result<A, Fault> {
    let command = Command::new("tailor").no_binary_name(true);
    let command = A::augment_args(command).disable_help_flag(true);
    let stated = command.try_get_matches_from(words);
    let stated = stated.map_err(|why| Fault::input(why.to_string().trim_end()))?;
    A::from_arg_matches(&stated).map_err(Fault::input)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::measure_args::Measure;

    #[test]
    fn no_folder_is_a_flag() {
        let words = |all: &[&str]| all.iter().map(|w| OsString::from(*w)).collect::<Vec<_>>();
        assert!(arguments::<Measure>(words(&["--stature=171.5cm", "--", "--set"])).is_ok());
        assert!(arguments::<Measure>(words(&["--stature=171.5cm"])).is_err());
        assert!(arguments::<Measure>(words(&["--nonsense", "--", "a"])).is_err());
    }
}
