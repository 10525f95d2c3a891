//! Calendar days as text.

use crate::time::calendar;

/// Today (UTC) as year-month-day.
pub fn today() -> String {
    date(calendar().as_secs() / 86_400)
}

/// Days from one year-month-day to another; 0 if the second is earlier, none if one of them is not a day.
pub fn days_between(from: &str, to: &str) -> Option<u64> {
    Some(number(to)?.saturating_sub(number(from)?))
}

/// Year, month and day; none if the text is not a day.
pub fn parts(text: &str) -> Option<(u16, u8, u8)> {
    let mut parts = text.split('-');
    let (year, month, day) = (parts.next()?, parts.next()?, parts.next()?);
    number(text)?;
    Some((year.parse().ok()?, month.parse().ok()?, day.parse().ok()?))
}

/// Date of a day since 1 January 1970. A span of 400 years has 146,097 days, and a year counted from March
/// has its leap day last.
fn date(days: u64) -> String {
    let days = days + 719_468;
    let (span, day) = (days / 146_097, days % 146_097);
    let year = (day - day / 1460 + day / 36_524 - day / 146_096) / 365;
    let day = day - (365 * year + year / 4 - year / 100);
    let month = (5 * day + 2) / 153;
    let day = day - (153 * month + 2) / 5 + 1;
    let (month, later) = if month < 10 { (month + 3, 0) } else { (month - 9, 1) };
    format!("{:04}-{month:02}-{day:02}", span * 400 + year + later)
}

/// Days since 1 January 1970. No year is longer than 366 days, so the search is short.
fn number(text: &str) -> Option<u64> {
    let year: u64 = text.get(..4)?.parse().ok()?;
    let least = year.checked_sub(1970)? * 365;
    (least..least + 2_500).find(|days| date(*days) == text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_have_their_dates() {
        let known =
            [(0, "1970-01-01"), (11_016, "2000-02-29"), (19_723, "2024-01-01"), (20_513, "2026-03-01")];
        for (days, text) in known {
            assert_eq!((date(days).as_str(), number(text)), (text, Some(days)));
        }
        assert_eq!(days_between("2024-02-28", "2024-03-01"), Some(2));
        assert_eq!(days_between("2024-03-01", "2024-02-28"), Some(0));
        assert_eq!([days_between("2023-02-29", "2024-01-01"), days_between("", "x")], [None; 2]);
        assert_eq!(parts("2026-11-21"), Some((2026, 11, 21)));
        assert_eq!(parts("2026-13-21"), None);
    }
}
