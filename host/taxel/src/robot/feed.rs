//! A concept's value, in words of the command line and of `robot.toml`.

use crate::error::UsageError;
use taxel_core::format::{Q15, name};
use taxel_core::intent::Feed;

/// Parses `NAME=VALUE[,AGE_MS[,TIMEOUT_MS[,DEFAULT]]]`: a value in -1 ..= 1, its age (default 0 ms), the age
/// from which it expires (default never, as for 0), and the value that replaces it then (default 0).
pub fn feed(text: &str) -> Result<Feed, UsageError> {
    let wrong = |why: String| UsageError::Argument(why);
    let expected = || wrong("expected NAME=VALUE[,AGE_MS[,TIMEOUT_MS[,DEFAULT]]]".into());
    let (concept, values) = text.split_once('=').ok_or_else(expected)?;
    let short = name(concept);
    if short != concept || short.is_empty() {
        return Err(wrong(format!("{concept:?} is not a concept's name: 1 to 16 bytes")));
    }
    let words: Vec<&str> = values.split(',').map(str::trim).collect();
    if words.len() > 4 {
        return Err(wrong(format!("{text}: {} values, expected 1 to 4", words.len())));
    }
    let fraction = |text: &str| -> Result<Q15, UsageError> {
        let value: Option<f64> = text.parse().ok().filter(|value: &f64| (-1.0..=1.0).contains(value));
        let value = value.ok_or_else(|| wrong(format!("{text:?} is not a number in -1 ..= 1")))?;
        Ok(Q15((value * f64::from(Q15::ONE.0)).round() as i32))
    };
    let ms = |at: usize| {
        let not_ms = |text| wrong(format!("{text:?} is not a number of ms"));
        words.get(at).map_or(Ok(0), |text| text.parse().map_err(|_| not_ms(text)))
    };
    Ok(Feed {
        concept: short,
        value: fraction(words.first().unwrap_or(&""))?,
        age_ms: ms(1)?,
        timeout_ms: ms(2)?,
        default: words.get(3).map_or(Ok(Q15(0)), |text| fraction(text))?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_has_an_age_and_a_default() {
        let whole = feed("warmth=-0.5,80,2000,0.25").unwrap();
        assert_eq!((whole.concept.as_str(), whole.value, whole.age_ms), ("warmth", Q15(-16_384), 80));
        assert_eq!((whole.timeout_ms, whole.default), (2000, Q15(8_192)));
        let short = feed("warmth=1").unwrap();
        assert_eq!((short.value, short.age_ms, short.timeout_ms, short.default), (Q15::ONE, 0, 0, Q15(0)));
    }

    #[test]
    fn what_is_no_value_is_refused_in_one_sentence() {
        for (text, why) in [
            ("warmth", "expected NAME=VALUE[,AGE_MS[,TIMEOUT_MS[,DEFAULT]]]"),
            ("=1", "\"\" is not a concept's name: 1 to 16 bytes"),
            ("seventeen-letters=1", "\"seventeen-letters\" is not a concept's name: 1 to 16 bytes"),
            ("warmth=1.5", "\"1.5\" is not a number in -1 ..= 1"),
            ("warmth=NaN", "\"NaN\" is not a number in -1 ..= 1"),
            ("warmth=1,-3", "\"-3\" is not a number of ms"),
            ("warmth=1,0,5,2", "\"2\" is not a number in -1 ..= 1"),
            ("warmth=1,0,0,0,0", "warmth=1,0,0,0,0: 5 values, expected 1 to 4"),
        ] {
            assert_eq!(feed(text).unwrap_err().to_string(), why);
        }
    }
}
