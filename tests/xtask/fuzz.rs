//! `cargo xtask fuzz`: runs each target of `fuzz/` for some minutes, with AddressSanitizer. The grown corpus
//! stays in the target folder; a defect becomes an input of the corpus, which `cargo test` replays.

use crate::{install, paths, process};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Default minutes per target.
const MINUTES: f64 = 10.0;
/// Most seconds for one input; more is a defect.
const PATIENCE: u32 = 10;

/// Options of the command line.
struct Asked {
    minutes: f64,
    targets: Vec<String>,
}

impl Asked {
    fn read(args: &[String]) -> Result<Asked, String> {
        let known = targets()?;
        let mut asked = Asked { minutes: MINUTES, targets: Vec::new() };
        let mut args = args.iter();
        while let Some(arg) = args.next() {
            match arg.as_str() {
                "--minutes" => {
                    let minutes = args.next().and_then(|minutes| minutes.parse().ok());
                    let minutes = minutes.filter(|minutes| (0.01..1e6).contains(minutes));
                    asked.minutes = minutes.ok_or("--minutes takes a number above 0")?;
                }
                name if known.iter().any(|target| target == name) => asked.targets.push(name.into()),
                name => return Err(format!("there is no target {name}; there are {}", known.join(", "))),
            }
        }
        if asked.targets.is_empty() {
            asked.targets = known;
        }
        Ok(asked)
    }
}

/// Names of the targets.
fn targets() -> Result<Vec<String>, String> {
    let folder = paths::fuzz().join("targets/src");
    let entries = std::fs::read_dir(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let names = entries.flatten().filter_map(|entry| entry.path().file_stem()?.to_str().map(String::from));
    let mut names: Vec<String> = names.collect();
    names.sort();
    Ok(names)
}

/// Runs the selected targets. Returns true if nothing was found.
pub fn run(args: &[String]) -> Result<bool, String> {
    let asked = Asked::read(args)?;
    install::nightly()?;
    let tool = install::cargo_tool("cargo-fuzz", "0.13.2").map_err(|why| format!("not run: {why}"))?;
    let mut found = 0;
    for target in &asked.targets {
        found += u32::from(!one(&tool, target, asked.minutes)?);
    }
    println!("{} targets, {found} with a finding", asked.targets.len());
    Ok(found == 0)
}

/// Runs one target. Returns true if nothing was found.
fn one(tool: &Path, target: &str, minutes: f64) -> Result<bool, String> {
    let folder = paths::target().join("fuzz");
    let grown = folder.join("corpus").join(target);
    let findings = folder.join("found").join(target);
    for folder in [&grown, &findings] {
        std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    }
    let log = paths::log(&format!("fuzz-{target}"))?;
    let mut command = Command::new("rustup");
    command.args(["run", "nightly"]).arg(tool).args(["fuzz", "run", target, "--fuzz-dir"]);
    command.arg(paths::fuzz().join("targets")).arg("--target-dir").arg(&folder);
    // New inputs go to the first corpus.
    command.arg(&grown).arg(paths::fuzz().join("corpus").join(target)).arg("--");
    command.arg(format!("-max_total_time={}", (minutes * 60.0).ceil()));
    command.arg(format!("-timeout={PATIENCE}")).arg("-print_final_stats=1");
    command.arg(format!("-artifact_prefix={}/", findings.display()));
    // These variables of the running cargo are for another compiler.
    command.env_remove("CARGO").env_remove("RUSTUP_TOOLCHAIN").current_dir(paths::root());
    let end = process::run_into(&mut command, &log);
    let said = std::fs::read_to_string(&log).unwrap_or_default();
    match (end, unit(&said)) {
        (Ok(()), _) => {
            println!("{target}: no finding in {minutes} min, {} executions", executions(&said));
            Ok(true)
        }
        (Err(_), Some(input)) => {
            println!("{target}: FOUND {}\n{}", input.display(), crate::excerpt::excerpt(&said));
            let (name, corpus) = (input.display(), format!("fuzz/corpus/{target}"));
            println!("to replay: cp {name} {corpus}/ && cargo test -p taxel-fuzz --test replay {target}");
            Ok(false)
        }
        (Err(why), None) => Err(format!("not run: {why}: see {}", log.display())),
    }
}

/// Path of the input with a finding.
fn unit(said: &str) -> Option<PathBuf> {
    let line = said.lines().rev().find_map(|line| line.split_once("Test unit written to "));
    line.map(|(_, path)| path.trim().into())
}

/// Number of executed inputs.
fn executions(said: &str) -> &str {
    let line = said.lines().rev().find_map(|line| line.strip_prefix("stat::number_of_executed_units:"));
    line.map_or("?", str::trim)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_the_fuzzer_says_is_read() {
        let said = "#9 pulse\nartifact_prefix='x/'; Test unit written to x/crash-1\nBase64: AA==\n";
        assert_eq!(unit(said), Some(PathBuf::from("x/crash-1")));
        assert_eq!(unit("#9 DONE"), None);
        assert_eq!(executions("stat::number_of_executed_units: 4711\nstat::new_units_added: 3\n"), "4711");
    }

    #[test]
    fn targets_are_chosen_by_name() {
        let read = |args: &[&str]| Asked::read(&args.iter().map(|arg| arg.to_string()).collect::<Vec<_>>());
        let asked = read(&["--minutes", "0.5", "board"]).unwrap();
        assert_eq!((asked.minutes, asked.targets), (0.5, vec!["board".to_string()]));
        assert_eq!(read(&[]).unwrap().targets.len(), targets().unwrap().len());
        assert!(read(&["--minutes", "0"]).is_err() && read(&["--minutes"]).is_err());
        assert!(read(&["boards"]).err().unwrap().starts_with("there is no target boards; there are arrays,"));
    }
}
