//! Texts for people: nothing that steers a terminal, no more digits than matter.

use std::path::Path;

/// A text that steers no terminal: whatever a file's or a person's name brings along is escaped.
pub fn plain(text: String) -> String {
    match text.contains(|c: char| c.is_control()) {
        true => escaped(&text.replace("\r\n", "\n"), &['\n', '\t']),
        false => text,
    }
}

/// A text whose control characters are escaped, but for some.
pub fn escaped(text: &str, but: &[char]) -> String {
    let one = |c: char| match c.is_control() && !but.contains(&c) {
        true => c.escape_default().to_string(),
        false => c.to_string(),
    };
    text.chars().map(one).collect()
}

/// A path in a line.
pub fn shown(path: &Path) -> String {
    escaped(&path.to_string_lossy(), &[])
}

/// So many of something: `1 photo`, `2 photos`.
pub fn count(n: impl std::fmt::Display, one: &str) -> String {
    let n = n.to_string();
    match n.as_str() {
        "1" => format!("1 {one}"),
        _ => format!("{n} {one}s"),
    }
}

/// A number for people: whole as it is, else with four digits that matter.
pub fn short(x: f64) -> String {
    if !x.is_finite() || (x.fract() == 0.0 && x.abs() < 1e9) {
        return format!("{x}");
    }
    let digits = 3 - libm::log10(x.abs()).floor() as i32;
    let text = format!("{x:.*}", digits.clamp(0, 8) as usize);
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

#[cfg(test)]
mod tests {
    use super::short;

    #[test]
    fn numbers_keep_the_digits_that_matter() {
        for (x, text) in [
            (18.0, "18"),
            (1670.0939, "1670"),
            (0.15337, "0.1534"),
            (2.5, "2.5"),
            (12.0004, "12"),
            (0.000_012_344, "0.00001234"),
            (-27.1828, "-27.18"),
            (f64::NAN, "NaN"),
        ] {
            assert_eq!(short(x), text);
        }
    }
}
