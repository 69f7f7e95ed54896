//! The last screen of `tailor measure`: what was measured, what was not, and where it is.

use crate::words::language::{Language, Words};
use crate::words::messages::{in_words, read};
use shape::{Cameras, Girth, Girths, Scale, Score, Unit, by_reason, girth_names};
use stage::Message;

/// Lines are broken before this column: a terminal's as it comes, and what a page of text takes.
const WIDTH: usize = 80;

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

/// The screen.
pub(crate) fn screen(words: Words, of: &Of<'_>) -> String {
    let girths = of.girths;
    let mut text = of.cameras.map_or(String::new(), |c| first(words, of, c));
    let wide = girths.girths.iter().map(|g| called(words, g));
    let wide = wide.chain(girths.ratios.iter().map(|(name, ..)| ratio(words, name)));
    let wide = wide.map(|name| name.chars().count()).fold(24, usize::max);
    text += &table(words, girths, wide);
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
        let name = ratio(words, name);
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
fn first(words: Words, of: &Of<'_>, cameras: &Cameras) -> String {
    let put = [
        ("name", of.name.into()),
        ("with", cameras.views.len().into()),
        ("of", of.photos.into()),
    ];
    let seen = broken(&words.with("screen-cameras", &put), 2);
    seen + &broken(&origin(words, cameras), 2) + "\n"
}

/// The girths, a row each.
fn table(words: Words, girths: &Girths, wide: usize) -> String {
    if girths.girths.is_empty() {
        return String::new();
    }
    let tape = match girths.unit {
        Unit::Metric => words.with("screen-tape", &[("unit", words.unit().into())]),
        Unit::Relative => words.text("screen-tape-relative"),
    };
    let [girth, interval, contour] =
        ["girth", "interval", "contour"].map(|key| words.text(&format!("screen-{key}")));
    let mut text = format!("{girth:<wide$} {tape:>8}  {interval:<16} {contour:>8}\n");
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
        let name = called(words, g);
        let (tape, contour) = (length(g.tape_mm), length(g.contour_mm));
        text += &format!("{name:<wide$} {tape:>8}  {interval:<16} {contour:>8}\n");
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
pub(crate) fn warned(words: Words, warnings: &[Message]) -> String {
    if warnings.is_empty() {
        return String::new();
    }
    let count = words.with("screen-warnings", &[("count", warnings.len().into())]);
    let mut text = format!("\n{count}\n");
    for warning in warnings {
        text += &broken(&format!("  {}", reported(words, warning)), 4);
    }
    text
}

/// A ratio as people call it, with its name in files.
fn ratio(words: Words, name: &str) -> String {
    match words.girth(name, name) {
        text if text == *name => text,
        text => format!("{} ({name})", lower(words, text)),
    }
}

/// A message of a stage. The English texts of pages speak of their fields where stages speak of flags.
fn reported(words: Words, message: &Message) -> String {
    match words.language {
        Language::En => message.to_string(),
        Language::De => in_words(words, message),
    }
}

/// A girth as people call it, with its name in files.
fn called(words: Words, girth: &Girth) -> String {
    let label = match words.language {
        Language::En => girth.label.clone(),
        Language::De => words.girth(&girth.name, &girth.label),
    };
    match label.is_empty() {
        true => girth.name.clone(),
        false => format!("{label} ({})", girth.name),
    }
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

/// The line in pieces, the later ones set in.
pub(super) fn broken(line: &str, indent: usize) -> String {
    let (mut text, mut column) = (String::new(), 0);
    let lead = line.len() - line.trim_start().len();
    text += &line[..lead];
    for word in line[lead..].split_inclusive(' ') {
        let long = word.trim_end().chars().count();
        if column > 0 && lead + column + long > WIDTH {
            text.truncate(text.trim_end().len());
            text += &format!("\n{:indent$}", "");
            column = indent - lead;
        }
        text += word;
        column += word.chars().count();
    }
    text + "\n"
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
