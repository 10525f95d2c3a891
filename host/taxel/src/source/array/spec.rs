//! The name of an array's source: `FORMAT:LINK[,key=value...]`.

use super::formats;
use super::link::ArrayLink;

use crate::text::words;
use std::fmt;
use std::str::FromStr;

/// An array, where it is, and what the user says of it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ArraySpec {
    /// Name of the format, or path of a description (.toml).
    pub format: String,
    /// Source of its bytes.
    pub link: ArrayLink,
    /// Further keys in the order of the user.
    pub keys: Vec<(String, String)>,
}

impl ArraySpec {
    /// Reads a source's name; none if it begins with no format.
    pub fn read(text: &str) -> Option<Result<ArraySpec, String>> {
        let known = formats::NAMES.iter().copied().find(|name| text == *name || is_before_link(text, name));
        let file = || text.find(".toml:").map(|at| &text[..at + ".toml".len()]);
        let format = known.or_else(file)?;
        Some(text[format.len()..].strip_prefix(':').unwrap_or("").parse::<LinkAndKeys>().and_then(|rest| {
            let LinkAndKeys(link, keys) = rest;
            let allowed = formats::keys(format, &link);
            for (at, (key, _)) in keys.iter().enumerate() {
                if keys[..at].iter().any(|(other, _)| other == key) {
                    return Err(format!("{text}: `{key}` is given twice"));
                }
                if !allowed.contains(&key.as_str()) {
                    return Err(format!("{text}: {}", words::unknown("key", key, allowed)));
                }
            }
            Ok(ArraySpec { format: format.into(), link, keys })
        }))
    }

    /// Names of the formats that come with the program: `numbers, flexitac, ...`.
    pub fn formats() -> String {
        formats::NAMES.join(", ")
    }

    /// True if its format is a file.
    pub(crate) fn is_described_by_file(&self) -> bool {
        !formats::NAMES.contains(&self.format.as_str())
    }

    /// Value of a key.
    pub fn key(&self, key: &str) -> Option<&str> {
        self.keys.iter().find(|(known, _)| known == key).map(|(_, value)| value.as_str())
    }
}

fn is_before_link(text: &str, name: &str) -> bool {
    text.strip_prefix(name).is_some_and(|rest| rest.starts_with(':'))
}

struct LinkAndKeys(ArrayLink, Vec<(String, String)>);

impl FromStr for LinkAndKeys {
    type Err = String;

    /// Keys begin at the first comma that a word and `=` follow.
    fn from_str(text: &str) -> Result<LinkAndKeys, String> {
        let is_key = |rest: &str| {
            let word = rest.split_once('=').map_or("", |(word, _)| word);
            !word.is_empty() && word.chars().all(|sign| sign.is_ascii_lowercase() || sign == '_')
        };
        let start = text.match_indices(',').map(|(at, _)| at).find(|at| is_key(&text[at + 1..]));
        let (link, keys) = start.map_or((text, ""), |at| (&text[..at], &text[at + 1..]));
        let key = |pair: &str| match pair.split_once('=') {
            Some((key, value)) if is_key(pair) && !value.is_empty() => {
                Ok((key.to_string(), value.to_string()))
            }
            _ => Err(format!("\"{pair}\" must be key=value")),
        };
        let keys = keys.split(',').filter(|_| !keys.is_empty()).map(key).collect::<Result<_, _>>()?;
        Ok(LinkAndKeys(link.parse()?, keys))
    }
}

impl fmt::Display for ArraySpec {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.format, self.link)?;
        self.keys.iter().try_for_each(|(key, value)| write!(f, ",{key}={value}"))
    }
}
