//! Parses the number of forms per frame from the command line.

use anyhow::{Result, bail};
#[cfg(doc)]
use taxel_core::contact::Forms;

/// Parses 1 to 254, or `all`. Returns the argument of [`Forms::of`].
pub fn forms(text: &str) -> Result<u8> {
    match text.parse() {
        Ok(count @ 1..=254) => Ok(count),
        _ if text == "all" => Ok(0),
        _ => bail!("expected 1 to 254, or all"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use taxel_core::contact::Forms;

    #[test]
    fn a_number_or_all() {
        assert_eq!((forms("1").unwrap(), forms("254").unwrap()), (1, 254));
        assert_eq!(Forms::of(forms("all").unwrap()), Forms::ALL);
        for text in ["0", "255", "256", "-1", "", "any"] {
            assert!(forms(text).is_err(), "{text}");
        }
    }
}
