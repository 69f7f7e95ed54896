//! The last screen of `tailor measure`: what was measured, what was not, and where it lies.

use shape::{Cameras, Girth, Girths, Scale, Score, Unit, by_reason, listed};

/// Lines are broken before this column.
const WIDTH: usize = 100;

/// The screen.
pub(crate) fn screen(
    name: &str,
    photos: usize,
    cameras: Option<&Cameras>,
    girths: &Girths,
    inches: bool,
) -> String {
    let mut text = String::new();
    if let Some(cameras) = cameras {
        text += &format!(
            "{name}: {} of {photos} photos have a camera; {}\n\n",
            cameras.views.len(),
            origin(cameras)
        );
    }
    let wide = girths.girths.iter().map(|g| called(g).chars().count());
    let wide = wide.fold(24, usize::max);
    let (head, length): (_, fn(f64) -> String) = match girths.unit {
        Unit::Metric if inches => ("tape in", |mm| format!("{:.1}", mm / 25.4)),
        Unit::Metric => ("tape cm", |mm| format!("{:.1}", mm / 10.0)),
        Unit::Relative => ("relative", |mm| format!("{:.4}", mm / 1000.0)),
    };
    if !girths.girths.is_empty() {
        text += &format!(
            "{:<wide$} {:>8}  {:<16} {:>8}\n",
            "girth", head, "interval (90 %)", "contour"
        );
    }
    for g in &girths.girths {
        let interval = match g.interval_mm {
            Some([lo, hi]) => format!("{} to {}", length(lo), length(hi)),
            None => format!("unknown: {}", g.sigmas.unknown().join(", ")),
        };
        let label = called(g);
        let (tape, contour) = (length(g.tape_mm), length(g.contour_mm));
        text += &format!("{label:<wide$} {tape:>8}  {interval:<16} {contour:>8}\n");
    }
    if let Some(mm) = girths.stature_mm {
        text += &format!("{:<wide$} {:>8}\n", "stature", length(mm));
    }
    if girths.compression_pct > 0.0 {
        let percent = girths.compression_pct;
        text += &format!("tapes are shortened by {percent} %, as compression_pct declares\n");
    }
    for (name, value, note) in &girths.ratios {
        text += format!("{name:<wide$} {value:>8.3}  {note}").trim_end();
        text.push('\n');
    }
    if let Some(bmi) = girths.bmi {
        text += &format!("{:<wide$} {bmi:>8.1}  kg/m²\n", "body mass index");
    }
    text += &grown(girths, wide);
    if !girths.missing.is_empty() {
        text += "\nnot measured\n";
    }
    // One reason is shown once, for all that it is the reason of.
    for (why, all) in by_reason(&girths.missing) {
        text += &broken(&format!("  {}: {why}", listed(&all)), 4);
    }
    text
}

/// What was warned of on the way, once more and counted.
pub(crate) fn warned(warnings: &[String]) -> String {
    let mut text = match warnings.len() {
        0 => return String::new(),
        1 => "\n1 warning\n".to_owned(),
        n => format!("\n{n} warnings\n"),
    };
    for warning in warnings {
        text += &broken(&format!("  {warning}"), 4);
    }
    text
}

/// A girth as people call it, with its name in files.
fn called(girth: &Girth) -> String {
    match girth.label.is_empty() {
        true => girth.name.clone(),
        false => format!("{} ({})", girth.label, girth.name),
    }
}

fn origin(cameras: &Cameras) -> String {
    let from = match cameras.scale {
        Scale::Mat => "the marker mat",
        Scale::Tags => "the marker tags",
        Scale::Reference => "the reference length",
        Scale::Disk => "the disk's diameter",
        Scale::Stature => "the subject's stature",
        Scale::Given => "the cameras that were given",
        Scale::Disputed(_) => {
            return "LENGTHS ARE RELATIVE, for known lengths contradict each other (see below): \
                    ratios of girths hold, and 1 is the camera ring's radius"
                .into();
        }
        Scale::Nothing => {
            return "LENGTHS ARE RELATIVE, for nothing of known length was given: \
                    ratios hold, and 1 is the camera ring's radius"
                .into();
        }
    };
    let sure = match cameras.scale_sigma {
        Some(sigma) => format!("± {:.2} %", 100.0 * sigma),
        None => "how sure: unknown".into(),
    };
    format!("lengths come from {from} ({sure})")
}

/// The line in pieces, the later ones set in.
fn broken(line: &str, indent: usize) -> String {
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
fn grown(girths: &Girths, wide: usize) -> String {
    let Some(growth) = girths.growth else {
        return String::new();
    };
    let line = |(name, score): (&str, Option<Score>)| {
        let Score { z, centile } = score?;
        Some(format!(
            "{name:<wide$} {z:>8.2}  z, WHO 2007; centile {centile:.1}; no diagnosis\n"
        ))
    };
    let lines = [
        ("height for age", growth.height),
        ("BMI for age", growth.bmi),
    ];
    lines.into_iter().filter_map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use shape::{GirthId, Length, Refusal};

    #[test]
    fn long_lines_are_broken_between_words_and_lose_none() {
        let why = "arms and trunk are one on the surface there ".repeat(5);
        let text = broken(&format!("  CC     {why}"), 9);
        assert!(text.lines().count() > 2 && text.lines().all(|l| l.chars().count() <= WIDTH));
        assert!(
            text.lines()
                .skip(1)
                .all(|l| l.starts_with("         a") || !l.starts_with("          "))
        );
        let words = |t: &str| t.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
        assert_eq!(words(&text), words(&format!("CC {why}")));
    }

    #[test]
    fn one_reason_is_told_once_for_all_that_it_is_the_reason_of() {
        let missing = shape::Missing::because;
        let legs = "the surface shows no two legs";
        let girths = Girths {
            missing: vec![
                missing(GirthId::Hip, Refusal::NoLegs, legs),
                missing(GirthId::Neck, Refusal::NoNeck, "no neck"),
                missing(GirthId::Waist, Refusal::NoLegs, legs),
            ],
            ..Girths::default()
        };
        let text = screen("a", 3, None, &girths, false);
        assert_eq!(
            text,
            format!("\nnot measured\n  hip, waist: {legs}\n  neck: no neck\n")
        );
    }

    #[test]
    fn what_has_no_scale_says_so() {
        let mut cameras = Cameras {
            views: [].into_iter().collect(),
            scale: Scale::Nothing,
            scale_sigma: None,
            disk_radius_mm: None,
            ground_mm: 0.0,
            points: vec![],
        };
        let text = screen("a", 3, Some(&cameras), &Girths::default(), false);
        assert!(text.contains("LENGTHS ARE RELATIVE"), "{text}");
        cameras.scale = Scale::Disputed([Length::Mat, Length::Stature]);
        let text = screen("a", 3, Some(&cameras), &Girths::default(), false);
        assert!(
            text.contains("known lengths contradict each other"),
            "{text}"
        );
        cameras.scale = Scale::Mat;
        let text = screen("a", 3, Some(&cameras), &Girths::default(), false);
        assert!(
            text.contains("a: 0 of 3 photos")
                && text.contains("the marker mat (how sure: unknown)"),
            "{text}"
        );
        cameras.scale_sigma = Some(0.0012);
        assert!(screen("a", 3, Some(&cameras), &Girths::default(), false).contains("(± 0.12 %)"));
    }
}
