//! Where a user's programs keep what they remember.

use std::path::PathBuf;

/// The folder for what programs remember of this user, by the system's custom; none where no home is known.
pub fn user_state() -> Option<PathBuf> {
    let named = |name: &str| {
        let path = PathBuf::from(std::env::var_os(name)?);
        path.is_absolute().then_some(path)
    };
    let home = || std::env::home_dir().filter(|home| home.is_absolute());
    if cfg!(windows) {
        return named("LOCALAPPDATA");
    }
    let own = match cfg!(target_os = "macos") {
        true => "Library/Application Support",
        false => ".local/state",
    };
    named("XDG_STATE_HOME").or_else(|| Some(home()?.join(own)))
}
