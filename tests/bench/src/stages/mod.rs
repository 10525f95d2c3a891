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
use twin::{Told, Twin};

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
        let (costs, told) = measure(&steps);
        rows.push(Row::of(case, &steps, &costs, &told));
    }
    let forms = Form::all().into_iter().map(|form| form.row(&measure(&form.steps()).0)).collect();
    let table = Table { place: "this machine".into(), unit: "ns", rows, forms };
    Ok(Report { text: table.to_string(), json: table.json(), chart: table.chart() })
}

/// Least cost of each step, and its result.
fn measure(steps: &[Step]) -> (Vec<Cost>, Vec<Told>) {
    let round = || {
        let mut twin = Twin::default();
        steps.iter().map(|step| twin.perform(step)).collect::<Vec<Told>>()
    };
    let told = round();
    let mut least: Vec<_> = told.iter().map(|told| told.spent).collect();
    for _ in 1..ROUNDS {
        for (least, told) in least.iter_mut().zip(round()) {
            if told.spent.iter().sum::<u64>() < least.iter().sum() {
                *least = told.spent;
            }
        }
    }
    (least.into_iter().map(|stages| Cost { stages, stack: None }).collect(), told)
}
