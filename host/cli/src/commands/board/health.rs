//! `taxel health`: the faulty taxels and where they are, and faulty lines and inputs.

mod ghosts;

pub use ghosts::candidates;
use taxel::json::pins;

use crate::fault::{Blame, Fault};
use crate::watch::{self, BoardArgs, WatchOptions};
use anyhow::{Context, Result, bail, ensure};
use ghosts::Ghosts;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use taxel::client::{BoardDescription, Client, Event, Stamp};
use taxel::files::garments;
use taxel::robot::BoardConfig;
use taxel::session::Observer;
use taxel::source::{self, SourceOptions, SourceSpec};
use taxel_core::garment::{Circuit, Garment, Layout, Pins};
use taxel_core::health::TaxelHealth;
use taxel_core::selftest::Findings;
use taxel_core::wire::Request;

/// Shown below the help.
const EXAMPLES: &str = "Examples:
  taxel health
  taxel health --source sim:press
  taxel health --source serial:/dev/ttyACM0 --tare 32 --json";

/// List faulty taxels, lines and inputs
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct HealthArgs {
    /// `auto`, `usb[:SERIAL]`, `sim[:TOUCHES]`, `serial:PATH[@BAUD]`, `tcp:HOST:PORT`, `zenoh:ROBOT/BOARD` or
    /// `replay:FILE`
    #[arg(long, value_name = "SOURCE", default_value = "auto")]
    pub source: SourceSpec,
    /// Images to wait for; each of 2,048 taxels is judged once in 90 frames. Touch the garment meanwhile to
    /// find dead taxels
    #[arg(long, value_name = "N", default_value_t = 200)]
    pub frames: u64,
    /// Take the mean of the first N frames as the baseline [default: that of a simulated scene, else 0]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(0..=4096))]
    pub tare: Option<u16>,
    /// Run the self-test of select lines and inputs, and judge every taxel anew [default: report the board's
    /// last self-test]
    #[arg(long)]
    pub self_test: bool,
    /// Whether the blocks are passive matrices: if so, contacts that three others may have made are reported
    /// as ghosts [default: true for the preset `block-4x16`]
    #[arg(long, value_name = "BOOL", num_args = 0..=1, default_missing_value = "true")]
    pub passive: Option<bool>,
    /// Print JSON instead of a table
    #[arg(long)]
    pub json: bool,
}

/// Health of a board, in both forms that the command prints.
#[derive(Debug)]
pub struct HealthText {
    /// `{"simulated", "self_test", "taxels", "ghosts"}`; ghosts are null unless the blocks are passive matrices.
    pub json: Value,
    /// A line for each finding.
    pub text: String,
    /// Number of faulty lines and inputs.
    pub faults: usize,
    /// Number of faulty taxels.
    pub taxels: usize,
}

/// Runs the command. Blames the board for a faulty line, input or taxel.
pub fn run(args: HealthArgs) -> Result<()> {
    let reported = look(&args)?;
    if args.json {
        println!("{}", reported.json);
    } else {
        print!("{}", reported.text);
    }
    ensure!(reported.faults == 0, Fault::board(format!("faults of lines and inputs: {}", reported.faults)));
    ensure!(reported.taxels == 0, Fault::board(format!("faulty taxels: {}", reported.taxels)));
    Ok(())
}

/// Watches a board for the time that the arguments give.
pub fn look(args: &HealthArgs) -> Result<HealthText> {
    let options = SourceOptions { frames: Some(args.frames), ..SourceOptions::default() };
    let source = source::open(&args.source, &options)?;
    let config = BoardConfig { tare: args.tare, ..BoardConfig::of(args.source.clone()) };
    let asked = BoardArgs { config, ..BoardArgs::default() };
    let live = WatchOptions { frames: Some(args.frames), ..WatchOptions::on(asked) };
    let mut found = Known { wanted: args.self_test, passive: args.passive, ..Known::default() };
    watch::watch(&live, source, &mut found)?;
    if args.self_test && !found.answered {
        bail!(Fault::board("no self-test was received; try more --frames"));
    }
    let passive = found.is_passive();
    let garment = found.garment.context("the board has not sent its garment").board()?;
    let places = places(&garment, &found.faulty)?;
    let (pins, simulated) = (found.pins.as_ref(), found.simulated);
    let simulation = if simulated { "This is a simulated board.\n" } else { "" };
    let ghosts = passive.then(|| found.ghosts.report(&garment));
    Ok(HealthText {
        json: json!({
            "simulated": simulated, "self_test": pins::report(&garment, pins), "taxels": report(&places), "ghosts": ghosts,
        }),
        text: simulation.to_string()
            + &pins::table(&garment, pins)
            + &table(&garment, &places)
            + &found.ghosts.table(&garment),
        faults: pins.map_or(0, |findings| findings.faults.len()),
        taxels: places.len(),
    })
}

/// The latest health reports.
#[derive(Default)]
struct Known {
    garment: Option<Garment>,
    simulated: bool,
    faulty: BTreeMap<u16, TaxelHealth>,
    pins: Option<Findings>,
    /// A self-test is still to be requested.
    wanted: bool,
    answered: bool,
    /// Passive matrices by the command line; none: by the garment.
    passive: Option<bool>,
    ghosts: Ghosts,
}

impl Known {
    fn is_passive(&self) -> bool {
        self.passive.unwrap_or_else(|| self.garment.as_ref().is_some_and(garments::is_passive))
    }
}

impl Observer for Known {
    fn event(&mut self, client: &Client, event: &Event, _: Stamp) -> taxel::Result<()> {
        match event {
            Event::Hello => {
                self.garment = client.description().map(|description| description.garment.clone());
                self.simulated = client.description().is_some_and(BoardDescription::is_simulated);
            }
            Event::HealthMap { .. } => self.faulty = client.faulty().clone(),
            Event::Contacts { .. } if self.is_passive() => {
                if let Some(garment) = &self.garment {
                    self.ghosts.take(garment, client.contacts());
                }
            }
            Event::SelfTest(report) => self.pins = Some(report.findings.clone()),
            Event::Answer { request, refusal: None } if *request == Request::SelfTest.number() => {
                self.answered = true;
            }
            Event::Answer { refusal: Some(why), .. } => {
                return Err(Fault::board(format!("the board refuses: {why}")).into());
            }
            _ => {}
        }
        Ok(())
    }

    fn idle(&mut self, client: &mut Client) -> taxel::Result<()> {
        if std::mem::take(&mut self.wanted) {
            client.request(&Request::SelfTest)?;
        }
        Ok(())
    }
}

/// Place of a faulty taxel.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FaultyPlace {
    /// Number of the taxel.
    pub taxel: u16,
    /// Fault of the taxel.
    pub health: TaxelHealth,
    /// Name of the panel.
    pub panel: String,
    /// Row and column in the panel.
    pub place: (u16, u16),
    /// Index of the block in the garment, and the wired row and column in it.
    pub wired: Option<(u8, u8, u8)>,
}

/// Finds the places of faulty taxels in a garment.
pub fn places(garment: &Garment, faulty: &BTreeMap<u16, TaxelHealth>) -> Result<Vec<FaultyPlace>> {
    let layout = Layout::build(garment, usize::from(u16::MAX), 4095)?;
    // A garment without wiring has no lines.
    let inputs = if garment.blocks.is_empty() { 0 } else { Pins::ANY.inputs };
    let circuit = Circuit::build(garment, &layout, Pins { inputs, ..Pins::ANY })?;
    let found = faulty.iter().filter_map(|(taxel, health)| {
        let place = layout.place(usize::from(*taxel))?;
        let panel = layout.areas().get(usize::from(place.panel))?;
        Some(FaultyPlace {
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
pub fn report(places: &[FaultyPlace]) -> Value {
    let one = |p: &FaultyPlace| {
        let (row, column) = p.place;
        let wired = p.wired;
        json!({
            "taxel": p.taxel, "health": p.health.to_string(), "panel": p.panel, "row": row, "column": column,
            "block": wired.map(|w| w.0), "wired_row": wired.map(|w| w.1), "wired_column": wired.map(|w| w.2),
        })
    };
    places.iter().map(one).collect()
}

/// Readable form: one line for each taxel.
pub fn table(garment: &Garment, places: &[FaultyPlace]) -> String {
    if places.is_empty() {
        return format!("{}: no faulty taxels.\n", garment.name);
    }
    let line = |p: &FaultyPlace| {
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
    use crate::fault;

    #[test]
    fn a_line_at_fault_is_reported_and_fails_the_command() {
        let file = std::env::temp_dir().join(format!("taxel-health-{}.toml", std::process::id()));
        let args = |faults: &str| {
            std::fs::write(&file, format!("duration_s = 1\n{faults}")).unwrap();
            HealthArgs {
                source: format!("sim:{}", file.display()).parse().unwrap(),
                // A stuck taxel is confirmed 58 frames after the fault appears.
                frames: 150,
                tare: None,
                self_test: true,
                passive: None,
                json: false,
            }
        };
        run(args("")).unwrap();
        let error = run(args("[faults]\npins = [{ pin = 8, fault = \"stuck-high\" }]")).unwrap_err();
        assert_eq!((error.to_string().as_str(), fault::status(&error)), ("faults of lines and inputs: 1", 3));
        let stuck = run(args("[faults]\nstuck = [{ taxel = 77, code = 300 }]")).unwrap_err();
        assert_eq!((stuck.to_string().as_str(), fault::status(&stuck)), ("faulty taxels: 1", 3));
        std::fs::remove_file(&file).unwrap();
    }

    #[test]
    fn a_faulty_taxel_is_named_by_panel_and_by_block() {
        let garment = Garment::reference();
        let faulty = BTreeMap::from([(512 + 16 * 7 + 5, TaxelHealth::Stuck)]);
        let places = places(&garment, &faulty).unwrap();
        let block = garment.blocks.iter().position(|b| b.panel == 1 && b.row == 4).unwrap();
        assert_eq!(
            table(&garment, &places),
            format!("stuck    back, row 7, column 5 (block {block}, its row 3, column 5; taxel 629)\n")
        );
        assert_eq!(report(&places)[0]["wired_row"], 3);
        assert!(table(&garment, &[]).ends_with(": no faulty taxels.\n"));
    }
}
