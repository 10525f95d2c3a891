//! `taxel fcm`: runs a fuzzy cognitive map in f64 and in the arithmetic of the board, side by side.

pub mod decimal;
pub mod engine;
pub mod file;

use anyhow::{Result, bail};
use decimal::Decimal;
use engine::{Problem, Settings, Trajectory};
use serde_json::{Value, json};
use std::path::PathBuf;
use taxel_core::intent::{Outcome, Rule, Transfer};

/// Arguments of `taxel fcm`.
#[derive(Debug, Clone, clap::Args)]
pub struct FcmArgs {
    /// JSON file with the keys names (concepts), W (row i, column j is the edge i -> j) and x0 (the first state)
    pub map: PathBuf,
    /// What is summed: kosko, mkosko or rescaled
    #[arg(long, default_value = "kosko", value_parser = rule)]
    pub rule: Rule,
    /// What the sum becomes: bivalent, trivalent, sigmoid or tanh
    #[arg(long, default_value = "tanh", value_parser = transfer)]
    pub transfer: Transfer,
    /// Steepness of sigmoid and tanh
    #[arg(long, default_value = "1", value_parser = lambda, allow_negative_numbers = true)]
    pub lambda: f64,
    /// Level that every sum is measured from, -1 ..= 1
    #[arg(long, default_value = "0", value_parser = threshold, allow_negative_numbers = true)]
    pub threshold: Decimal,
    /// Let concepts without an incoming edge follow the rule, instead of keeping their value
    #[arg(long)]
    pub free: bool,
    /// Steps to run; the trajectory has one state more
    #[arg(long, default_value_t = 100, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub steps: u32,
    /// Print JSON instead of a table
    #[arg(long)]
    pub json: bool,
}

fn rule(text: &str) -> Result<Rule, String> {
    match text {
        "kosko" => Ok(Rule::Kosko),
        "mkosko" | "mKosko" => Ok(Rule::Mkosko),
        "rescaled" => Ok(Rule::Rescaled),
        _ => Err("expected kosko, mkosko or rescaled".into()),
    }
}

fn transfer(text: &str) -> Result<Transfer, String> {
    match text {
        "bivalent" => Ok(Transfer::Bivalent),
        "trivalent" => Ok(Transfer::Trivalent),
        "sigmoid" => Ok(Transfer::Sigmoid),
        "tanh" => Ok(Transfer::Tanh),
        _ => Err("expected bivalent, trivalent, sigmoid or tanh".into()),
    }
}

fn lambda(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "expected a number".to_string())?;
    if (0.001..=65.535).contains(&value) { Ok(value) } else { Err("expected 0.001 ..= 65.535".into()) }
}

fn threshold(text: &str) -> Result<Decimal, String> {
    Decimal::parse(text).filter(|t| t.is_fraction()).ok_or_else(|| "expected a number in -1 ..= 1".into())
}

/// Runs the command.
pub fn run(args: FcmArgs) -> Result<()> {
    let problem = file::read_json(&args.map)?;
    let FcmArgs { rule, transfer, lambda, threshold, .. } = args;
    let settings = Settings { rule, transfer, lambda, threshold, held: !args.free };
    let steps = args.steps as usize;
    // Both trajectories are kept in memory until they are printed.
    if steps.saturating_mul(problem.names.len()) > 20_000_000 {
        bail!("--steps {steps} with {} concepts is more than 20 million values", problem.names.len());
    }
    let float = engine::run(&problem, &settings, steps);
    // A map that the core refuses (too large, too steep) still has its f64 answer.
    let fixed = engine::q15(&problem, &settings, steps);
    if args.json {
        println!("{}", report(&float, &fixed));
    } else {
        print!("{}", table(&problem, &float, &fixed));
    }
    Ok(())
}

/// `{"f64": ..., "q15": ...}`; `q15` is null where the core refuses the map, and `q15_error` then says why.
pub fn report(float: &Trajectory, fixed: &Result<Trajectory>) -> Value {
    match fixed {
        Ok(fixed) => json!({ "f64": trajectory(float), "q15": trajectory(fixed) }),
        Err(error) => json!({ "f64": trajectory(float), "q15": null, "q15_error": error.to_string() }),
    }
}

fn trajectory(t: &Trajectory) -> Value {
    let (outcome, period) = match t.outcome {
        Outcome::Fixed => ("fixed", 1),
        Outcome::Cycle(period) => ("cycle", period),
        Outcome::Unsettled => ("unsettled", 0),
    };
    json!({ "trajectory": t.states, "final": t.last(), "steps": t.steps, "outcome": outcome, "period": period })
}

/// A line of words on how it ended.
fn ending(t: &Trajectory) -> String {
    match t.outcome {
        Outcome::Fixed => format!("fixed after {} steps", t.steps),
        Outcome::Cycle(period) => format!("cycle of period {period}, seen after {} steps", t.steps),
        Outcome::Unsettled => format!("not settled in {} steps", t.steps),
    }
}

/// The readable form: one line for each concept.
pub fn table(problem: &Problem, float: &Trajectory, fixed: &Result<Trajectory>) -> String {
    use std::fmt::Write as _;
    let width = problem.names.iter().map(|n| n.chars().count()).max().unwrap_or(0).max(7);
    let mut text = format!("{:width$} {:>9} {:>12} {:>12}\n", "concept", "start", "f64", "q15");
    for (at, concept) in problem.names.iter().enumerate() {
        let q15 = fixed.as_ref().map_or("-".into(), |t| format!("{:.6}", t.last()[at]));
        let start = problem.start[at].to_f64();
        let _ = writeln!(text, "{concept:width$} {start:>9.4} {:>12.6} {q15:>12}", float.last()[at]);
    }
    let _ = writeln!(text, "f64: {}", ending(float));
    let _ = match fixed {
        Ok(fixed) => writeln!(text, "q15: {}", ending(fixed)),
        Err(error) => writeln!(text, "q15: not run: {error}"),
    };
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(clap::Parser)]
    struct Cli {
        #[command(flatten)]
        fcm: FcmArgs,
    }

    fn args(line: &str) -> Result<FcmArgs, clap::Error> {
        Cli::try_parse_from(["fcm", "map.json"].into_iter().chain(line.split_whitespace())).map(|cli| cli.fcm)
    }

    #[test]
    fn arguments_are_read_and_checked() {
        let read =
            args("--rule mKosko --transfer bivalent --lambda 2.5 --threshold -0.3 --free --steps 7").unwrap();
        assert_eq!((read.rule, read.transfer, read.lambda), (Rule::Mkosko, Transfer::Bivalent, 2.5));
        assert_eq!((read.threshold.to_string().as_str(), read.free, read.steps), ("-0.3", true, 7));
        for line in [
            "--lambda 0",
            "--lambda NaN",
            "--lambda -1",
            "--threshold 1.1",
            "--threshold NaN",
            "--steps 0",
            "--rule x",
        ] {
            assert!(args(line).is_err(), "{line}");
        }
    }

    #[test]
    fn the_report_has_both_engines() {
        let problem =
            file::parse_json(r#"{"names":["a","b"],"W":[[0,0.5],[0,0]],"x0":[1,0],"other":1}"#).unwrap();
        let settings = Settings {
            rule: Rule::Kosko,
            transfer: Transfer::Bivalent,
            lambda: 1.0,
            threshold: Decimal::default(),
            held: true,
        };
        let (float, fixed) = (engine::run(&problem, &settings, 3), engine::q15(&problem, &settings, 3));
        let states = json!([[1.0, 0.0], [1.0, 1.0], [1.0, 1.0], [1.0, 1.0]]);
        let one =
            json!({ "trajectory": states, "final": [1.0, 1.0], "steps": 2, "outcome": "fixed", "period": 1 });
        assert_eq!(report(&float, &fixed), json!({ "f64": one, "q15": one }));
        assert!(table(&problem, &float, &fixed).contains("fixed after 2 steps"));
    }

    #[test]
    fn the_shipped_map_survives_its_readable_form() {
        let map = taxel_core::intent::tactile();
        let text = toml::to_string(&file::MapFile::from_config(&map)).unwrap();
        let back: file::MapFile = toml::from_str(&text).unwrap();
        assert_eq!(back.to_config().unwrap(), map);
        let broken = |from: &str, to: &str| {
            let file: file::MapFile = toml::from_str(&text.replacen(from, to, 1)).unwrap();
            file.to_config::<16, 64>().unwrap_err().to_string()
        };
        assert_eq!(broken("weight = -0.9", "weight = 2.0"), "W[press][kindness] = 2 is outside [-1, 1]");
        assert_eq!(
            broken("to = \"kindness\"", "to = \"joy\""),
            "map tactile: an edge names the unknown concept joy"
        );
        assert!(toml::from_str::<file::MapFile>(&text.replacen("lambda", "lamda", 1)).is_err());
    }
}
