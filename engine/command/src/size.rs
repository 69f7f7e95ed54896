//! Sizes as people write them.

/// `500M` as bytes.
pub(super) fn bytes(text: &str) -> Result<u64, String> {
    let digits = text.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    let unit = text[digits.len()..].to_ascii_uppercase();
    let factor = match unit.trim_end_matches('B') {
        "" => Some(1u64),
        "K" => Some(1 << 10),
        "M" => Some(1 << 20),
        "G" => Some(1 << 30),
        _ => None,
    };
    let number = digits.parse::<f64>().ok().filter(|x| *x >= 0.0);
    let size = number.zip(factor).map(|(x, f)| (x * f as f64) as u64);
    size.ok_or_else(|| "give 500M or 20G".to_owned())
}

pub(super) fn mib(bytes: u64) -> f64 {
    bytes as f64 / f64::from(1 << 20)
}
