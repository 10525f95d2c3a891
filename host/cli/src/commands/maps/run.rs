//! `taxel fcm MAP`: runs a fuzzy cognitive map in f64 and in the arithmetic of the board, side by side.

use crate::fault::Fault;
use anyhow::{Result, bail};
use std::path::Path;
use taxel::fcm::decimal::Decimal;
use taxel::fcm::engine::{self, Problem, Settings, Trajectory};
use taxel::fcm::ran::report;
use taxel::fcm::{json, load};
use taxel_core::intent::{Outcome, Rule, Transfer};

/// Arguments of `taxel fcm MAP`.
#[derive(Debug, Clone, clap::Args)]
pub struct RunArgs {
    /// JSON file with the keys names (concepts), W (row i, column j is the edge i -> j) and x0 (the initial
    /// state); or a map in TOML, by file or by the name of a shipped one
    pub map: String,
    /// Activation of a concept at the start, as NAME=VALUE
    #[arg(long, value_parser = load::assignment)]
    pub input: Vec<(String, Decimal)>,
    /// Rule of the sum: kosko, mkosko or rescaled [default: as in the file, else kosko]
    #[arg(long, value_parser = rule)]
    pub rule: Option<Rule>,
    /// Transfer function: bivalent, trivalent, sigmoid, tanh or positive [default: as in the file, else
    /// tanh]
    #[arg(long, value_parser = transfer)]
    pub transfer: Option<Transfer>,
    /// Steepness of sigmoid, tanh and positive [default: as in the file, else 1]
    #[arg(long, value_parser = lambda, allow_negative_numbers = true)]
    pub lambda: Option<f64>,
    /// Threshold subtracted from every sum, -1 ..= 1 [default: as in the file, else 0]
    #[arg(long, value_parser = threshold, allow_negative_numbers = true)]
    pub threshold: Option<Decimal>,
    /// Let concepts without an incoming edge follow the rule, instead of keeping their value
    #[arg(long)]
    pub free: bool,
    /// Number of steps; the trajectory has one state more
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

/// Parses the option of this name.
fn transfer(text: &str) -> Result<Transfer, String> {
    match text {
        "bivalent" => Ok(Transfer::Bivalent),
        "trivalent" => Ok(Transfer::Trivalent),
        "sigmoid" => Ok(Transfer::Sigmoid),
        "tanh" => Ok(Transfer::Tanh),
        "positive" => Ok(Transfer::Positive),
        _ => Err("expected bivalent, trivalent, sigmoid, tanh or positive".into()),
    }
}

/// Parses the option of this name.
fn lambda(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "expected a number".to_string())?;
    if (0.001..=65.535).contains(&value) { Ok(value) } else { Err("expected 0.001 ..= 65.535".into()) }
}

/// Parses the option of this name.
fn threshold(text: &str) -> Result<Decimal, String> {
    Decimal::parse(text).filter(|t| t.is_fraction()).ok_or_else(|| "expected a number in -1 ..= 1".into())
}

/// The map with its initial state, and the settings of the file and the options.
fn problem(args: &RunArgs) -> Result<(Problem, Settings)> {
    let (problem, file) = if args.map.ends_with(".json") {
        let mut problem = json::read(Path::new(&args.map))?;
        for (concept, value) in &args.input {
            let at = problem.names.iter().position(|name| name == concept);
            let unknown =
                || Fault::usage(format!("{}: --input names the unknown concept {concept}", args.map));
            let at = at.ok_or_else(unknown)?;
            problem.start[at] = *value;
        }
        (problem, Settings::default())
    } else {
        load::map(&args.map)?.problem(&args.input)?
    };
    let settings = Settings {
        rule: args.rule.unwrap_or(file.rule),
        transfer: args.transfer.unwrap_or(file.transfer),
        lambda: args.lambda.unwrap_or(file.lambda),
        threshold: args.threshold.unwrap_or(file.threshold),
        held: file.held && !args.free,
    };
    Ok((problem, settings))
}

/// Runs the command.
pub fn run(args: RunArgs) -> Result<()> {
    let (problem, settings) = problem(&args)?;
    let steps = args.steps as usize;
    // Both trajectories are kept in memory until they are printed.
    if steps.saturating_mul(problem.names.len()) > 20_000_000 {
        let concepts = problem.names.len();
        bail!(Fault::usage(format!(
            "--steps {steps} with {concepts} concepts is more than 20 million values"
        )));
    }
    let float = engine::run(&problem, &settings, steps);
    // A map that the core refuses (too large, too steep) still has its f64 result.
    let fixed = engine::q15(&problem, &settings, steps);
    if args.json {
        println!("{}", report(&float, &fixed));
    } else {
        print!("{}", table(&problem, &float, &fixed));
    }
    Ok(())
}

/// Describes the outcome.
fn ending(t: &Trajectory) -> String {
    match t.outcome {
        Outcome::Fixed => format!("fixed after {} steps", t.steps),
        Outcome::Cycle(period) => format!("cycle of period {period}, seen after {} steps", t.steps),
        Outcome::Unsettled => format!("not settled in {} steps", t.steps),
    }
}

/// Readable form: one line for each concept.
pub fn table(problem: &Problem, float: &Trajectory, fixed: &taxel::Result<Trajectory>) -> String {
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
    use serde_json::json;

    #[derive(clap::Parser)]
    struct TestCli {
        #[command(flatten)]
        fcm: RunArgs,
    }

    fn args(line: &str) -> Result<RunArgs, clap::Error> {
        TestCli::try_parse_from(["fcm", "map.json"].into_iter().chain(line.split_whitespace()))
            .map(|cli| cli.fcm)
    }

    #[test]
    fn arguments_are_read_and_checked() {
        let read =
            args("--rule mKosko --transfer bivalent --lambda 2.5 --threshold -0.3 --free --steps 7").unwrap();
        let wanted = (Some(Rule::Mkosko), Some(Transfer::Bivalent), Some(2.5));
        assert_eq!((read.rule, read.transfer, read.lambda), wanted);
        assert_eq!(
            (read.threshold.map(|t| t.to_string()), read.free, read.steps),
            (Some("-0.3".into()), true, 7)
        );
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
        let problem = json::parse(r#"{"names":["a","b"],"W":[[0,0.5],[0,0]],"x0":[1,0],"other":1}"#).unwrap();
        let settings = Settings { transfer: Transfer::Bivalent, ..Settings::default() };
        let (float, fixed) = (engine::run(&problem, &settings, 3), engine::q15(&problem, &settings, 3));
        let states = json!([[1.0, 0.0], [1.0, 1.0], [1.0, 1.0], [1.0, 1.0]]);
        let one =
            json!({ "trajectory": states, "final": [1.0, 1.0], "steps": 2, "outcome": "fixed", "period": 1 });
        assert_eq!(report(&float, &fixed), json!({ "f64": one, "q15": one }));
        assert!(table(&problem, &float, &fixed).contains("fixed after 2 steps"));
    }
}
