//! Text of messages: names without control characters, time differences without their rounding.

/// Whether a character is invisible: controls the terminal, ends a line, changes the direction of writing, or
/// is one that may be left out when a text is shown (`Default_Ignorable_Code_Point` of Unicode 16).
#[must_use]
pub fn is_control(character: char) -> bool {
    character.is_control()
        || matches!(
            character,
            '\u{ad}'
                | '\u{34f}'
                | '\u{61c}'
                | '\u{115f}'..='\u{1160}'
                | '\u{17b4}'..='\u{17b5}'
                | '\u{180b}'..='\u{180f}'
                | '\u{200b}'..='\u{200f}'
                | '\u{2028}'..='\u{202e}'
                | '\u{2060}'..='\u{206f}'
                | '\u{3164}'
                | '\u{fe00}'..='\u{fe0f}'
                | '\u{feff}'
                | '\u{ffa0}'
                | '\u{fff0}'..='\u{fffb}'
                | '\u{1bca0}'..='\u{1bca3}'
                | '\u{1d173}'..='\u{1d17a}'
                | '\u{e0000}'..='\u{e0fff}'
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
    fn what_is_not_seen_is_told_from_letters() {
        let unseen = ['\u{7}', '\r', '\u{ad}', '\u{34f}', '\u{3164}', '\u{202e}', '\u{fe0f}', '\u{e0100}'];
        assert!(unseen.into_iter().all(is_control));
        assert!(!"Träger äöü µ 中 é – \u{301}".chars().any(is_control));
    }

    #[test]
    fn rounding_of_the_times_is_dropped() {
        assert_eq!([0.7 - 0.679, 0.3 - 0.299, 1e-7 / 3.0].map(time_difference), [0.021, 0.001, 3.33333e-8]);
    }
}
