//! Numbers, clock times and missing values in a field.

/// Value of a field: NaN if it is empty or marked as missing, `None` if it is not a number.
pub(super) fn parse(field: &str, decimal_comma: bool) -> Option<f64> {
    let field = field.trim();
    if field.is_empty() || is_missing(field) {
        return Some(f64::NAN);
    }
    let number: Option<f64> = if decimal_comma && field.contains(',') {
        if field.contains('.') {
            return None;
        }
        decimal(&field.replacen(',', ".", 1))
    } else {
        decimal(field)
    };
    number
        .map(|value| if is_overflow(value) { f64::NAN } else { value })
        .or_else(|| clock(field, decimal_comma))
}

/// Numbers that instruments send for values out of range or undefined (SCPI 1999, volume 1, 7.2.1.4 and
/// 7.2.1.5).
fn is_overflow(value: f64) -> bool {
    [9.9e37, 9.91e37].contains(&value.abs())
}

/// A number; its exponent letter may be the D of Fortran.
fn decimal(field: &str) -> Option<f64> {
    let with_e = || field.contains(['d', 'D']).then(|| field.replacen(['d', 'D'], "e", 1));
    field.parse().ok().or_else(|| with_e()?.parse().ok())
}

/// Words that measuring programs and spreadsheets write for a missing value.
fn is_missing(field: &str) -> bool {
    [
        "nan", "-", "--", "n/a", "na", "#n/a", "#nv", "null", "none", "#div/0!", "#value!", "1.#qnan",
        "-nan", "missing",
    ]
    .iter()
    .any(|word| word.eq_ignore_ascii_case(field))
}

/// Seconds of `12:34:56.789`, counted from 1970 if a date `2024-05-17` precedes it.
fn clock(field: &str, decimal_comma: bool) -> Option<f64> {
    let (date, time) = match field.split_once(['T', ' ']) {
        Some((date, time)) => (Some(date), time),
        None => (None, field),
    };
    let mut parts = time.trim_end_matches('Z').split(':');
    let (hours, minutes) = (parts.next()?.parse::<u32>().ok()?, parts.next()?.parse::<u32>().ok()?);
    let seconds = parts.next().map_or(Some(0.0), |text| {
        let text = if decimal_comma { text.replacen(',', ".", 1) } else { text.to_owned() };
        text.parse::<f64>().ok()
    })?;
    if parts.next().is_some() || minutes > 59 || !(0.0..61.0).contains(&seconds) {
        return None;
    }
    let days = date.map_or(Some(0.0), days_since_1970)?;
    Some(86_400.0 * days + 3600.0 * f64::from(hours) + 60.0 * f64::from(minutes) + seconds)
}

/// Days of a date of the Gregorian calendar, by counting years from March on.
fn days_since_1970(date: &str) -> Option<f64> {
    let mut parts = date.split('-').map(|part| part.parse::<i64>().ok());
    let (year, month, day) = (parts.next()??, parts.next()??, parts.next()??);
    let is_date = (0..=9999).contains(&year) && (1..=12).contains(&month) && (1..=31).contains(&day);
    if parts.next().is_some() || !is_date {
        return None;
    }
    let (year, month) = if month > 2 { (year, month - 3) } else { (year - 1, month + 9) };
    let leap_days = year.div_euclid(4) - year.div_euclid(100) + year.div_euclid(400);
    // From March on, months have 31, 30, 31, 30, 31 days repeatedly: 153 in five. 719 468 days lie between
    // 0000-03-01 and 1970-01-01.
    Some((365 * year + leap_days + (153 * month + 2) / 5 + day - 1 - 719_468) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_with_point_and_comma() {
        assert_eq!(parse(" 1.5e-3 ", false), Some(1.5e-3));
        assert_eq!(parse("1,5E-3", true), Some(1.5e-3));
        assert_eq!(parse("1,5", false), None);
        assert_eq!(parse("1.000,5", true), None);
        assert!(parse("", false).unwrap().is_nan() && parse("#N/A", true).unwrap().is_nan());
    }

    #[test]
    fn overflow_of_an_instrument_is_missing() {
        for text in ["9.9E37", "-9.9e37", "9.91E+37"] {
            assert!(parse(text, false).unwrap().is_nan(), "{text}");
        }
        assert_eq!(parse("9.9e36", false), Some(9.9e36));
    }

    #[test]
    fn numbers_of_fortran_are_read() {
        assert_eq!(parse("1.5000D-03", false), Some(1.5e-3));
        assert_eq!(parse("-2,5d+01", true), Some(-25.0));
        assert_eq!(parse("D", false), None);
        assert_eq!(parse("1D", false), None);
    }

    #[test]
    fn clock_times_are_seconds() {
        assert_eq!(parse("01:02:03.25", false), Some(3723.25));
        assert_eq!(parse("01:02:03,25", true), Some(3723.25));
        assert_eq!(parse("1970-01-02T00:00:01", false), Some(86_401.0));
        assert_eq!(parse("2000-03-01 00:00:00", false), Some(951_868_800.0));
        assert_eq!(parse("12:99:00", false), None);
        assert_eq!(parse("4000000000:00:00", false), Some(1.44e13));
        assert_eq!(parse("9000000000000000000-01-01 00:00:00", false), None);
    }
}
