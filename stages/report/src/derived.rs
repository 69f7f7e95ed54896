//! The table of what follows from girths, stature and weight: ratios and indices, with references beside them. No diagnosis.

use crate::lengths::Lengths;
use crate::tables::{escaped, weight};
use shape::{Girths, Score, Sex};

/// The waist that the WHO's thresholds are of: midway between the lowest rib and the iliac crest (WHO 2011, Waist
/// circumference and waist–hip ratio: report of an expert consultation, Geneva, 8–11 December 2008).
fn waist(girths: &Girths, lengths: Lengths) -> Option<(String, String, String)> {
    let waist = girths.get("WC").filter(|_| lengths != Lengths::Relative)?;
    let [men, women, most_men, most_women] =
        [940.0, 800.0, 1020.0, 880.0].map(|mm| lengths.text(mm));
    let note = match (girths.is_adult(), girths.sex) {
        (false, _) => String::new(),
        (_, Some(Sex::Male)) => {
            format!("WHO 2008, men: risk increased above {men}, substantially above {most_men}")
        }
        (_, Some(Sex::Female)) => {
            format!(
                "WHO 2008, women: risk increased above {women}, substantially above {most_women}"
            )
        }
        (_, None) => format!(
            "WHO 2008, adults: risk increased above {men} (men), {women} (women), substantially above {most_men}, {most_women}"
        ),
    };
    let value = format!("{} {}", lengths.text(waist.tape_mm), lengths.word());
    Some(("waist".into(), value, note))
}

/// A ratio's short name with what it is.
fn in_words(name: &str) -> String {
    let what = match name {
        "WHR" => "waist over hip",
        "WHR_tape" => "waist over hip, by tapes",
        "WHtR" => "waist over stature",
        "density_kg_l" => return "density [kg/l]".into(),
        _ => return name.into(),
    };
    format!("{what} ({name})")
}

/// A child beside the growth reference: a row a number.
fn for_age(girths: &Girths) -> Vec<(String, String, String)> {
    let (Some(growth), Some(sex), Some(months)) = (girths.growth, girths.sex, girths.age_months)
    else {
        return vec![];
    };
    let whom = match sex {
        Sex::Female => "girls",
        Sex::Male => "boys",
    };
    let (years, months) = (months.floor() / 12.0, months.floor() % 12.0);
    let of = format!(
        "WHO 2007, {whom} of {:.0} years {months:.0} months",
        years.floor()
    );
    let row = |(name, score, by): (&str, Option<Score>, &str)| {
        let Score { z, centile } = score?;
        let centile = match centile {
            c if (0.1..=99.9).contains(&c) => format!("centile {c:.1}"),
            c if c < 50.0 => "below the centile 0.1".into(),
            _ => "above the centile 99.9".into(),
        };
        let note = format!("{of}: {centile}{by}; z is in standard deviations from their median");
        Some((name.to_owned(), format!("z {z:+.2}"), note))
    };
    let stature = ", by the stature that was given";
    let rows = [
        ("height for age", growth.height, stature),
        ("body mass index for age", growth.bmi, ""),
    ];
    rows.into_iter().filter_map(row).collect()
}

/// Ratios and the like, with the thresholds of the WHO beside them as text.
pub(crate) fn derived(girths: &Girths, lengths: Lengths) -> String {
    let mut rows: Vec<(String, String, String)> = Vec::new();
    if let Some(mm) = girths.stature_mm {
        rows.push((
            "stature".into(),
            format!("{} {}", lengths.text(mm), lengths.word()),
            String::new(),
        ));
    }
    if let Some(kg) = girths.weight_kg {
        rows.push(("weight".into(), weight(kg, lengths), "as given".into()));
    }
    if let Some(bmi) = girths.bmi {
        let note = match girths.is_adult() {
            true => "WHO, adults: 18.5 to 24.9 normal, from 25 overweight, from 30 obese".into(),
            false => String::new(),
        };
        rows.push(("body mass index".into(), format!("{bmi:.1} kg/m²"), note));
    }
    rows.extend(for_age(girths));
    rows.extend(waist(girths, lengths));
    for (name, value, note) in &girths.ratios {
        rows.push((in_words(name), format!("{value:.3}"), note.to_string()));
    }
    if let Some(litres) = girths.volume_l {
        rows.push((
            "volume".into(),
            format!("{litres:.1} l"),
            "experimental".into(),
        ));
    }
    let row = |(name, value, note): &(String, String, String)| {
        let (name, value, note) = (escaped(name), escaped(value), escaped(note));
        format!(
            "<tr><td>{name}</td><td class=\"n\">{value}</td><td class=\"note\">{note}</td></tr>"
        )
    };
    let rows: String = rows.iter().map(row).collect();
    let whose = match (girths.is_adult(), girths.age_months) {
        (false, None) => {
            " Thresholds of adults are left out: no age was given, and the body is not known to be as tall as an adult. Give the age to see them."
        }
        _ => "",
    };
    format!(
        "<table class=\"facts\">{rows}</table><p class=\"note\">Numbers, no diagnosis.{whose}</p>"
    )
}
