//! Runs the tests of a part with each of its mutants: of those built together, and of the rest one by one.

use super::list::{self, Mutant};
use super::parts::{PARTS, Part};
use super::switched::{self, Built, End};
use super::table::Ended;
use crate::{paths, process};
use std::path::Path;
use std::process::Command;
use std::time::Duration;

/// cargo-mutants on one part of the sources in a folder.
fn mutants(tool: &Path, part: &Part, folder: &Path) -> Command {
    let mut command = Command::new(tool);
    command.args(["mutants", "--no-config", "--colors", "never", "--dir"]).arg(folder);
    command.args(["--package", part.package]);
    part.folders.iter().for_each(|folder| _ = command.arg("--file").arg(format!("{folder}/**")));
    quick(&mut command);
    command
}

/// Build products are reused for the next mutant and the next run: only changes are compiled, and quickly.
fn quick(command: &mut Command) {
    command.env("CARGO_TARGET_DIR", paths::target().join("mutants/build")).env("CARGO_INCREMENTAL", "1");
    command.env("CARGO_PROFILE_DEV_OPT_LEVEL", "1").env("CARGO_PROFILE_DEV_DEBUG", "0");
}

/// All mutants of a part.
pub fn listed(tool: &Path, part: &Part) -> Result<Vec<Mutant>, String> {
    let mut command = mutants(tool, part, &paths::root());
    let json = process::output(command.args(["--list", "--json"]));
    let json = json.ok_or(format!("`{}` failed", process::shown(&command)))?;
    Ok(list::read(&json))
}

/// Tests the mutants chosen of each part; `thorough`: with the long tests too.
pub fn tested(tool: &Path, chosen: &[Vec<Mutant>], thorough: bool) -> Result<Vec<Ended>, String> {
    let log = paths::log("mutants")?;
    let all = chosen.concat();
    println!("{} changes are built ...", all.len());
    let mut cargo = Command::new("cargo");
    cargo.args(["test", "--lib"]);
    PARTS.iter().for_each(|part| _ = cargo.args(["--package", part.package, "--test", part.target]));
    quick(&mut cargo);
    let built = switched::build(&all, cargo, &log)?;
    let (mut ends, mut first) = (Vec::new(), 0);
    for (part, mutants) in PARTS.iter().zip(chosen) {
        println!("{}: {} changes ...", part.name, mutants.len());
        let numbers = first..first + mutants.len();
        let (unviable, numbers): (Vec<_>, Vec<_>) =
            numbers.partition(|number| built.unviable.contains(number));
        let numbers: Vec<_> = numbers.into_iter().filter(|number| !built.left.contains(number)).collect();
        let mut ended = together(&built, part, &all, &numbers, thorough)?;
        ended.unviable += unviable.len();
        ends.push(ended);
        first += mutants.len();
    }
    switched::copy(&switched::tree())?;
    let mut first = 0;
    for ((part, mutants), ended) in PARTS.iter().zip(chosen).zip(&mut ends) {
        let left = (first..).zip(mutants).filter(|(number, _)| built.left.contains(number));
        let left: Vec<&str> = left.map(|(_, mutant)| mutant.name.as_str()).collect();
        ended.add(one_by_one(tool, part, &left, thorough)?);
        first += mutants.len();
    }
    Ok(ends)
}

/// Runs the tests of a part with each of these mutants, which are all in the same programs.
fn together(
    built: &Built,
    part: &Part,
    all: &[Mutant],
    numbers: &[usize],
    thorough: bool,
) -> Result<Ended, String> {
    let mut ended = Ended::default();
    let folder = part.folders[0].split("/src").next().unwrap_or_default();
    let folder = paths::target().join("mutants/tree").join(folder);
    let long = if thorough { &[] } else { part.long };
    let args: Vec<&str> =
        part.tests.iter().copied().chain(long.iter().flat_map(|long| ["--skip", *long])).collect();
    let programs = [part.package.replace('-', "_"), part.target.to_string()];
    let mut usual = Vec::new();
    for program in &programs {
        let (end, time) =
            switched::run(built.program(program)?, &folder, &args, None, Duration::from_secs(1200))?;
        if end != End::Passed {
            return Err(format!("the tests of {program} fail without a change"));
        }
        usual.push(5 * time);
    }
    for &number in numbers {
        let mut end = End::Passed;
        for (program, longest) in programs.iter().zip(&usual) {
            if end == End::Passed {
                end = switched::run(built.program(program)?, &folder, &args, Some(number), *longest)?.0;
            }
        }
        match end {
            End::Failed => ended.caught += 1,
            End::Endless => ended.timeout += 1,
            End::Passed => ended.missed.push(all[number].name.clone()),
        }
        println!("  {end:?} {}", all[number].name);
    }
    Ok(ended)
}

/// Tests mutants that are not in the programs of [`together`] with cargo-mutants, which builds each.
fn one_by_one(tool: &Path, part: &Part, names: &[&str], thorough: bool) -> Result<Ended, String> {
    if names.is_empty() {
        return Ok(Ended::default());
    }
    println!("{}: {} of them one by one ...", part.name, names.len());
    let output = paths::target().join("mutants").join(part.name);
    let _ = std::fs::remove_dir_all(&output);
    std::fs::create_dir_all(&output).map_err(|error| format!("{}: {error}", output.display()))?;
    let log = paths::log(&format!("mutants-{}", part.name))?;
    let mut command = mutants(tool, part, &switched::tree());
    // The same tests have passed without a change.
    command.arg("--output").arg(&output).args(["--no-times", "--in-place", "--baseline", "skip"]);
    command.args(["--timeout", "120"]);
    names.iter().for_each(|name| _ = command.arg("--re").arg(format!("^{}$", escaped(name))));
    command.args(["--", "--lib", "--test", part.target, "--"]).args(part.tests);
    let long = if thorough { &[] } else { part.long };
    long.iter().for_each(|long| _ = command.arg("--skip").arg(long));
    // It also fails if a mutant is missed; only its lists matter.
    let end = process::run_into(&mut command, &log);
    let read = |end: &str| -> Vec<String> {
        let text = std::fs::read_to_string(output.join(format!("mutants.out/{end}.txt")));
        text.unwrap_or_default().lines().map(String::from).collect()
    };
    let [caught, timeout, unviable] = ["caught", "timeout", "unviable"].map(|end| read(end).len());
    let ended = Ended { caught, timeout, unviable, missed: read("missed") };
    match (ended.count(), end) {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_matches_itself_alone() {
        assert_eq!(
            escaped("a.rs:1: f -> Option<u8> with Some(0)"),
            r"a\.rs:1: f -> Option<u8> with Some\(0\)"
        );
    }
}
