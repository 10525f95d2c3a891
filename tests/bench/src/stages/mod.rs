//! `cargo xtask bench stages`: cost on this machine and error of each stage and variant. The emulated board runs
//! the same steps (`cargo xtask cycles`).

pub mod case;
pub mod error;
pub mod format;
pub mod row;
pub mod table;
pub mod twin;

use super::Report;
use anyhow::Result;
use case::{Case, Step};
use format::Form;
use row::{Cost, Row};
use std::path::PathBuf;
use table::Table;
use twin::{StepResult, Twin};

/// Repetitions of each measurement; the least disturbed counts.
const ROUNDS: usize = 5;

/// The table of this machine. It includes recorded frames if TAXEL_DATA names their folder.
pub fn report() -> Result<Report> {
    let mut cases = Case::simulated();
    match std::env::var_os("TAXEL_DATA").map(PathBuf::from) {
        Some(data) => cases.push(Case::recorded(&data)?),
        None => eprintln!("recorded frames are left out: TAXEL_DATA names no folder"),
    }
    let mut rows = Vec::new();
    for case in &cases {
        let steps = case.steps()?;
        let (costs, results) = measure(&steps);
        rows.push(Row::of(case, &steps, &costs, &results));
    }
    let forms = Form::all().into_iter().map(|form| form.row(&measure(&form.steps()).0)).collect();
    let table = Table { place: "this machine".into(), unit: "ns", rows, forms };
    Ok(Report { text: table.to_string(), json: table.json(), chart: table.chart() })
}

/// Least cost of each step, and its result.
fn measure(steps: &[Step]) -> (Vec<Cost>, Vec<StepResult>) {
    let round = || {
        let mut twin = Twin::default();
        steps.iter().map(|step| twin.perform(step)).collect::<Vec<StepResult>>()
    };
    let results = round();
    let mut least: Vec<_> = results.iter().map(|results| results.spent).collect();
    for _ in 1..ROUNDS {
        for (least, results) in least.iter_mut().zip(round()) {
            if results.spent.iter().sum::<u64>() < least.iter().sum() {
                *least = results.spent;
            }
        }
    }
    (least.into_iter().map(|stages| Cost { stages, stack: None }).collect(), results)
}
