//! The last screen of `tailor measure`: what was measured, what was not, and where it is.

use super::columns::broken;
use super::spoken::reported;
use crate::words::language::{Language, Words};
use crate::words::messages::read;
use shape::{Cameras, Girth, Girths, Scale, Score, Unit, by_reason, girth_names};
use stage::Message;

/// The columns of a row of girths after its name: tape, interval and contour (structural).
const NUMBERS: usize = 36;

/// Of what the screen is.
pub(crate) struct Of<'a> {
    /// What the capture is called.
    pub(crate) name: &'a str,
    /// So many photos were looked at.
    pub(crate) photos: usize,
    /// Where they were taken from, if photos there are.
    pub(crate) cameras: Option<&'a Cameras>,
    /// What was measured.
    pub(crate) girths: &'a Girths,
}

/// A length in the reader's unit, without it.
fn length(words: Words, girths: &Girths) -> impl Fn(f64) -> String {
    move |mm| match girths.unit {
        Unit::Metric if words.inches => words.number(mm / 25.4, 1),
        Unit::Metric => words.number(mm / 10.0, 1),
        Unit::Relative => words.number(mm / 1000.0, 4),
    }
}

/// Names as they fit into a column: those of files are left out where all would not fit.
struct Names {
    words: Words,
    /// How wide the column is.
    wide: usize,
    /// Whether those of files are beside those of people.
    of_files: bool,
}

impl Names {
    /// Of what is shown, beside numbers.
    fn fitting(words: Words, girths: &Girths, columns: usize) -> Names {
        let named = |of_files: bool| {
            let mut names = Names {
                words,
                wide: 24,
                of_files,
            };
            let all = girths.girths.iter().map(|g| names.of(g));
            let all = all.chain(girths.ratios.iter().map(|r| names.ratio(&r.0)));
            let widest = all.map(|name| name.chars().count()).max();
            names.wide = names.wide.max(widest.unwrap_or(0));
            names
        };
        let whole = named(true);
        match whole.wide + NUMBERS <= columns {
            true => whole,
            false => named(false),
        }
    }

    /// A girth as people call it, with its name in files.
    fn of(&self, girth: &Girth) -> String {
        let label = match self.words.language {
            Language::En => girth.label.clone(),
            Language::De => self.words.girth(&girth.name, &girth.label),
        };
        match (label.is_empty(), self.of_files) {
            (true, _) => girth.name.clone(),
            (_, true) => format!("{label} ({})", girth.name),
            (_, false) => label,
        }
    }

    /// A ratio as people call it, with its name in files.
    fn ratio(&self, name: &str) -> String {
        let text = self.words.girth(name, name);
        match (text == name, self.of_files) {
            (true, _) => text,
            (_, true) => format!("{} ({name})", lower(self.words, text)),
            (_, false) => lower(self.words, text),
        }
    }
}

/// The screen, so many columns wide.
pub(crate) fn screen(words: Words, of: &Of<'_>, columns: usize) -> String {
    let girths = of.girths;
    let broken = |line: &str, indent| broken(line, indent, columns);
    let head = of.cameras.map(|c| first(words, of, c));
    let mut text = head.map_or(String::new(), |[seen, origin]| {
        broken(&seen, 2) + &broken(&origin, 2) + "\n"
    });
    let names = Names::fitting(words, girths, columns);
    let wide = names.wide;
    text += &table(&names, girths, columns);
    if let Some(mm) = girths.stature_mm {
        let name = lower(words, words.text("girth-stature"));
        text += &format!("{name:<wide$} {:>8}\n", length(words, girths)(mm));
    }
    if girths.compression_pct > 0.0 {
        let percent = words.written(&girths.compression_pct.to_string());
        let put = [("percent", percent.into())];
        text += &broken(&words.with("screen-shortened", &put), 2);
    }
    for (name, value, note) in &girths.ratios {
        let name = names.ratio(name);
        let value = words.number(*value, 3);
        let note = reported(words, note);
        let line = format!("{name:<wide$} {value:>8}  {note}");
        text += &broken(line.trim_end(), wide + 11);
    }
    if let Some(bmi) = girths.bmi {
        let name = lower(words, words.text("result-bmi"));
        text += &format!("{name:<wide$} {:>8}  kg/m²\n", words.number(bmi, 1));
    }
    text += &grown(words, girths, wide);
    if !girths.missing.is_empty() {
        text += &format!("\n{}\n", words.text("screen-missing"));
    }
    // One reason is shown once, for all that it is the reason of.
    for (why, all) in by_reason(&girths.missing) {
        let why = reported(words, why);
        let all = read(words, &girth_names(&all));
        text += &broken(&format!("  {all}: {why}"), 4);
    }
    text
}

/// How many photos have a camera, and where lengths come from.
fn first(words: Words, of: &Of<'_>, cameras: &Cameras) -> [String; 2] {
    let put = [
        ("name", of.name.into()),
        ("with", cameras.views.len().into()),
        ("of", of.photos.into()),
    ];
    [words.with("screen-cameras", &put), origin(words, cameras)]
}

/// The girths, a row each; without contours where these do not fit.
fn table(names: &Names, girths: &Girths, columns: usize) -> String {
    let (words, wide) = (names.words, names.wide);
    let whole = wide + NUMBERS <= columns;
    let row = |cells: [&str; 4]| {
        let [name, tape, interval, contour] = cells;
        let contour = if whole { contour } else { "" };
        let line = format!("{name:<wide$} {tape:>8}  {interval:<16} {contour:>8}");
        line.trim_end().to_owned() + "\n"
    };
    if girths.girths.is_empty() {
        return String::new();
    }
    let tape = match girths.unit {
        Unit::Metric => words.with("screen-tape", &[("unit", words.unit().into())]),
        Unit::Relative => words.text("screen-tape-relative"),
    };
    let [girth, interval, contour] =
        ["girth", "interval", "contour"].map(|key| words.text(&format!("screen-{key}")));
    let mut text = row([&girth, &tape, &interval, &contour]);
    let length = length(words, girths);
    for g in &girths.girths {
        let interval = match g.interval_mm {
            Some([low, high]) => {
                let put = [("low", length(low).into()), ("high", length(high).into())];
                words.with("screen-range", &put)
            }
            None => {
                let parts = g.sigmas.unknown().join(", ");
                words.with("screen-unknown", &[("parts", parts.into())])
            }
        };
        let (tape, contour) = (length(g.tape_mm), length(g.contour_mm));
        text += &row([&names.of(g), &tape, &interval, &contour]);
    }
    text
}

/// Hip and waist in a sentence, as far as they were measured: `hip 98.2 cm (97.0 to 99.4), waist 81.5 cm (80.1 to 82.9)`.
pub(crate) fn in_short(words: Words, girths: &Girths) -> String {
    let unit = match girths.unit {
        Unit::Metric => format!(" {}", words.unit()),
        Unit::Relative => String::new(),
    };
    let main = girths
        .girths
        .iter()
        .filter(|g| ["HC", "WC"].contains(&g.name.as_str()));
    let length = length(words, girths);
    let one = |g: &Girth| {
        let name = lower(words, words.girth(&g.name, &g.label));
        let tape = format!("{name} {}{unit}", length(g.tape_mm));
        match g.interval_mm {
            Some([low, high]) => {
                let put = [("low", length(low).into()), ("high", length(high).into())];
                format!("{tape} ({})", words.with("screen-range", &put))
            }
            None => tape,
        }
    };
    let all: Vec<String> = main.map(one).collect();
    match all.is_empty() {
        true => words.text("screen-none"),
        false => all.join(", "),
    }
}

/// What was warned of on the way, once more and counted.
pub(crate) fn warned(words: Words, warnings: &[Message], columns: usize) -> String {
    if warnings.is_empty() {
        return String::new();
    }
    let count = words.with("screen-warnings", &[("count", warnings.len().into())]);
    let mut text = format!("\n{count}\n");
    for warning in warnings {
        text += &broken(&format!("  {}", reported(words, warning)), 4, columns);
    }
    text
}

/// A name as it is written within a line: only German begins nouns with a capital.
fn lower(words: Words, name: String) -> String {
    let mut letters = name.chars();
    match (words.language, letters.next()) {
        (Language::En, Some(one)) => one.to_lowercase().chain(letters).collect(),
        _ => name,
    }
}

fn origin(words: Words, cameras: &Cameras) -> String {
    let from = match cameras.scale {
        Scale::Mat => "screen-from-mat",
        Scale::Tags => "screen-from-tags",
        Scale::Reference => "screen-from-reference",
        Scale::Disk => "screen-from-disk",
        Scale::Stature => "screen-from-stature",
        Scale::Given => "screen-given",
        Scale::Disputed(_) => return words.text("screen-disputed"),
        Scale::Nothing => return words.text("screen-relative"),
    };
    let from = words.text(from);
    match cameras.scale_sigma {
        Some(sigma) => {
            let percent = words.number(100.0 * sigma, 2);
            let put = [("from", from.into()), ("percent", percent.into())];
            words.with("screen-lengths", &put)
        }
        None => words.with("screen-lengths-unsure", &[("from", from.into())]),
    }
}

/// A child beside the growth reference: a line a number.
fn grown(words: Words, girths: &Girths, wide: usize) -> String {
    let Some(growth) = girths.growth else {
        return String::new();
    };
    let line = |(key, score): (&str, Option<Score>)| {
        let Score { z, centile } = score?;
        let name = lower(words, words.text(key));
        // The reference is named behind the number.
        let name = name.split(',').next().unwrap_or_default();
        let centile = words.number(centile, 1);
        let child = words.with("screen-child", &[("centile", centile.into())]);
        Some(format!(
            "{name:<wide$} {:>8}  {child}\n",
            words.number(z, 2)
        ))
    };
    let lines = [
        ("result-height-for-age", growth.height),
        ("result-bmi-for-age", growth.bmi),
    ];
    lines.into_iter().filter_map(line).collect()
}

#[cfg(test)]
#[path = "screen_tests.rs"]
mod tests;
