//! Which classes count, and which are one.

use anyhow::{Result, bail};
use std::str::FromStr;

/// A choice of classes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Classes {
    /// Each as the labels name it.
    All,
    /// These only: the label's name, and the name that it goes by.
    Some(Vec<(String, String)>),
}

/// Rectangle, round and finger of the drawn shapes.
const THREE: &str = "rectangle,disc=round,finger";
/// Objects of tactnet that press as something round, rectangular or long.
const GROUPS: &str = "ball=round,rock=round,sticky_tape=round,box=rectangular,rubber=rectangular,finger=finger-like,\
    pen=finger-like,highlighter=finger-like,cable=finger-like,cable_pipe=finger-like,tube=finger-like";

impl FromStr for Classes {
    type Err = anyhow::Error;

    fn from_str(text: &str) -> Result<Classes> {
        let list = match text {
            "all" => return Ok(Classes::All),
            "three" => THREE,
            "groups" => GROUPS,
            list => list,
        };
        let pair = |item: &str| match item.split_once('=').unwrap_or((item, item)) {
            (from, to) if from.is_empty() || to.is_empty() => {
                bail!("expected NAME or NAME=GROUP, with commas between")
            }
            (from, to) => Ok((from.to_string(), to.to_string())),
        };
        list.split(',').map(|item| pair(item.trim())).collect::<Result<_>>().map(Classes::Some)
    }
}

impl Classes {
    /// The class of what the labels name so, if it counts.
    pub fn of<'a>(&'a self, name: &'a str) -> Option<&'a str> {
        match self {
            Classes::All => Some(name),
            Classes::Some(list) => list.iter().find(|(from, _)| from == name).map(|(_, to)| to.as_str()),
        }
    }
}
