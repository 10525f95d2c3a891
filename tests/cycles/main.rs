//! What the whole chain costs on the emulated board, beside its error; the same messages must come from the board and from
//! this machine. `cargo xtask cycles` shows or writes the table, `cargo xtask test --only cycles` compares it.

mod board;
mod row;
mod table;
mod twin;

use row::Row;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use table::Table;
use taxel::bench::case::{Case, MEASURED};

/// Where recordings lie unless TAXEL_DATA says so.
const DATA: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/data");

/// The tables as they were last written.
const WRITTEN: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/bench");

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
    let table = Table { rows: measure()? };
    let written = Path::new(WRITTEN);
    match args.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [] => print!("{table}"),
        ["--json"] => println!("{}", table.json()),
        ["--write"] => {
            table.write(written)?;
            print!("{table}");
        }
        ["--check"] => {
            table.check_bars()?;
            table.compare(written)?;
            print!("{table}");
        }
        _ => return Err("options: --json, --write or --check".into()),
    }
    Ok(())
}

/// Runs all cases on the board and here; both must say the same.
fn measure() -> Result<Vec<Row>, String> {
    let mut cases = Case::simulated();
    let data = std::env::var_os("TAXEL_DATA").map_or_else(|| PathBuf::from(DATA), PathBuf::from);
    if data.is_dir() {
        cases.push(Case::recorded(&data).map_err(|error| format!("{error:#}"))?);
    } else {
        eprintln!("recorded frames are left out: there is no folder {}", data.display());
    }
    let steps: Vec<_> = cases.iter().map(Case::steps).collect::<Result<_, _>>().map_err(|e| e.to_string())?;
    let mut answers = board::run(&steps.concat())?.into_iter();
    let mut twin = twin::Twin::new();
    let mut rows = Vec::new();
    for (case, steps) in cases.iter().zip(&steps) {
        let answers: Vec<_> = answers.by_ref().take(steps.len()).collect();
        let said: Vec<_> = steps.iter().map(|step| twin.perform(step)).collect();
        if let Some(step) = answers.iter().zip(&said).position(|(board, host)| board.said != host.said) {
            let (name, variant) = (case.name, case.variant.name());
            return Err(format!(
                "{name}, {variant}: step {step}: the board says something else than this machine"
            ));
        }
        let first = steps.len() - MEASURED;
        rows.push(Row::of(case, &answers[first..], &said[first..]));
    }
    Ok(rows)
}
