//! Lengths, weights and ages as people write them: `178`, `1.78m`, `70in`, `5ft10in`, `176lb`, `9y6mo`.

use stage::{Message, message};

stage::messages! {
    NO_LENGTH = "cli-no-length": "`{text}` is not a length such as 178, 178cm, 1.78m, 70in or 5ft10in";
    NO_WEIGHT = "cli-no-weight": "`{text}` is not a weight such as 80, 80kg or 176lb";
    NO_AGE = "cli-no-age": "`{text}` is not an age such as 9.5, 9y6mo or 114mo";
}

/// Units of length, each in millimetres; longer words first where one begins another.
const LENGTHS: [(&str, f64); 7] = [
    ("mm", 1.0),
    ("cm", 10.0),
    ("m", 1000.0),
    ("in", 25.4),
    ("\"", 25.4),
    ("ft", 304.8),
    ("'", 304.8),
];

/// Units of weight, each in kilograms.
const WEIGHTS: [(&str, f64); 2] = [("kg", 1.0), ("lb", 0.453_592_37)];

/// A length; a bare number is in `bare`. \[mm\]
pub(super) fn length_mm(text: &str, bare: &str) -> Result<f64, Message> {
    amount(text, bare, &LENGTHS).ok_or_else(|| message!(NO_LENGTH, text = text))
}

/// A weight; a bare number is in kilograms. \[kg\]
pub(super) fn weight_kg(text: &str) -> Result<f64, Message> {
    amount(text, "kg", &WEIGHTS).ok_or_else(|| message!(NO_WEIGHT, text = text))
}

/// Units of age, each in months.
const AGES: [(&str, f64); 4] = [("y", 12.0), ("years", 12.0), ("mo", 1.0), ("months", 1.0)];

/// An age; a bare number is in years. \[months\]
pub(super) fn age_months(text: &str) -> Result<f64, Message> {
    amount(text, "y", &AGES).ok_or_else(|| message!(NO_AGE, text = text))
}

/// Numbers with their units, summed.
fn amount(text: &str, bare: &str, units: &[(&str, f64)]) -> Option<f64> {
    let in_units = |word: &str| units.iter().find(|(unit, _)| *unit == word).map(|u| u.1);
    let mut rest = text.trim();
    let mut sum = 0.0;
    let mut first = true;
    while !rest.is_empty() {
        let ends = |c: char| !(c.is_ascii_digit() || c == '.');
        let end = rest.find(ends).unwrap_or(rest.len());
        let number: f64 = rest[..end].parse().ok()?;
        rest = rest[end..].trim_start();
        let next = |c: char| c.is_ascii_digit() || c == '.' || c == ' ';
        let word = &rest[..rest.find(next).unwrap_or(rest.len())];
        // 5ft10: what follows feet and has no unit is inches.
        let unit = match (word, first) {
            ("", true) => bare,
            ("", false) => "in",
            (word, _) => word,
        };
        sum += number * in_units(unit)?;
        rest = rest[word.len()..].trim_start();
        first = false;
    }
    // What a decimal fraction of an inch leaves behind the millionth is none of anybody's.
    (!first).then(|| (sum * 1e6).round() / 1e6)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn people_write_lengths_in_many_ways() {
        for (text, mm) in [
            ("178", 1780.0),
            ("178 cm", 1780.0),
            ("1.78m", 1780.0),
            ("1780mm", 1780.0),
            ("70in", 1778.0),
            ("5ft10in", 1778.0),
            ("5'10\"", 1778.0),
            ("5 ft 10", 1778.0),
        ] {
            assert_eq!(length_mm(text, "cm"), Ok(mm), "{text}");
        }
        assert_eq!(length_mm("60", "mm"), Ok(60.0));
        assert_eq!(weight_kg("100lb"), Ok(45.359_237));
        for (text, months) in [("9.5", 114.0), ("9y6mo", 114.0), ("114 months", 114.0)] {
            assert_eq!(age_months(text), Ok(months), "{text}");
        }
        assert!(age_months("9y6").is_err() && age_months("old").is_err());
        for wrong in ["", "tall", "1.7.8", "178kg", "-3", "1,78m"] {
            assert!(
                length_mm(wrong, "cm").unwrap_err().contains("5ft10in"),
                "{wrong}"
            );
        }
    }
}
