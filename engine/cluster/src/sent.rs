//! Jobs that Slurm knows or remembers, and how much memory is to be asked for after it was too little.

/// A job that is known.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Sent {
    /// The layer, by its place in the plan.
    pub layer: usize,
    /// Its number.
    pub id: String,
    /// In what state: `PENDING`, `RUNNING`, …
    pub state: String,
    /// Why it waits or how it ended.
    pub reason: String,
    /// The memory that it was given, as Slurm writes it: `4G`.
    pub mem: String,
}

impl Sent {
    /// Whether it may still work.
    pub fn is_alive(&self) -> bool {
        const ALIVE: [&str; 8] = [
            "PENDING",
            "RUNNING",
            "SUSPENDED",
            "CONFIGURING",
            "COMPLETING",
            "REQUEUED",
            "RESIZING",
            "STAGE_OUT",
        ];
        ALIVE.contains(&self.state.as_str())
    }

    /// A line of `squeue -o %F|%j|%T|%m|%r`; `names` are those of the layers.
    pub(crate) fn queued(line: &str, names: &[String]) -> Option<Sent> {
        let mut parts = line.trim().splitn(5, '|').map(str::to_owned);
        let (id, job, state, mem) = (parts.next()?, parts.next()?, parts.next()?, parts.next()?);
        Some(Sent {
            layer: names.iter().position(|n| *n == job)?,
            id,
            state,
            mem,
            reason: parts.next().unwrap_or_default(),
        })
    }

    /// A line of `sacct -P -o JobID,JobName,State,ReqMem`.
    pub(crate) fn remembered(line: &str, names: &[String]) -> Option<Sent> {
        let mut parts = line.trim().split('|');
        let (id, job, state, mem) = (parts.next()?, parts.next()?, parts.next()?, parts.next()?);
        // `CANCELLED by 1000`; the element of an array comes after `_`.
        let first = |text: &str, by: char| text.split(by).next().unwrap_or_default().to_owned();
        Some(Sent {
            layer: names.iter().position(|n| *n == job)?,
            id: first(id, '_'),
            state: first(state, ' '),
            mem: mem.to_owned(),
            reason: String::new(),
        })
    }
}

/// The memory to ask for: half as much again as the most that elements of a layer had when it was not
/// enough, or what is wished if that is more.
pub fn more_memory(sent: &[Sent], layer: usize, wished: Option<&str>) -> Option<String> {
    let short = sent
        .iter()
        .filter(|s| s.layer == layer && s.state == "OUT_OF_MEMORY");
    let most = short.filter_map(|s| mebibytes(&s.mem)).max();
    let more = most.map(|most| (most * 3).div_ceil(2));
    match wished.and_then(mebibytes) {
        Some(wished) if more.is_some_and(|more| more > wished) => more.map(|m| format!("{m}M")),
        Some(_) => wished.map(str::to_owned),
        None => more.map(|m| format!("{m}M")).or(wished.map(str::to_owned)),
    }
}

/// `4G`, `4000M`, `4Gn` (a node) as mebibytes; an amount a core (`4Gc`) is not known here.
fn mebibytes(text: &str) -> Option<u64> {
    let text = text.trim().trim_end_matches('n');
    let unit = text.chars().next_back()?;
    let (number, bytes) = match unit {
        'K' => (&text[..text.len() - 1], 1.0 / 1024.0),
        'M' => (&text[..text.len() - 1], 1.0),
        'G' => (&text[..text.len() - 1], 1024.0),
        'T' => (&text[..text.len() - 1], 1024.0 * 1024.0),
        '0'..='9' => (text, 1.0),
        _ => return None,
    };
    let number: f64 = number.parse().ok()?;
    (number > 0.0 && number < 1e9).then(|| (number * bytes).ceil() as u64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_slurm_are_read_and_memory_grows_by_half() {
        let names = ["words-a-L0", "words-a-L1"].map(str::to_owned);
        let queue = "7|words-a-L1|OUT_OF_MEMORY|4G|OutOfMemory\n7|words-a-L1|FAILED|9G|NonZeroExitCode\n8|other|RUNNING|4G|None";
        let sent: Vec<Sent> = queue
            .lines()
            .filter_map(|l| Sent::queued(l, &names))
            .collect();
        assert_eq!((sent.len(), sent[0].layer), (2, 1));
        let more = |layer, wished| more_memory(&sent, layer, wished);
        assert_eq!(more(1, None).as_deref(), Some("6144M"));
        assert_eq!(more(1, Some("5G")).as_deref(), Some("6144M"));
        assert_eq!(more(1, Some("8G")).as_deref(), Some("8G"));
        assert_eq!(
            (more(0, None), more(0, Some("1G"))),
            (None, Some("1G".into()))
        );
        let past = "7_3|words-a-L0|OUT_OF_MEMORY|4000Mn\n7_4|words-a-L0|CANCELLED by 12|1G\n";
        let sent: Vec<Sent> = past
            .lines()
            .filter_map(|l| Sent::remembered(l, &names))
            .collect();
        assert_eq!(
            (sent[0].id.as_str(), sent[1].state.as_str()),
            ("7", "CANCELLED")
        );
        assert_eq!(more_memory(&sent, 0, None).as_deref(), Some("6000M"));
        assert!(!sent[0].is_alive());
    }

    #[test]
    fn memory_that_is_not_understood_is_not_guessed() {
        for (text, want) in [
            ("1T", Some(1 << 20)),
            ("512K", Some(1)),
            ("300", Some(300)),
            ("2.5G", Some(2560)),
        ] {
            assert_eq!(mebibytes(text), want, "{text}");
        }
        for text in ["", "G", "4Gc", "-1G", "NaNG", "0", "?"] {
            assert_eq!(mebibytes(text), None, "{text}");
        }
    }
}
