//! Selection and merging of classes.

use anyhow::{Error, Result, bail};
use std::str::FromStr;

/// A selection of classes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Classes {
    /// All classes of the labels.
    All,
    /// Only these: name in the labels, and name of the class.
    Some(Vec<(String, String)>),
}

/// Rectangle, round and finger of the drawn shapes.
const THREE: &str = "rectangle,disc=round,finger";
/// Objects of tactnet whose contact is round, rectangular or long.
const GROUPS: &str = "ball=round,rock=round,sticky_tape=round,box=rectangular,rubber=rectangular,finger=finger-like,\
    pen=finger-like,highlighter=finger-like,cable=finger-like,cable_pipe=finger-like,tube=finger-like";

impl FromStr for Classes {
    type Err = Error;

    fn from_str(text: &str) -> Result<Classes> {
        let list = match text {
            "all" => return Ok(Classes::All),
            "three" => THREE,
            "groups" => GROUPS,
            list => list,
        };
        let pair = |item: &str| match item.split_once('=').unwrap_or((item, item)) {
            (from, to) if from.is_empty() || to.is_empty() => {
                bail!("expected NAME or NAME=GROUP, separated by commas")
            }
            (from, to) => Ok((from.to_string(), to.to_string())),
        };
        list.split(',').map(|item| pair(item.trim())).collect::<Result<_>>().map(Classes::Some)
    }
}

impl Classes {
    /// Class of a label's name; none if it is not selected.
    pub fn of<'a>(&'a self, name: &'a str) -> Option<&'a str> {
        match self {
            Classes::All => Some(name),
            Classes::Some(list) => list.iter().find(|(from, _)| from == name).map(|(_, to)| to.as_str()),
        }
    }
}
