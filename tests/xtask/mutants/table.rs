//! The table of results, `docs/evidence/bench/mutants.txt`, and the explanations that are kept in it.

use super::parts::{PARTS, Part};
use std::collections::BTreeMap;

/// Title of the table.
const TITLE: &str = "Changes that the tests notice; `cargo xtask mutants --write` writes this.";
/// Title of the list of missed mutants.
const MISSED: &str = "Not noticed, and why:";
/// Beginning of an explanation for an equivalent mutant, which is not counted.
const EQUAL: &str = "changes nothing";
/// Explanation if there is none.
const UNEXPLAINED: &str = "not explained";

/// End of the heading once missed mutants were tested again.
pub const AGAIN: &str = "; those missed again with new and long tests";

/// Results of one part.
#[derive(Debug, Default, Clone, PartialEq, Eq)]
pub struct Ended {
    pub caught: usize,
    pub timeout: usize,
    pub unviable: usize,
    /// Names of the missed ones, equivalent ones among them.
    pub missed: Vec<String>,
}

impl Ended {
    /// Number of mutants.
    pub fn count(&self) -> usize {
        self.caught + self.timeout + self.unviable + self.missed.len()
    }

    /// Adds the results of others.
    pub fn add(&mut self, more: Ended) {
        self.caught += more.caught;
        self.timeout += more.timeout;
        self.unviable += more.unviable;
        self.missed.extend(more.missed);
    }

    /// The results of a part in a table.
    pub fn read(table: &str, part: &Part) -> Option<Ended> {
        let row = table.lines().find(|line| line.split_whitespace().next() == Some(part.name))?;
        let counts: Vec<usize> = row.split_whitespace().filter_map(|word| word.parse().ok()).collect();
        let &[caught, _, timeout, _, unviable, ..] = &counts[..] else { return None };
        let of_part = |name: &&str| part.folders.iter().any(|folder| name.starts_with(&format!("{folder}/")));
        let missed = pairs(table).map(|(name, _)| name).filter(of_part).map(String::from).collect();
        Some(Ended { caught, timeout, unviable, missed })
    }
}

/// The file's text.
pub fn text(head: &str, ends: &[Ended], before: &str) -> String {
    let explained = explained(before);
    format!("{TITLE}\n\n{head}:\n{}\n{}", table(ends, &explained), missed(ends, &explained))
}

/// True if a missed mutant is explained as equivalent.
pub fn is_equal(name: &str, explained: &BTreeMap<String, String>) -> bool {
    explained.get(&lasting(name)).is_some_and(|why| why.starts_with(EQUAL))
}

/// Number of noticed mutants by part. A test that does not end counts as noticed; mutants that do not compile
/// and equivalent ones are not counted.
fn table(ends: &[Ended], explained: &BTreeMap<String, String>) -> String {
    let row = |ended: &Ended| {
        let equal = ended.missed.iter().filter(|name| is_equal(name, explained)).count();
        [ended.caught, ended.missed.len() - equal, ended.timeout, equal, ended.unviable]
    };
    let mut rows: Vec<(&str, [usize; 5])> =
        PARTS.iter().zip(ends).map(|(part, ended)| (part.name, row(ended))).collect();
    let sum = |of: usize| rows.iter().map(|(_, counts)| counts[of]).sum();
    rows.push(("all", [0, 1, 2, 3, 4].map(sum)));
    let mut text = format!(
        "{:<9}{:>9}{:>9}{:>9}{:>9}{:>10}{:>9}\n",
        "part", "caught", "missed", "timeout", "equal", "unviable", "share"
    );
    for (name, [caught, missed, timeout, equal, unviable]) in rows {
        let noticed = caught + timeout;
        let share =
            (100 * noticed).checked_div(noticed + missed).map_or("-".into(), |share| format!("{share} %"));
        text += &format!("{name:<9}{caught:>9}{missed:>9}{timeout:>9}{equal:>9}{unviable:>10}{share:>9}\n");
    }
    text
}

/// The missed mutants with their explanations.
fn missed(ends: &[Ended], explained: &BTreeMap<String, String>) -> String {
    let names = ends.iter().flat_map(|ended| &ended.missed);
    let lines = names.map(|name| {
        let why = explained.get(&lasting(name)).map_or(UNEXPLAINED, String::as_str);
        format!("  {name}\n    {why}\n")
    });
    format!("{MISSED}\n{}", lines.collect::<String>())
}

/// The missed mutants of a table, and what explains each.
fn pairs(table: &str) -> impl Iterator<Item = (&str, &str)> {
    let list = table.split_once(MISSED).map_or("", |(_, list)| list);
    let mut lines = list.lines().skip(1).map(str::trim);
    std::iter::from_fn(move || Some((lines.next()?, lines.next()?)))
}

/// Explanations of a table, by the stable names of the mutants.
pub fn explained(table: &str) -> BTreeMap<String, String> {
    pairs(table).map(|(name, why)| (lasting(name), why.to_string())).collect()
}

/// Name of a mutant without its line and column, which change.
pub fn lasting(name: &str) -> String {
    let mut parts = name.splitn(4, ':');
    let (file, what) = (parts.next().unwrap_or_default(), parts.nth(2).unwrap_or_default());
    format!("{file}:{what}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_keeps_what_is_known_of_a_change_that_has_moved() {
        let ended = |line: u32| {
            let name = |what: &str| format!("core/src/wire/a.rs:{line}:9: replace {what}");
            let missed = vec![name("+ with - in f"), name("* with / in g")];
            Ended { caught: 17, missed, ..Ended::default() }
        };
        let ends = [Ended::default(), ended(7), Ended::default()];
        let first = missed(&ends, &BTreeMap::new());
        let said = first.replacen(UNEXPLAINED, "what is added is 0", 1);
        let again = missed(&[Ended::default(), ended(8), Ended::default()], &explained(&said));
        let lines: Vec<&str> = again.lines().map(str::trim).collect();
        assert_eq!(lines[1..3], ["core/src/wire/a.rs:8:9: replace + with - in f", "what is added is 0"]);
        assert_eq!(lines[4], UNEXPLAINED);
        let share = |explained: &str| {
            let table = table(&ends, &super::explained(explained));
            let line = table.lines().find(|line| line.starts_with("wire")).expect("a line of each part");
            line.split_whitespace().skip(1).map(String::from).collect::<Vec<_>>()
        };
        assert_eq!(share(&said), ["17", "2", "0", "0", "0", "89", "%"]);
        let said = said.replace("what is added is 0", "changes nothing: what is added is 0");
        assert_eq!(share(&said), ["17", "1", "0", "1", "0", "94", "%"]);
        let text = text("19 of 900 changes", &ends, &said);
        assert_eq!(Ended::read(&text, &PARTS[1]), Some(ends[1].clone()));
        assert_eq!(Ended::read(&text, &PARTS[2]), Some(Ended::default()));
    }
}
