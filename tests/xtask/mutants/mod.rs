//! `cargo xtask mutants`: mutation tests of the contacts, the wire and the store, at places chosen by a seed,
//! one at a time. A mutant that no test notices shows a gap in the tests, or is equivalent; equivalent ones
//! are explained in the table.

use crate::{install, paths, process};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Default number of mutants.
const COUNT: usize = 200;
/// Title of the table.
const TITLE: &str = "Changes that the tests notice; `cargo xtask mutants --write` writes this.";
/// Title of the list of missed mutants.
const MISSED: &str = "Not noticed, and why:";
/// Beginning of an explanation for an equivalent mutant, which is not counted.
const EQUAL: &str = "changes nothing";
/// Explanation if there is none.
const UNEXPLAINED: &str = "not explained";

/// A part to be mutated, and the tests that should notice.
struct Part {
    name: &'static str,
    folders: &'static [&'static str],
    package: &'static str,
    /// Test target besides the unit tests.
    target: &'static str,
    /// Filters of test names; the other tests take minutes and test other parts.
    tests: &'static [&'static str],
}

const PARTS: [Part; 3] = [
    Part {
        name: "contact",
        folders: &["core/src/segment", "core/src/measure", "core/src/track", "core/src/contact"],
        package: "taxel-core",
        target: "core",
        tests: &[
            "segment::",
            "measure::",
            "track::",
            "contact",
            "hard::",
            "moments",
            "dense",
            "bounds::",
            "tracking::",
            "board",
        ],
    },
    Part {
        name: "wire",
        folders: &["core/src/wire"],
        package: "taxel-core",
        target: "core",
        tests: &["wire", "golden", "board", "exchange"],
    },
    Part {
        name: "store",
        folders: &["firmware/store/src"],
        package: "taxel-store",
        target: "settings",
        tests: &[""],
    },
];

/// Results, as cargo-mutants names the files that list them.
const ENDS: [&str; 4] = ["caught", "missed", "timeout", "unviable"];

/// Names of mutants by result.
type Ended = BTreeMap<&'static str, Vec<String>>;

/// Options of the command line.
#[derive(Debug, PartialEq, Eq)]
struct Asked {
    count: usize,
    seed: u64,
    write: bool,
}

impl Asked {
    fn read(args: &[String]) -> Result<Asked, String> {
        let mut asked = Asked { count: COUNT, seed: 1, write: false };
        let mut args = args.iter();
        while let Some(arg) = args.next() {
            let mut number = || {
                let number = args.next().and_then(|number| number.parse::<u64>().ok());
                number.ok_or(format!("{arg} takes a number"))
            };
            match arg.as_str() {
                "--count" => asked.count = number()? as usize,
                "--seed" => asked.seed = number()?,
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
    let (mut known, mut ends) = (0, Vec::new());
    for (part, share) in PARTS.iter().zip(shares(asked.count)) {
        let mut names = listed(&tool, part)?;
        known += names.len();
        shuffle(&mut names, asked.seed);
        names.truncate(share);
        println!("{}: {} changes ...", part.name, names.len());
        ends.push(tested(&tool, part, &names)?);
    }
    let count: usize = ends.iter().flat_map(Ended::values).map(Vec::len).sum();
    let head = format!("{count} of {known} changes, chosen by seed {}, as many of each part:", asked.seed);
    let before = std::fs::read_to_string(written()).unwrap_or_default();
    let explained = explained(&before);
    let text = format!("{TITLE}\n\n{head}\n{}\n{}", table(&ends, &explained), missed(&ends, &explained));
    print!("{text}");
    if asked.write {
        std::fs::write(written(), text).map_err(|error| format!("{}: {error}", written().display()))?;
    }
    Ok(())
}

/// Equal numbers for each part, so that each is judged; the first ones get the remainder.
fn shares(count: usize) -> [usize; PARTS.len()] {
    std::array::from_fn(|part| (count + PARTS.len() - 1 - part) / PARTS.len())
}

fn written() -> PathBuf {
    paths::root().join("docs/bench/mutants.txt")
}

/// cargo-mutants on one part of the sources.
fn mutants(tool: &Path, part: &Part) -> Command {
    let mut command = Command::new(tool);
    command.args(["mutants", "--no-config", "--colors", "never", "--dir"]).arg(paths::root());
    command.args(["--package", part.package]);
    part.folders.iter().for_each(|folder| _ = command.arg("--file").arg(format!("{folder}/**")));
    // Build products are reused for the next mutant and the next run: only changes are compiled, and quickly.
    command.env("CARGO_TARGET_DIR", paths::target().join("mutants/build")).env("CARGO_INCREMENTAL", "1");
    command.env("CARGO_PROFILE_DEV_OPT_LEVEL", "1").env("CARGO_PROFILE_DEV_DEBUG", "0");
    command
}

/// Names of all mutants of a part.
fn listed(tool: &Path, part: &Part) -> Result<Vec<String>, String> {
    let mut command = mutants(tool, part);
    let names = process::output(command.arg("--list"));
    let names = names.ok_or(format!("`{}` failed", process::shown(&command)))?;
    Ok(names.lines().map(String::from).collect())
}

/// Tests the mutants with these names.
fn tested(tool: &Path, part: &Part, names: &[String]) -> Result<Ended, String> {
    if names.is_empty() {
        return Ok(Ended::new());
    }
    let output = paths::target().join("mutants").join(part.name);
    let _ = std::fs::remove_dir_all(&output);
    std::fs::create_dir_all(&output).map_err(|error| format!("{}: {error}", output.display()))?;
    let log = paths::log(&format!("mutants-{}", part.name))?;
    let mut command = mutants(tool, part);
    command.arg("--output").arg(&output).args(["--no-times", "--timeout-multiplier", "4"]);
    names.iter().for_each(|name| _ = command.arg("--re").arg(format!("^{}$", escaped(name))));
    command.args(["--", "--lib", "--test", part.target, "--"]).args(part.tests);
    // It also fails if a mutant is missed; only its lists matter.
    let end = process::run_into(&mut command, &log);
    let read = |end: &&'static str| {
        let text = std::fs::read_to_string(output.join(format!("mutants.out/{end}.txt"))).ok()?;
        Some((*end, text.lines().map(String::from).collect()))
    };
    let ended: Ended = ENDS.iter().filter_map(read).collect();
    match (ended.values().map(Vec::len).sum::<usize>(), end) {
        (count, _) if count == names.len() => Ok(ended),
        (count, end) => Err(format!(
            "{} of {} changes were tested ({}): see {}",
            count,
            names.len(),
            end.err().unwrap_or_default(),
            log.display()
        )),
    }
}

/// A regular expression that matches exactly this text.
fn escaped(text: &str) -> String {
    let special = |sign: char| !sign.is_alphanumeric() && !" _/:,<>'\"&=-%@;!#~`".contains(sign);
    text.chars().flat_map(|sign| special(sign).then_some('\\').into_iter().chain([sign])).collect()
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

/// Number of noticed mutants by part. A test that does not end counts as noticed; mutants that do not compile
/// and equivalent ones are not counted.
fn table(ends: &[Ended], explained: &BTreeMap<String, String>) -> String {
    let row = |ended: &Ended| {
        let [caught, missed, timeout, unviable] = ENDS.map(|end| ended.get(end).map_or(0, Vec::len));
        let is_equal =
            |name: &&String| explained.get(&lasting(name)).is_some_and(|why| why.starts_with(EQUAL));
        let equal = ended.get("missed").into_iter().flatten().filter(is_equal).count();
        [caught, missed - equal, timeout, equal, unviable]
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
    let names = ends.iter().flat_map(|ended| ended.get("missed").into_iter().flatten());
    let lines = names.map(|name| {
        let why = explained.get(&lasting(name)).map_or(UNEXPLAINED, String::as_str);
        format!("  {name}\n    {why}\n")
    });
    format!("{MISSED}\n{}", lines.collect::<String>())
}

/// Explanations of a table, by the stable names of the mutants.
fn explained(table: &str) -> BTreeMap<String, String> {
    let list = table.split_once(MISSED).map_or("", |(_, list)| list);
    let lines: Vec<&str> = list.lines().skip(1).collect();
    let pair = |pair: &[&str]| Some((lasting(pair.first()?.trim()), pair.get(1)?.trim().to_string()));
    lines.chunks(2).filter_map(pair).collect()
}

/// Name of a mutant without its line and column, which change.
fn lasting(name: &str) -> String {
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
            Ended::from([("caught", vec![name("f -> u8 with 0"); 17]), ("missed", missed)])
        };
        let ends = [Ended::new(), ended(7), Ended::new()];
        let first = missed(&ends, &BTreeMap::new());
        let said = first.replacen(UNEXPLAINED, "what is added is 0", 1);
        let again = missed(&[Ended::new(), ended(8), Ended::new()], &explained(&said));
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
    }

    #[test]
    fn a_seed_chooses_the_same_and_a_name_matches_itself_alone() {
        let chosen = |seed| {
            let mut list: Vec<u32> = (0..100).collect();
            shuffle(&mut list, seed);
            list
        };
        assert_eq!((chosen(1), shares(200), shares(4)), (chosen(1), [67, 67, 66], [2, 1, 1]));
        assert_ne!(chosen(1), chosen(2));
        assert_eq!(
            escaped("a.rs:1: f -> Option<u8> with Some(0)"),
            r"a\.rs:1: f -> Option<u8> with Some\(0\)"
        );
    }

    #[test]
    fn numbers_are_read() {
        let read = |args: &[&str]| Asked::read(&args.iter().map(|arg| arg.to_string()).collect::<Vec<_>>());
        let asked = Asked { count: 40, seed: 7, write: true };
        assert_eq!(read(&["--count", "40", "--seed", "7", "--write"]), Ok(asked));
        assert!(read(&["--count"]).is_err() && read(&["--seeds", "1"]).is_err());
    }
}
