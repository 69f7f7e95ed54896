//! What can be wrong with a video.

use crate::program::ProgramError;

/// What is wrong with a video.
#[derive(Debug, thiserror::Error)]
pub enum VideoError {
    /// None, or several.
    #[error("{}", match found.as_slice() {
        [] => "there is no video here (mp4, mov, mkv, …): say which file it is, such as `tailor measure turn.mp4`".to_owned(),
        some => format!("there are {} videos ({}), and one turn is one of them: say which, such as `tailor measure {}`", some.len(), some.join(", "), some[0]),
    })]
    Count {
        /// Those that are there.
        found: Vec<String>,
    },
    /// Nothing in it can be shown.
    #[error("{name} is no video that can be read ({why}): was it copied whole?")]
    Unreadable {
        /// The file.
        name: String,
        /// ffmpeg's message.
        why: String,
    },
    /// Only sound, or a still.
    #[error("{name} has no moving pictures in it: hand over the video of the turn")]
    NoPictures {
        /// The file.
        name: String,
    },
    /// Longer than a turn is.
    #[error("{name} is {} min long, and more than {most} min are not looked through: cut it to the turn (ffmpeg -ss START -to END -i {name} -c copy turn.mp4), or say --set frames.minutes=", (seconds / 60.0).ceil())]
    Long {
        /// The file.
        name: String,
        /// How long it is. \[s\]
        seconds: f64,
        /// How long it may be. \[min\]
        most: f64,
    },
    /// Fewer than can be compared.
    #[error("{name} has {frames} frames: a turn has at least three")]
    Short {
        /// The file.
        name: String,
        /// How many there are.
        frames: usize,
    },
    /// Pictures that do not go together.
    #[error(
        "the pictures of {name} change their size from frame {frame} on: hand over one recording, not several that were joined"
    )]
    Changes {
        /// The file.
        name: String,
        /// The first of another size.
        frame: usize,
    },
    /// All frames are alike.
    #[error("nothing turns in {name}: its {frames} frames are all alike")]
    Still {
        /// The file.
        name: String,
        /// How many there are.
        frames: usize,
    },
    /// The program.
    #[error(transparent)]
    Program(#[from] ProgramError),
}
