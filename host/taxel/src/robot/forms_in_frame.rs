//! Forms per frame, in words of the command line and of `robot.toml`.

use serde::de::{Error, Unexpected, Visitor};
use serde::{Deserialize, Deserializer};
use std::fmt;
use std::str::FromStr;
#[cfg(doc)]
use taxel_core::contact::Forms;

/// Number of contacts whose form is computed in a frame: the argument of [`Forms::of`], 0 for all.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FormsInFrame(pub u8);

/// Values of [`FormsInFrame`] in words.
const FORMS: &str = "expected 1 to 254, or all";

impl FromStr for FormsInFrame {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<FormsInFrame, &'static str> {
        match text.parse() {
            Ok(count @ 1..=254) => Ok(FormsInFrame(count)),
            _ if text == "all" => Ok(FormsInFrame(0)),
            _ => Err(FORMS),
        }
    }
}

impl<'de> Deserialize<'de> for FormsInFrame {
    fn deserialize<D: Deserializer<'de>>(value: D) -> Result<FormsInFrame, D::Error> {
        struct Forms;
        impl Visitor<'_> for Forms {
            type Value = FormsInFrame;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("1 to 254, or \"all\"")
            }

            fn visit_i64<E: Error>(self, count: i64) -> Result<FormsInFrame, E> {
                let known = u8::try_from(count).ok().filter(|count| (1..=254).contains(count));
                known.map(FormsInFrame).ok_or_else(|| E::invalid_value(Unexpected::Signed(count), &self))
            }

            fn visit_str<E: Error>(self, text: &str) -> Result<FormsInFrame, E> {
                text.parse().map_err(|_| E::invalid_value(Unexpected::Str(text), &self))
            }
        }
        value.deserialize_any(Forms)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use taxel_core::contact::Forms;

    #[test]
    fn a_number_of_forms_or_all() {
        let forms = |text: &str| text.parse::<FormsInFrame>().map(|forms| forms.0);
        assert_eq!((forms("1").unwrap(), forms("254").unwrap()), (1, 254));
        assert_eq!(Forms::of(forms("all").unwrap()), Forms::ALL);
        for text in ["0", "255", "256", "-1", "", "any"] {
            assert!(forms(text).is_err(), "{text}");
        }
    }
}
