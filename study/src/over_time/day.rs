//! Days in names of folders.

use stage::day_number;

/// The first day, `YYYY-MM-DD` or `YYYYMMDD`, that is in a name by itself.
pub(super) fn day_in(name: &str) -> Option<String> {
    let digits = |text: &str| text.bytes().all(|b| b.is_ascii_digit());
    let whole = |from: usize, to: usize| {
        let beside = |at: Option<u8>| at.is_none_or(|b| !b.is_ascii_digit());
        let before = from.checked_sub(1).map(|i| name.as_bytes()[i]);
        beside(before) && beside(name.as_bytes().get(to).copied())
    };
    (0..name.len()).find_map(|i| {
        let long = name.get(i..i + 10).filter(|_| whole(i, i + 10));
        let short = name.get(i..i + 8).filter(|t| digits(t) && whole(i, i + 8));
        let short = short.map(|t| format!("{}-{}-{}", &t[..4], &t[4..6], &t[6..]));
        let both = [long.map(str::to_owned), short];
        both.into_iter()
            .flatten()
            .find(|day| day_number(day).is_some())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_are_read_out_of_names() {
        for (name, day) in [
            ("anna-2026-05-01-out", Some("2026-05-01")),
            ("20260501_anna", Some("2026-05-01")),
            ("anna-120260501", None),
            ("änna 7", None),
        ] {
            assert_eq!(day_in(name).as_deref(), day, "{name}");
        }
    }
}
