//! What is known of a capture, as flags: each is a key of `capture.toml`, given over the file.

use super::length::length_mm;
use super::mat_file::mat_file;
use super::numbers::Numbers;
use super::stated::{All, Stated, place};
use clap::Args;
use command::Fault;
use stage::{Message, message};
use std::path::PathBuf;

stage::messages! {
    NO_STEPS = "cli-flag-steps": "{flag}: how many even steps has the full turn?";
    NO_IDS = "cli-flag-ids": "{flag} {text}: give FIRST-LAST, such as 0-11";
    NO_CENTRE = "cli-flag-centre": "{flag} {text}: give X,Y, such as 804.8,1191";
    NO_REFERENCE = "cli-flag-reference": "{flag} {text}: give KIND=LENGTH, such as subject_height=165cm";
    NO_LENGTH = "cli-flag-length": "{flag} {text}: {why}";
    NO_ENDS = "cli-flag-seen": "{flag} {text}: give PHOTO=X1,Y1,X2,Y2, such as IMG_1.jpg=812,3011,1420,3055";
    SEEN_TWICE = "cli-flag-twice": "{flag} {text}: {photo} was named before; once a photo";
    NO_FACT = "cli-flag-fact": "{flag} {text}: give KEY=VALUE, such as subject.height_cm=178";
}

/// What is known of the capture; each wins over capture.toml.
#[derive(Args, Clone, Default)]
#[command(next_help_heading = "What is known of the capture (over capture.toml)")]
pub(crate) struct Facts {
    #[command(flatten)]
    numbers: Numbers,
    /// For growth references and thresholds: female or male
    #[arg(long, value_name = "SEX")]
    sex: Option<String>,
    /// The subject's day of birth, in place of an age: 2016-05-01; the capture's own day must be known
    #[arg(long, value_name = "DAY", conflicts_with = "age")]
    born: Option<String>,
    /// Principal point as a calibration gave it, in pixels, the top-left one's centre at 0,0
    #[arg(long, value_name = "X,Y")]
    centre_px: Option<String>,
    /// Into how many even steps the full turn was divided: 18 is a photo every 20°
    #[arg(
        long,
        value_name = "COUNT",
        conflicts_with = "step",
        allow_negative_numbers = true
    )]
    steps: Option<i64>,
    /// Which photos are the turn, in turning order: names or patterns such as 'IMG_01*.jpg'; may be repeated
    #[arg(long, value_name = "PATTERN")]
    images: Vec<String>,
    /// The photo of the same scene without the subject
    #[arg(long, value_name = "FILE")]
    plate: Option<String>,
    /// The day of the capture: 2026-05-01, or `exif` for the photos' own; it goes into girths and exports
    #[arg(long, value_name = "DAY")]
    date: Option<String>,
    /// What the capture is called in the report
    #[arg(long)]
    name: Option<String>,
    /// The marker mat: the file that `tailor mat` wrote (.pdf, .svg or .toml)
    #[arg(long, value_name = "FILE")]
    mat: Option<PathBuf>,
    /// First and last number of the mat's tags: 0-11
    #[arg(long, value_name = "FIRST-LAST")]
    mat_ids: Option<String>,
    /// First and last number of the rim's tags: 12-47
    #[arg(long, value_name = "FIRST-LAST")]
    rim_ids: Option<String>,
    /// A known length: subject_height=165cm, disk_diameter=70cm, tag_size=60mm, points=297mm (with --seen)
    #[arg(long, value_name = "KIND=LENGTH")]
    reference: Option<String>,
    /// Where the two ends of `--reference points` are in a photo, in pixels, upright and at full size; for two photos or more
    #[arg(long, value_name = "PHOTO=X1,Y1,X2,Y2")]
    seen: Vec<String>,
    /// Any key of capture.toml: subject.height_cm=178
    #[arg(long, value_name = "KEY=VALUE")]
    fact: Vec<String>,
}

impl Facts {
    /// Which files are the turn, where that is given.
    pub(super) fn images(&self) -> &[String] {
        &self.images
    }

    /// What was given of the person under a key of `[subject]`, as TOML has it.
    ///
    /// # Errors
    ///
    /// A flag that cannot be read.
    pub(super) fn personal(&self, key: &str) -> Result<Option<String>, Fault> {
        self.given(&format!("subject.{key}"))
    }

    /// What was given under a key, as TOML has it.
    ///
    /// # Errors
    ///
    /// A flag that cannot be read.
    pub(super) fn given(&self, key: &str) -> Result<Option<String>, Fault> {
        let begin = format!("{}=", place(key));
        let stated = self.stated()?;
        let value = stated.iter().find_map(|s| s.set.strip_prefix(&begin));
        let toml = |text: &str| text.parse().unwrap_or_else(|_| toml::Value::from(text));
        Ok(value.map(|text| toml(text).to_string()))
    }

    /// Whether marker tags are named.
    pub(super) fn tagged(&self) -> bool {
        let mat = |fact: &String| fact.starts_with("mat.");
        self.mat.is_some() || self.numbers.has("mat-tag") || self.fact.iter().any(mat)
    }

    /// Whether the disk's size is given, here or in capture.toml.
    ///
    /// # Errors
    ///
    /// A flag that cannot be read.
    pub(super) fn disk_given(&self, file: &toml::Table) -> Result<bool, Fault> {
        let (table, key) = ("disk", "diameter_cm");
        let in_file = file.get(table).is_some_and(|disk| disk.get(key).is_some());
        Ok(in_file || self.given(&format!("{table}.{key}"))?.is_some())
    }

    /// How far the subject turned between photos. \[°\]
    pub(super) fn step_deg(&self) -> Option<f64> {
        let steps = self.steps.filter(|steps| *steps != 0);
        let given = self.numbers.plain("step");
        given.or(steps.map(|steps| 360.0 / steps as f64))
    }

    /// The changes of the pipeline.
    pub(super) fn stated(&self) -> Result<Vec<Stated>, Fault> {
        let mut all = All(Vec::new());
        if let Some(file) = &self.mat {
            for (key, value) in mat_file(file)? {
                all.put("--mat", &file.display(), &key, &value);
            }
        }
        self.numbers.stated(&mut all)?;
        if let Some(steps) = self.steps {
            let degrees = self.step_deg();
            let none = || Fault::coded(&message!(NO_STEPS, flag = "--steps 0"));
            all.put(
                "--steps",
                &steps,
                "step_deg",
                &toml::Value::from(degrees.ok_or_else(none)?),
            );
        }
        for (flag, stated, key) in [
            ("--plate", &self.plate, "plate"),
            ("--name", &self.name, "name"),
            ("--date", &self.date, "date"),
            ("--sex", &self.sex, "subject.sex"),
            ("--born", &self.born, "subject.born"),
        ] {
            if let Some(text) = stated {
                all.put(flag, text, key, &toml::Value::from(text.clone()));
            }
        }
        if !self.images.is_empty() {
            let list = self.images.iter().cloned().map(toml::Value::from);
            let list = toml::Value::Array(list.collect());
            all.put("--images", &self.images.join(" "), "images", &list);
        }
        self.compound(&mut all)?;
        Ok(all.0)
    }

    /// Flags of several numbers, and free ones.
    fn compound(&self, all: &mut All) -> Result<(), Fault> {
        for (flag, stated, key) in [
            ("--mat-ids", &self.mat_ids, "mat"),
            ("--rim-ids", &self.rim_ids, "rim"),
        ] {
            let Some(text) = stated else { continue };
            let ends = text.split_once('-');
            let ends =
                ends.and_then(|(a, b)| Some((a.trim().parse().ok()?, b.trim().parse().ok()?)));
            let wrong = || Fault::coded(&message!(NO_IDS, flag = flag, text = text));
            let (first, last): (u32, u32) = ends.filter(|(a, b)| a <= b).ok_or_else(wrong)?;
            let ids = vec![i64::from(first).into(), i64::from(last).into()];
            all.put(flag, text, &format!("{key}.ids"), &toml::Value::Array(ids));
            let count = i64::from(last - first + 1);
            all.put(flag, text, &format!("{key}.count"), &count);
        }
        if let Some(text) = &self.centre_px {
            let flag = "--centre-px";
            let wrong = || Fault::coded(&message!(NO_CENTRE, flag = flag, text = text));
            let pixel = numbers(text, 2).ok_or_else(wrong)?;
            all.put(flag, text, "camera.centre_px", &pixel);
        }
        if let Some(text) = &self.reference {
            let flag = "--reference";
            let none = || Fault::coded(&message!(NO_REFERENCE, flag = flag, text = text));
            let (kind, length) = text.split_once('=').ok_or_else(none)?;
            let wrong = |why: Message| message!(NO_LENGTH, flag = flag, text = text, why = why);
            let mm = length_mm(length, "mm").map_err(|why| Fault::coded(&wrong(why)))?;
            let (kind, mm) = (toml::Value::from(kind.trim()), toml::Value::from(mm));
            all.put(flag, text, "reference.kind", &kind);
            all.put(flag, text, "reference.length_mm", &mm);
        }
        if !self.seen.is_empty() {
            let mut seen = toml::Table::new();
            for text in &self.seen {
                let (photo, ends) = ends(text)?;
                if seen.insert(photo.clone(), ends).is_some() {
                    let twice = message!(SEEN_TWICE, flag = SEEN, text = text, photo = photo);
                    return Err(Fault::coded(&twice));
                }
            }
            let seen = toml::Value::from(seen);
            all.put(SEEN, &self.seen.join(" "), "reference.seen", &seen);
        }
        for text in &self.fact {
            let flag = "--fact";
            let wrong = || Fault::coded(&message!(NO_FACT, flag = flag, text = text));
            let (key, value) = text.split_once('=').ok_or_else(wrong)?;
            all.put(flag, text, key.trim(), &value.trim());
        }
        Ok(())
    }
}

/// The flag of two ends of a length in a photo.
const SEEN: &str = "--seen";

/// A photo with the two ends of a length in it.
fn ends(text: &str) -> Result<(String, toml::Value), Fault> {
    let wrong = || Fault::coded(&message!(NO_ENDS, flag = SEEN, text = text));
    let (photo, at) = text.rsplit_once('=').ok_or_else(wrong)?;
    Ok((photo.trim().to_owned(), numbers(at, 4).ok_or_else(wrong)?))
}

/// So many numbers with commas between them, as a list.
fn numbers(text: &str, count: usize) -> Option<toml::Value> {
    let parts = text.split(',').map(|part| part.trim().parse::<f64>());
    let parts = parts.collect::<Result<Vec<f64>, _>>().ok()?;
    (parts.len() == count).then(|| parts.into())
}

#[cfg(test)]
#[path = "facts_tests.rs"]
mod tests;
