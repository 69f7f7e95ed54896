//! Days: read from texts and names, and counted.

/// The first day, `YYYY-MM-DD` or `YYYYMMDD`, that stands in a name by itself.
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

/// Days since 1970-01-01 of a day `YYYY-MM-DD` (Howard Hinnant's algorithm); `None` where that is no day of the calendar.
pub fn day_number(day: &str) -> Option<i64> {
    let bytes = day.as_bytes();
    if bytes.len() != 10 || bytes[4] != b'-' || bytes[7] != b'-' {
        return None;
    }
    let number = |from: usize, to: usize| -> Option<i64> {
        let text = day.get(from..to)?;
        text.bytes()
            .all(|b| b.is_ascii_digit())
            .then(|| text.parse().ok())?
    };
    let (year, month, date) = (number(0, 4)?, number(5, 7)?, number(8, 10)?);
    let leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
    let most = match month {
        2 => 28 + i64::from(leap),
        4 | 6 | 9 | 11 => 30,
        1..=12 => 31,
        _ => 0,
    };
    if !(1..=most).contains(&date) {
        return None;
    }
    let (year, month) = if month > 2 {
        (year, month - 3)
    } else {
        (year - 1, month + 9)
    };
    let era = year.div_euclid(400);
    let of_era = year - era * 400;
    let of_year = (153 * month + 2) / 5 + date - 1;
    Some(era * 146_097 + of_era * 365 + of_era / 4 - of_era / 100 + of_year - 719_468)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_are_counted_and_read_out_of_names() {
        assert_eq!(day_number("1970-01-01"), Some(0));
        assert_eq!(day_number("2026-11-22"), Some(20_779));
        assert_eq!(
            day_number("2024-03-01").unwrap() - day_number("2024-02-28").unwrap(),
            2
        );
        for none in [
            "2026-02-29",
            "2026-13-01",
            "26-01-01",
            "2026-1-01x",
            "20260101",
        ] {
            assert_eq!(day_number(none), None, "{none}");
        }
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
