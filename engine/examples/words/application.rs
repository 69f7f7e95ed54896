//! What is done: words are counted file by file, and a page shows the most frequent.

use crate::nouns::{Counts, Text};
use engine::{Catalog, Kind};
use engine::{Importer, NamedFiles, WriteError};
use stage::{AnyArtifact, Artifact, Ctx, Files, Metric, Stage, Stop, erase};
use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::sync::Arc;

stage::params! {
    /// Which words count.
    pub struct CountParams {
        /// Shorter words are passed over.
        #[range(1..=100)]
        least_letters: u32 = 1,
    }
}

stage::inputs! {
    /// A folder of texts.
    pub struct CountInput {
        /// Text files.
        files: Arc<Files>,
    }
}

/// `words.count`: files → counts. A file that was counted before is not read again.
pub(crate) struct Count;

impl Stage for Count {
    const NAME: &'static str = "words.count";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "Counts the words of each file.";
    const METRICS: &'static [&'static str] = &["files read"];
    type Params = CountParams;
    type Input = CountInput;
    type Output = Counts;

    fn run(p: &CountParams, input: CountInput, ctx: &Ctx<'_>) -> Result<Counts, Stop> {
        let (mut counts, mut read) = (Counts::default(), 0);
        let steps = ctx.steps("files", input.files.entries.len());
        for entry in &input.files.entries {
            let part: Counts = ctx.part("file", &[entry.content], || {
                read += 1;
                let text = String::from_utf8(input.files.read(entry)?)?;
                let words = words(&text, p.least_letters as usize);
                // The name of a file is no part of what its part depends on.
                let files = BTreeMap::from([(String::new(), words)]);
                Ok(Counts { files })
            })?;
            let words = part.files.into_values().next().unwrap_or_default();
            counts.files.insert(entry.name.clone(), words);
            steps.tick()?;
        }
        ctx.metric("files read", f64::from(read), "");
        Ok(counts)
    }
}

/// A kernel: it knows no stage.
fn words(text: &str, least_letters: usize) -> BTreeMap<String, u64> {
    let mut counts = BTreeMap::new();
    let words = text.split(|c: char| !c.is_alphabetic());
    for word in words.filter(|w| !w.is_empty() && w.chars().count() >= least_letters) {
        *counts.entry(word.to_lowercase()).or_default() += 1;
    }
    counts
}

stage::params! {
    /// How much is reported.
    pub struct TellParams {
        /// So many words at most.
        #[range(1..=10000)]
        most: u32 = 10,
    }
}

stage::inputs! {
    /// Counts.
    pub struct TellInput {
        /// How often words occur in files.
        counts: Arc<Counts>,
    }
}

/// `words.tell`: counts → text.
pub(crate) struct Tell;

impl Stage for Tell {
    const NAME: &'static str = "words.tell";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "Tells the most frequent words.";
    type Params = TellParams;
    type Input = TellInput;
    type Output = Text;

    fn run(p: &TellParams, input: TellInput, _: &Ctx<'_>) -> Result<Text, Stop> {
        let all = input.counts.all();
        let mut words: Vec<(&str, u64)> = all.into_iter().collect();
        words.sort_by_key(|(word, count)| (Reverse(*count), *word));
        let mut text = format!("{} words in all\n", words.len());
        for (word, count) in words.iter().take(p.most as usize) {
            writeln!(text, "{count:>6} {word}")?;
        }
        Ok(Text(text))
    }
}

stage::inputs! {
    /// A text from elsewhere.
    pub struct TakeInput {
        /// One text file.
        files: Arc<Files>,
    }
}

/// `words.take`: files → text. What programs write is taken by it.
pub(crate) struct Take;

impl Stage for Take {
    const NAME: &'static str = "words.take";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "Takes a text from a file.";
    type Params = ();
    type Input = TakeInput;
    type Output = Text;

    fn run(_: &(), input: TakeInput, _: &Ctx<'_>) -> Result<Text, Stop> {
        let mut text = String::new();
        for entry in &input.files.entries {
            text += &String::from_utf8(input.files.read(entry)?)?;
        }
        Ok(Text(text))
    }
}

/// Counts as CSV; a text as it is.
fn files(
    artifact: AnyArtifact,
    _format: &str,
    _beside: Option<AnyArtifact>,
) -> Result<NamedFiles, WriteError> {
    let text = match artifact.clone().downcast::<Counts>() {
        Some(counts) => {
            let rows = counts.files.iter().flat_map(|(file, words)| {
                let row = move |(word, count): (&String, &u64)| format!("{file},{word},{count}\n");
                words.iter().map(row)
            });
            format!("file,word,count\n{}", rows.collect::<String>())
        }
        None => artifact
            .downcast::<Text>()
            .map_or(String::new(), |t| t.0.clone()),
    };
    Ok(vec![(String::new(), text.into_bytes())])
}

/// The numbers of counts themselves: for tables of sweeps.
fn facts(artifact: AnyArtifact) -> Vec<Metric> {
    let Some(counts) = artifact.downcast::<Counts>() else {
        return vec![];
    };
    let all = counts.all();
    let metric = |name: &str, value: u64| Metric {
        name: name.into(),
        value: value as f64,
        unit: String::new(),
    };
    vec![
        metric("words", all.values().sum()),
        metric("distinct", all.len() as u64),
    ]
}

/// The application.
pub(crate) static CATALOG: Catalog = Catalog {
    program: "words 1",
    stages: &[&[&erase::<Count>(), &erase::<Tell>(), &erase::<Take>()]],
    pipelines: &[],
    importers: &[Importer {
        stage: &erase::<Take>(),
        files: &["text.txt"],
        layout: 1,
    }],
    kinds: &[
        Kind {
            name: Counts::KIND,
            formats: &["csv"],
            beside: None,
            files,
            extension: |_| None,
            facts,
            names: |_| ["words", "distinct"].map(String::from).to_vec(),
        },
        Kind {
            name: Text::KIND,
            formats: &["txt"],
            beside: None,
            files,
            extension: |_| None,
            facts: |_| vec![],
            names: |_| vec![],
        },
    ],
};

/// The program.
pub(crate) static WORDS: command::Program = command::Program::new(
    "words",
    "1",
    "How often words occur in the files of a folder.",
    &CATALOG,
);
