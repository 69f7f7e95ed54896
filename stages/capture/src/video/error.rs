//! What can be wrong with a video.

use crate::program::ProgramError;

::stage::failures! {
    /// What is wrong with a video.
    pub enum VideoError {
        /// None.
        NoVideo = "fail-no-video": "there is no video here (mp4, mov, mkv, …): name the file, such as `tailor measure turn.mp4`",
        /// Several.
        Several {
            /// How many there are.
            count: usize,
            /// Those that are there.
            names: Vec<String>,
            /// The first of them.
            first: String,
        } = "fail-several-videos": "there are {count} videos ({names}), and one turn is one of them: name one, such as `tailor measure {first}`",
        /// Nothing in it can be shown.
        Unreadable {
            /// The file.
            name: String,
            /// ffmpeg's message.
            why: String,
        } = "fail-video-unreadable": "{name} is no video that can be read ({why}): was it copied whole?",
        /// Only sound, or a still.
        NoPictures {
            /// The file.
            name: String,
        } = "fail-video-no-pictures": "{name} has no moving pictures in it: hand over the video of the turn",
        /// Longer than a turn is.
        Long {
            /// The file.
            name: String,
            /// How long it is. \[min\]
            minutes: f64,
            /// How long it may be. \[min\]
            most: f64,
        } = "fail-video-long": "{name} is {minutes:.0 min} long, and more than {most} min are not looked through: cut it to the turn (ffmpeg -ss START -to END -i {name} -c copy turn.mp4), or give --set frames.minutes=",
        /// Fewer than can be compared.
        Short {
            /// The file.
            name: String,
            /// How many there are.
            frames: usize,
        } = "fail-video-short": "{name} has {frames} frames: a turn has at least three",
        /// Pictures that do not go together.
        Changes {
            /// The file.
            name: String,
            /// The first of another size.
            frame: usize,
        } = "fail-video-changes": "the pictures of {name} change their size from frame {frame} on: hand over one recording, not several that were joined",
        /// All frames are alike.
        Still {
            /// The file.
            name: String,
            /// How many there are.
            frames: usize,
        } = "fail-video-still": "nothing turns in {name}: its {frames} frames are all alike",
    }
    passes {
        /// The program.
        Program(ProgramError),
    }
}

impl VideoError {
    /// None, or several.
    pub(crate) fn count(names: Vec<String>) -> VideoError {
        match names.first().cloned() {
            None => VideoError::NoVideo,
            Some(first) => VideoError::Several {
                count: names.len(),
                names,
                first,
            },
        }
    }
}
