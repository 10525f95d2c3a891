//! Table of a judgement, script by script.

use super::author::Author;
use super::heard::{Heard, hear_all};
use super::rule::Wrong;
use super::varied::varied;
use anyhow::Result;
use std::path::Path;
use taxel::sim::Script;

/// Certainty from which a rule counts as sure.
pub const SURE: f64 = 0.8;

/// A script of an author, judged.
#[derive(Debug, Clone)]
pub struct Row {
    /// Index of the author.
    pub author: usize,
    /// Name of the script.
    pub script: String,
    /// How sure a person is.
    pub sure: f64,
    /// Word of a person.
    pub say: String,
    /// Words of the board.
    pub heard: Heard,
    /// Parts of the rule that do not hold.
    pub wrong: Vec<Wrong>,
}

/// Judges the scripts of all authors, as they are or as the variant with this seed, on boards with this map.
pub fn table(authors: &[Author], map: Option<&Path>, variant: Option<u64>) -> Result<Vec<Row>> {
    let judged =
        || authors.iter().enumerate().flat_map(|(at, author)| author.scripts.iter().map(move |it| (at, it)));
    let change = |script: &Script| variant.map_or_else(|| script.clone(), |seed| varied(script, seed));
    let scripts: Vec<Script> = judged().map(|(_, it)| change(&it.script)).collect();
    let row = |((author, it), heard): ((usize, &super::JudgedScript), Heard)| Row {
        author,
        script: it.script.name.clone(),
        sure: it.rule.sure,
        say: it.rule.say.clone(),
        wrong: it.rule.wrong(heard.said.iter().map(|(_, word)| *word), heard.felt),
        heard,
    };
    Ok(judged().zip(hear_all(&scripts, map)?).map(row).collect())
}

impl Row {
    /// True if the rule holds.
    pub fn is_right(&self) -> bool {
        self.wrong.is_empty()
    }

    /// A line: right or wrong, and what was said when.
    pub fn line(&self) -> String {
        let wrong: Vec<String> = self.wrong.iter().map(ToString::to_string).collect();
        let said =
            self.heard.said.iter().map(|(us, word)| format!("{:.2} s {}", *us as f64 / 1e6, word.as_str()));
        let said = said.collect::<Vec<_>>().join(", ");
        let right = if wrong.is_empty() { "right".to_string() } else { wrong.join("+") };
        format!("{:<28} {:.2}  {right:<12} {}: {said}", self.script, self.sure, self.say)
    }
}

/// Right ones and all of an author: sure, and the others.
pub fn counts(rows: &[Row], author: usize) -> [[usize; 2]; 2] {
    let mut counts = [[0; 2]; 2];
    for row in rows.iter().filter(|row| row.author == author) {
        let part = &mut counts[usize::from(row.sure < SURE)];
        part[0] += usize::from(row.is_right());
        part[1] += 1;
    }
    counts
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The scripts of the repository's own author.
    #[test]
    fn touches_of_our_own_hand_mean_what_the_rules_say() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("touches/own");
        let author = Author::read(&folder).unwrap();
        let rows = table(std::slice::from_ref(&author), None, None).unwrap();
        let wrong: Vec<String> = rows.iter().filter(|row| !row.is_right()).map(Row::line).collect();
        wrong.iter().for_each(|line| println!("{line}"));
        assert!(20 * wrong.len() <= rows.len(), "{} of {}", wrong.len(), rows.len());
        assert_eq!(counts(&rows, 0)[0][1], author.scripts.len());
        assert!(Author::read(&folder.join("none")).is_err());
    }
}
