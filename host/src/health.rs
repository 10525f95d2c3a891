//! `taxel health`: the taxels that are ill, and where they are.

use crate::client::{Client, Event};
use crate::live::{self, LiveArgs, Show};
use crate::source::{self, SourceOptions, SourceSpec};
use anyhow::{Context, Result, anyhow};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use taxel_core::garment::{Circuit, Garment, Layout, Pins};
use taxel_core::health::TaxelHealth;

/// Arguments of `taxel health`.
#[derive(Debug, Clone, clap::Args)]
pub struct HealthArgs {
    /// `auto`, `sim[:SCENE]`, `serial:PATH[@BAUD]`, `tcp:HOST:PORT` or `file:FILE`
    #[arg(long, value_name = "SOURCE", default_value = "auto")]
    pub source: SourceSpec,
    /// Images to wait for; all taxels are judged twice in 96 frames. Touch the garment meanwhile to find dead taxels
    #[arg(long, value_name = "N", default_value_t = 200)]
    pub frames: u64,
    /// Take the mean of the first N frames as the baseline [default: as a simulated scene asks, else 0]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(0..=4096))]
    pub tare: Option<u16>,
    /// Print JSON instead of a table
    #[arg(long)]
    pub json: bool,
}

/// Runs the command.
pub fn run(args: HealthArgs) -> Result<()> {
    let options = SourceOptions { frames: Some(args.frames), ..SourceOptions::default() };
    let source = source::open(&args.source, &options)?;
    let live = LiveArgs { frames: Some(args.frames), tare: args.tare, ..LiveArgs::of(args.source) };
    let mut found = Findings::default();
    live::watch(&live, source, &mut found)?;
    let garment = found.garment.context("the board has not said what it wears")?;
    let places = places(&garment, &found.ill)?;
    if args.json {
        println!("{}", report(&places));
    } else {
        print!("{}", table(&garment, &places));
    }
    Ok(())
}

/// Keeps what was told last.
#[derive(Default)]
struct Findings {
    garment: Option<Garment>,
    ill: BTreeMap<u16, TaxelHealth>,
}

impl Show for Findings {
    fn event(&mut self, client: &Client, event: &Event) -> Result<()> {
        match event {
            Event::Hello => self.garment = client.worn().map(|worn| worn.garment.clone()),
            Event::HealthMap { .. } => self.ill = client.ill().clone(),
            Event::Answer { refusal: Some(why), .. } => return Err(anyhow!("the board refuses: {why}")),
            _ => {}
        }
        Ok(())
    }
}

/// Where an ill taxel is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct IllPlace {
    /// Its number.
    pub taxel: u16,
    /// What is wrong.
    pub health: TaxelHealth,
    /// Name of its panel.
    pub panel: String,
    /// Row and column in the panel.
    pub place: (u16, u16),
    /// Index of its block in the garment, and wired row and column there.
    pub wired: Option<(u8, u8, u8)>,
}

/// Finds ill taxels in a garment.
pub fn places(garment: &Garment, ill: &BTreeMap<u16, TaxelHealth>) -> Result<Vec<IllPlace>> {
    let layout = Layout::build(garment, usize::from(u16::MAX), 4095)?;
    let circuit = Circuit::build(garment, &layout, Pins::ANY)?;
    let found = ill.iter().filter_map(|(taxel, health)| {
        let place = layout.place(usize::from(*taxel))?;
        let panel = layout.areas().get(usize::from(place.panel))?;
        Some(IllPlace {
            taxel: *taxel,
            health: *health,
            panel: panel.name.as_str().into(),
            place: (place.row, place.column),
            wired: circuit.wired(usize::from(*taxel)),
        })
    });
    Ok(found.collect())
}

/// `[{"taxel", "health", "panel", "row", "column", "block", "wired_row", "wired_column"}]`
pub fn report(places: &[IllPlace]) -> Value {
    let one = |p: &IllPlace| {
        let (row, column) = p.place;
        let wired = p.wired;
        json!({
            "taxel": p.taxel, "health": p.health.to_string(), "panel": p.panel, "row": row, "column": column,
            "block": wired.map(|w| w.0), "wired_row": wired.map(|w| w.1), "wired_column": wired.map(|w| w.2),
        })
    };
    places.iter().map(one).collect()
}

/// The readable form: a line for each taxel.
pub fn table(garment: &Garment, places: &[IllPlace]) -> String {
    if places.is_empty() {
        return format!("{}: nothing is known against any taxel.\n", garment.name);
    }
    let line = |p: &IllPlace| {
        let (row, column) = p.place;
        let wired = match p.wired {
            Some((block, row, column)) => format!("block {block}, its row {row}, column {column}"),
            None => "no block".into(),
        };
        format!(
            "{:<8} {}, row {row}, column {column} ({wired}; taxel {})\n",
            p.health.to_string(),
            p.panel,
            p.taxel
        )
    };
    places.iter().map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_ill_taxel_is_named_by_panel_and_by_block() {
        let garment = Garment::reference();
        let ill = BTreeMap::from([(512 + 16 * 7 + 5, TaxelHealth::Stuck)]);
        let places = places(&garment, &ill).unwrap();
        let block = garment.blocks.iter().position(|b| b.panel == 1 && b.row == 4).unwrap();
        assert_eq!(
            table(&garment, &places),
            format!("stuck    back, row 7, column 5 (block {block}, its row 3, column 5; taxel 629)\n")
        );
        assert_eq!(report(&places)[0]["wired_row"], 3);
        assert!(table(&garment, &[]).ends_with("nothing is known against any taxel.\n"));
    }
}
