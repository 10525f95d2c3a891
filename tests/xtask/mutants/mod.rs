//! `cargo xtask mutants`: mutation tests of the contacts, the wire and the store, at places chosen by a seed,
//! one at a time. A mutant that no test notices shows a gap in the tests, or is equivalent; equivalent ones
//! are explained in the table. When tests were added, `--missed` tests again what the table lists as missed,
//! with the tests that take long too.

mod list;
mod parts;
mod run;
mod switched;
mod table;

use crate::{install, paths};
use list::Mutant;
use parts::PARTS;
use run::{listed, tested};
use std::path::{Path, PathBuf};
use table::{AGAIN, Ended, explained, is_equal, lasting};

/// Default number of mutants.
const COUNT: usize = 200;
/// Options of the command line.
#[derive(Debug, PartialEq, Eq)]
struct Asked {
    count: usize,
    seed: u64,
    missed: bool,
    write: bool,
}

impl Asked {
    fn read(args: &[String]) -> Result<Asked, String> {
        let mut asked = Asked { count: COUNT, seed: 1, missed: false, write: false };
        let mut args = args.iter();
        while let Some(arg) = args.next() {
            let mut number = || {
                let number = args.next().and_then(|number| number.parse::<u64>().ok());
                number.ok_or(format!("{arg} takes a number"))
            };
            match arg.as_str() {
                "--count" => asked.count = number()? as usize,
                "--seed" => asked.seed = number()?,
                "--missed" => asked.missed = true,
                "--write" => asked.write = true,
                _ => return Err(crate::USAGE.into()),
            }
        }
        Ok(asked)
    }
}

/// Runs the selected mutants.
pub fn run(args: &[String]) -> Result<(), String> {
    let asked = Asked::read(args)?;
    let tool = install::cargo_tool("cargo-mutants", "26.2.0").map_err(|why| format!("not run: {why}"))?;
    let before = std::fs::read_to_string(written()).unwrap_or_default();
    let text = if asked.missed { again(&tool, &before)? } else { sample(&tool, &asked, &before)? };
    print!("{text}");
    if asked.write {
        std::fs::write(written(), text).map_err(|error| format!("{}: {error}", written().display()))?;
    }
    Ok(())
}

/// Tests mutants chosen by a seed. Returns the table.
fn sample(tool: &Path, asked: &Asked, before: &str) -> Result<String, String> {
    let (mut known, mut chosen) = (0, Vec::new());
    for (part, share) in PARTS.iter().zip(shares(asked.count)) {
        let mut mutants = listed(tool, part)?;
        known += mutants.len();
        shuffle(&mut mutants, asked.seed);
        mutants.truncate(share);
        chosen.push(mutants);
    }
    let ends = tested(tool, &chosen, false)?;
    let count: usize = ends.iter().map(Ended::count).sum();
    let head = format!("{count} of {known} changes, chosen by seed {}, as many of each part", asked.seed);
    Ok(table::text(&head, &ends, before))
}

/// Tests again, with the long tests too, what a table lists as missed and does not explain as equivalent.
/// Returns the table with these results.
fn again(tool: &Path, before: &str) -> Result<String, String> {
    let head = before.lines().nth(2).ok_or("there is no table yet")?.trim_end_matches(':');
    let first = head.split(AGAIN).next().unwrap_or_default();
    let (explained, mut ends, mut chosen) = (explained(before), Vec::new(), Vec::new());
    for part in &PARTS {
        let mut ended = Ended::read(before, part).ok_or(format!("the table has no row of {}", part.name))?;
        let now = listed(tool, part)?;
        let missed = std::mem::take(&mut ended.missed);
        let (equal, rest): (Vec<_>, Vec<_>) = missed
            .iter()
            .filter_map(|name| moved(name, &now))
            .partition(|mutant| is_equal(&mutant.name, &explained));
        ended.missed = equal.into_iter().map(|mutant| mutant.name).collect();
        ends.push(ended);
        chosen.push(rest);
    }
    if chosen.iter().all(Vec::is_empty) {
        return Ok(table::text(head, &ends, before));
    }
    for (ended, more) in ends.iter_mut().zip(tested(tool, &chosen, true)?) {
        ended.add(more);
    }
    Ok(table::text(&format!("{first}{AGAIN}"), &ends, before))
}

/// The name that a mutant has now: the nearest place in its file where the same is changed in the same
/// function.
fn moved(name: &str, now: &[Mutant]) -> Option<Mutant> {
    let place = |name: &str| name.split(':').nth(1).and_then(|line| line.parse::<i64>().ok()).unwrap_or(0);
    let alike = now.iter().filter(|other| lasting(&other.name) == lasting(name));
    let nearest = alike.min_by_key(|other| (other.name != name, (place(&other.name) - place(name)).abs()));
    if nearest.is_none() {
        println!("no longer there: {name}");
    }
    nearest.cloned()
}

/// Equal numbers for each part, so that each is judged; the first ones get the remainder.
fn shares(count: usize) -> [usize; PARTS.len()] {
    std::array::from_fn(|part| (count + PARTS.len() - 1 - part) / PARTS.len())
}

fn written() -> PathBuf {
    paths::root().join("docs/evidence/bench/mutants.txt")
}

/// Fisher-Yates shuffle with splitmix64.
fn shuffle<T>(list: &mut [T], seed: u64) {
    let mut state = seed;
    for end in (1..list.len()).rev() {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut number = state;
        number = (number ^ number >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        number = (number ^ number >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        list.swap(end, ((number ^ number >> 31) % (end as u64 + 1)) as usize);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_change_that_has_moved_is_the_nearest_one_that_is_alike() {
        let now = [3, 40, 90].map(|line| Mutant {
            name: format!("core/src/wire/a.rs:{line}:9: replace + with - in f"),
            ..Mutant::default()
        });
        let found = |name: &str| moved(name, &now);
        assert_eq!(found(&now[1].name), Some(now[1].clone()));
        assert_eq!(found("core/src/wire/a.rs:70:12: replace + with - in f"), Some(now[2].clone()));
        assert_eq!(found("core/src/wire/a.rs:40:9: replace + with - in g"), None);
    }

    #[test]
    fn a_seed_chooses_the_same() {
        let chosen = |seed| {
            let mut list: Vec<u32> = (0..100).collect();
            shuffle(&mut list, seed);
            list
        };
        assert_eq!((chosen(1), shares(200), shares(4)), (chosen(1), [67, 67, 66], [2, 1, 1]));
        assert_ne!(chosen(1), chosen(2));
    }

    #[test]
    fn numbers_are_read() {
        let read = |args: &[&str]| Asked::read(&args.iter().map(|arg| arg.to_string()).collect::<Vec<_>>());
        let asked = Asked { count: 40, seed: 7, missed: false, write: true };
        assert_eq!(read(&["--count", "40", "--seed", "7", "--write"]), Ok(asked));
        let asked = Asked { count: COUNT, seed: 1, missed: true, write: false };
        assert_eq!(read(&["--missed"]), Ok(asked));
        assert!(read(&["--count"]).is_err() && read(&["--seeds", "1"]).is_err());
    }
}
