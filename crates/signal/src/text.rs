//! Text of messages: names without control characters, time differences without their rounding.

/// Whether a character is invisible: controls the terminal, ends a line, changes the direction of writing,
/// has no width, or is a tag.
#[must_use]
pub fn is_control(character: char) -> bool {
    character.is_control()
        || matches!(
            character,
            '\u{61c}'
                | '\u{200b}'..='\u{200f}'
                | '\u{2028}'..='\u{202e}'
                | '\u{2060}'..='\u{206f}'
                | '\u{feff}'
                | '\u{e0000}'..='\u{e007f}'
        )
}

/// A difference of two times to six digits: further digits are rounding of the times.
pub(crate) fn time_difference(seconds: f64) -> f64 {
    format!("{seconds:.5e}").parse().unwrap_or(seconds)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_of_the_times_is_dropped() {
        assert_eq!([0.7 - 0.679, 0.3 - 0.299, 1e-7 / 3.0].map(time_difference), [0.021, 0.001, 3.33333e-8]);
    }
}
