//! Slurm's own commands: run, and their output read.

use std::process::{Command, Stdio};

/// Why Slurm could not be asked.
#[derive(Debug, thiserror::Error)]
pub enum SlurmError {
    /// Not installed.
    #[error("`{0}` is not here: this machine submits to no Slurm; run this where `sbatch` works")]
    Missing(&'static str),
    /// It refuses.
    #[error("`{command}` printed: {answer}")]
    Refused {
        /// The command.
        command: String,
        /// What it printed.
        answer: String,
    },
    /// It printed something else than it should.
    #[error("`{command}` printed {answer:?}, which is not understood")]
    Odd {
        /// The command.
        command: String,
        /// What it printed.
        answer: String,
    },
}

/// Runs a command of Slurm with a text as its input. Returns what it prints.
pub(crate) fn ask(name: &'static str, words: &[String], input: &str) -> Result<String, SlurmError> {
    use std::io::Write;
    let mut command = Command::new(name);
    // Formats of these variables would change what is printed.
    let command = command.args(words).env_remove("SQUEUE_FORMAT");
    let command = command.stdin(Stdio::piped()).stdout(Stdio::piped());
    let spawned = command.stderr(Stdio::piped()).spawn();
    let mut child = spawned.map_err(|_| SlurmError::Missing(name))?;
    if let Some(mut to) = child.stdin.take() {
        // A command that does not read it reports why below.
        let _ = to.write_all(input.as_bytes());
    }
    let refused = |answer: String| SlurmError::Refused {
        command: format!("{name} {}", words.join(" ")),
        answer: answer.trim().to_owned(),
    };
    let ended = child
        .wait_with_output()
        .map_err(|e| refused(e.to_string()))?;
    match ended.status.success() {
        true => Ok(String::from_utf8_lossy(&ended.stdout).into_owned()),
        false => Err(refused(String::from_utf8_lossy(&ended.stderr).into_owned())),
    }
}

/// What the site takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// The largest array.
    pub most_elements: usize,
    /// Jobs that it holds at all.
    pub most_jobs: usize,
}

impl Limits {
    /// As `scontrol show config` gives them.
    ///
    /// # Errors
    ///
    /// There is no Slurm, or it does not answer.
    pub fn of_site() -> Result<Limits, SlurmError> {
        let words = ["show", "config"].map(str::to_owned);
        Limits::read(&ask("scontrol", &words, "")?)
    }

    /// Reads them.
    pub(crate) fn read(config: &str) -> Result<Limits, SlurmError> {
        let number = |name: &str| {
            let line = config.lines().find(|l| l.trim_start().starts_with(name));
            let (_, value) = line?.split_once('=')?;
            value.trim().parse::<usize>().ok().filter(|n| *n > 0)
        };
        // Numbers of elements go from 0 to one less than this.
        let limits = number("MaxArraySize").zip(number("MaxJobCount"));
        let (most_elements, most_jobs) = limits.ok_or_else(|| SlurmError::Odd {
            command: "scontrol show config".into(),
            answer: config.chars().take(200).collect(),
        })?;
        Ok(Limits {
            most_elements,
            most_jobs,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_are_read_and_nonsense_is_refused() {
        let answer =
            "Configuration data as of 2026\nMaxArraySize            = 1001\nMaxJobCount  = 10000\n";
        let limits = Limits::read(answer).unwrap();
        assert_eq!((limits.most_elements, limits.most_jobs), (1001, 10_000));
        for wrong in [
            "",
            "MaxArraySize = x\nMaxJobCount = 3",
            "MaxArraySize = 0\nMaxJobCount = 3",
        ] {
            assert!(Limits::read(wrong).is_err(), "{wrong}");
        }
    }
}
