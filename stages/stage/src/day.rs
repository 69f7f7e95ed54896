//! Days of the calendar, counted.

/// A day since 1970-01-01 as `2027-11-25` (Howard Hinnant's algorithm, proleptic Gregorian calendar).
pub fn day_text(day: i64) -> String {
    let day = day + 719_468;
    let era = day.div_euclid(146_097);
    let of_era = day.rem_euclid(146_097);
    let year = (of_era - of_era / 1460 + of_era / 36_524 - of_era / 146_096) / 365;
    let of_year = of_era - (365 * year + year / 4 - year / 100);
    let month = (5 * of_year + 2) / 153;
    let date = of_year - (153 * month + 2) / 5 + 1;
    let month = if month < 10 { month + 3 } else { month - 9 };
    let year = year + 400 * era + i64::from(month <= 2);
    format!("{year:04}-{month:02}-{date:02}")
}

/// Days since 1970-01-01 of a day as [`day_text`] writes it; `None` where that is no day of the calendar.
pub fn day_number(text: &str) -> Option<i64> {
    let mut words = text.splitn(3, '-').map(|word| word.parse::<i64>().ok());
    let (year, month, date) = (words.next()??, words.next()??, words.next()??);
    let shifted = if month <= 2 { year - 1 } else { year };
    let (era, of_era) = (shifted.div_euclid(400), shifted.rem_euclid(400));
    let of_year = (153 * ((month + 9) % 12) + 2) / 5 + date - 1;
    let day = era * 146_097 + of_era * 365 + of_era / 4 - of_era / 100 + of_year - 719_468;
    // A day that there is not comes back as another.
    ((1..=9999).contains(&year) && day_text(day) == text).then_some(day)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_come_back_and_those_that_there_are_not_are_none() {
        for (day, is) in [
            (0, "1970-01-01"),
            (11_016, "2000-02-29"),
            (20_779, "2026-11-22"),
        ] {
            assert_eq!((day_text(day).as_str(), day_number(is)), (is, Some(day)));
        }
        for day in -1000..40_000 {
            assert_eq!(day_number(&day_text(day)), Some(day));
        }
        let none = "2026-02-29 1900-02-29 2026-13-01 2026-00-10 2026-04-31 2026-1-1 26-01-01 2026-1-01x 20260101 yesterday \
            2026-05-01T10:00 2026-11-25x";
        for none in none.split_whitespace().chain([""]) {
            assert_eq!(day_number(none), None, "{none}");
        }
    }
}
