//! What each stage and each variant costs on the emulated board, beside its error; the board must say the
//! same as this machine. `cargo xtask cycles` shows or writes the tables, `cargo xtask test --only cycles`
//! compares them.

mod bars;
mod board;
#[path = "../../host/cli/tests/recorded/data.rs"]
mod data;

use std::path::Path;
use std::process::ExitCode;
use taxel_bench::stages::case::{Case, Step};
use taxel_bench::stages::format::{Form, FormRow};
use taxel_bench::stages::row::{Cost, Row};
use taxel_bench::stages::table::Table;
use taxel_bench::stages::twin::{StepResult, Twin};

/// The tables as they were last written.
const WRITTEN: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/evidence/bench");

/// The variable that lists the folders of recordings.
const DATA: &str = "TAXEL_DATA";

fn main() -> ExitCode {
    match run(&std::env::args().skip(1).collect::<Vec<_>>()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => {
            eprintln!("cycles: {why}");
            ExitCode::FAILURE
        }
    }
}

fn run(args: &[String]) -> Result<(), String> {
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    if args == ["--write"] && std::env::var_os(DATA).is_none() {
        return Err(format!(
            "nothing is written: the table has a row of recorded frames, and {DATA} lists none"
        ));
    }
    let table = measure()?;
    match args[..] {
        [] => print!("{table}\n{}", bars::text(&table)),
        ["--json"] => println!("{}", bars::json(&table)),
        ["--write"] => {
            bars::write(&table, Path::new(WRITTEN))?;
            print!("{table}\n{}", bars::text(&table));
        }
        ["--check"] => {
            print!("{table}\n{}", bars::text(&table));
            bars::compare(&table, Path::new(WRITTEN))?;
        }
        _ => return Err("options: --json, --write or --check".into()),
    }
    Ok(())
}

/// Runs everything on the board and here; both must say the same.
fn measure() -> Result<Table, String> {
    let mut cases = Case::simulated();
    if std::env::var_os(DATA).is_some() {
        let frames = data::find("pmatdata");
        let folder = frames.parent().ok_or("pmatdata lies in no folder")?;
        cases.push(Case::recorded(folder).map_err(|error| format!("{error:#}"))?);
    } else {
        eprintln!("recorded frames are left out: {DATA} lists no folders of recordings");
    }
    let forms = Form::all();
    let steps = cases.iter().map(Case::steps).collect::<Result<Vec<_>, _>>();
    let mut steps = steps.map_err(|error| format!("{error:#}"))?;
    steps.extend(forms.iter().map(Form::steps));
    let costs = together(&steps)?;
    let of_cases = cases.iter().zip(&steps).zip(&costs);
    let rows: Vec<Row> =
        of_cases.map(|((case, steps), (costs, results))| Row::of(case, steps, costs, results)).collect();
    let of_forms = forms.iter().zip(costs.iter().skip(cases.len()));
    let forms: Vec<FormRow> = of_forms.map(|(form, (costs, _))| form.row(costs)).collect();
    let compiler = std::env::var("TAXEL_COMPILER").unwrap_or("an unknown compiler".into());
    Ok(Table {
        place: format!("emulated RP2040 (Cortex-M0+, 125 MHz), {compiler}"),
        unit: "cycles",
        rows,
        forms,
    })
}

/// What a group of steps costs on the board, and what this machine did.
type Group = (Vec<Cost>, Vec<StepResult>);

/// Both by groups of steps.
fn together(groups: &[Vec<Step>]) -> Result<Vec<Group>, String> {
    let mut answers = board::run(&groups.concat())?.into_iter();
    let mut twin = Twin::default();
    let mut done = Vec::new();
    for (number, steps) in groups.iter().enumerate() {
        let answers: Vec<_> = answers.by_ref().take(steps.len()).collect();
        let results: Vec<StepResult> = steps.iter().map(|step| twin.perform(step)).collect();
        if let Some(step) = answers.iter().zip(&results).position(|(board, host)| board.said != host.said) {
            return Err(format!(
                "group {number}, step {step}: the board says something else than this machine"
            ));
        }
        done.push((answers.iter().map(|answer| answer.cost).collect(), results));
    }
    Ok(done)
}
