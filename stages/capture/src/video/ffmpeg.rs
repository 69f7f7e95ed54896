//! What `ffprobe` and `ffmpeg` are asked, and what they answer.

use crate::installed::version;
use crate::netpbm::{self, Netpbm};
use crate::program::{Program, ProgramError, Run, whole};
use crate::video::error::VideoError;
use crate::video::filters::Wanted;
use crate::video::probe::{ASK, Clip, clip};
use std::ffi::OsString;
use std::path::Path;
use std::time::Duration;

const FFMPEG: Program = Program {
    name: "ffmpeg",
    package: "ffmpeg",
};
const FFPROBE: Program = Program {
    name: "ffprobe",
    package: "ffmpeg",
};

/// Files are read from this machine, as videos, and nothing else: a playlist that is called a video
/// leads nowhere.
const ONLY: [&str; 4] = [
    "-protocol_whitelist",
    "file",
    "-format_whitelist",
    "mov,mp4,m4a,3gp,3g2,mj2,matroska,webm,avi,mpegts,mpeg",
];

/// The versions of both programs.
pub(crate) fn versions() -> Vec<(&'static str, String)> {
    let word = |name: &'static str| {
        let found = version(name, &["-version"], |text| {
            let (_, behind) = text.split_once(" version ")?;
            Some(behind.split_whitespace().next()?.to_owned())
        });
        (name, found.unwrap_or_else(|| "not installed".into()))
    };
    vec![word("ffmpeg"), word("ffprobe")]
}

/// A file, so that its name is taken for nothing else.
fn file(path: &Path) -> OsString {
    let mut url = OsString::from("file:");
    url.push(path);
    url
}

/// A video on the disk, and what it is called.
pub(crate) struct Source<'a> {
    pub(crate) path: &'a Path,
    pub(crate) name: &'a str,
}

impl Source<'_> {
    /// ffmpeg's message, without the places of files on this machine.
    fn plain(&self, line: &str) -> String {
        let url = file(self.path);
        let mut text = line.replace(&*url.to_string_lossy(), self.name);
        while let Some((at, end)) = text
            .find(" @ 0x")
            .and_then(|at| Some((at, at + text[at..].find(']')?)))
        {
            text.replace_range(at..end, "");
        }
        text.replace("[error] ", "").replace("[fatal] ", "")
    }

    fn unreadable(&self, why: &str) -> VideoError {
        VideoError::Unreadable {
            name: self.name.to_owned(),
            why: match why {
                "" => "ffmpeg finds nothing in it".to_owned(),
                why => why.to_owned(),
            },
        }
    }

    /// What the file's head names.
    pub(crate) fn probe<E: From<VideoError>>(
        &self,
        go_on: impl Fn() -> Result<(), E>,
    ) -> Result<Clip, E> {
        let mut args: Vec<OsString> = ASK.iter().chain(&ONLY).map(Into::into).collect();
        args.extend(["-i".into(), file(self.path)]);
        let run = Run {
            program: FFPROBE,
            args,
            what: self.name,
            limit: Duration::from_secs(120),
        };
        let (mut answer, mut message) = (Vec::new(), String::new());
        let status = run.run(
            whole(1 << 20),
            |bytes| {
                answer = bytes;
                Ok(())
            },
            |line| message = self.plain(line),
            || go_on().map_err(Halt),
        );
        let status = status.map_err(|Halt(why)| why)?;
        match clip(&answer) {
            Some(clip) => Ok(clip),
            None if status.success() => {
                let name = self.name.to_owned();
                Err(VideoError::NoPictures { name }.into())
            }
            None => Err(self.unreadable(&message).into()),
        }
    }

    /// Hands on the frames that `wanted` names, upright, each as a picture, and the times of all frames
    /// that were looked at; and what ffmpeg found wrong last, if anything. \[s\]
    pub(crate) fn frames<E: From<VideoError>>(
        &self,
        clip: &Clip,
        wanted: &Wanted<'_>,
        mut each: impl FnMut(Netpbm) -> Result<(), E>,
        go_on: impl Fn() -> Result<(), E>,
    ) -> Result<(Vec<f64>, Option<String>), E> {
        let run = Run {
            program: FFMPEG,
            args: self.args(clip, wanted),
            what: self.name,
            limit: Duration::from_secs_f64(120.0 + 30.0 * clip.seconds.unwrap_or(600.0)),
        };
        let (mut times, mut wrong, mut count) = (Vec::new(), None, 0usize);
        let status = run.run(
            netpbm::read,
            |picture| {
                count += 1;
                each(picture).map_err(Halt)
            },
            |line| match time(line) {
                Some(time) => times.push(time),
                None if line.contains("[error]") || line.contains("[fatal]") => {
                    wrong = Some(self.plain(line));
                }
                None => {}
            },
            || go_on().map_err(Halt),
        );
        let status = status.map_err(|Halt(why)| why)?;
        match count {
            0 => Err(self.unreadable(&wrong.unwrap_or_default()).into()),
            _ if !status.success() => Ok((times, wrong.or(Some("it ends in an error".into())))),
            _ => Ok((times, wrong)),
        }
    }

    fn args(&self, clip: &Clip, wanted: &Wanted<'_>) -> Vec<OsString> {
        let threads = rayon::current_num_threads().to_string();
        let mut args: Vec<OsString> = [
            "-nostdin",
            "-hide_banner",
            "-loglevel",
            "level+info",
            "-nostats",
        ]
        .iter()
        .chain(&ONLY)
        .map(Into::into)
        .collect();
        args.extend([
            "-threads".into(),
            threads.into(),
            "-i".into(),
            file(self.path),
        ]);
        let map = format!("0:{}", clip.stream);
        let codec = if wanted.grey { "pgm" } else { "ppm" };
        let rest = [
            "-map",
            &map,
            "-map_metadata",
            "-1",
            "-fps_mode",
            "passthrough",
            "-enc_time_base",
            "1:1000000",
            "-vf",
            &wanted.filters(clip),
            "-f",
            "image2pipe",
            "-c:v",
            codec,
            "pipe:1",
        ];
        args.extend(rest.map(Into::into));
        args
    }
}

/// A program's fault as the caller's own.
struct Halt<E>(E);

impl<E: From<VideoError>> From<ProgramError> for Halt<E> {
    fn from(error: ProgramError) -> Self {
        Halt(VideoError::from(error).into())
    }
}

/// The time of a frame, where a line has one. \[s\]
fn time(line: &str) -> Option<f64> {
    line.contains("showinfo").then_some(())?;
    let (_, behind) = line.split_once(" pts_time:")?;
    behind.split_whitespace().next()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_read_and_nothing_of_this_machine_is_shown() {
        let line = "[Parsed_showinfo_0 @ 0x55d0] [info] n:   2 pts:   1024 pts_time:0.0666667 duration: 512 fmt:yuv420p";
        assert_eq!(time(line), Some(0.0666667));
        assert_eq!(
            time("[Parsed_showinfo_0 @ 0x55d0] [info] config in time_base: 1/15360"),
            None
        );
        let source = Source {
            path: Path::new("/home/ada/turn.mp4"),
            name: "turn.mp4",
        };
        let message = source
            .plain("[mov,mp4 @ 0x55d0c] [error] file:/home/ada/turn.mp4: moov atom not found");
        assert_eq!(message, "[mov,mp4] turn.mp4: moov atom not found");
    }
}
