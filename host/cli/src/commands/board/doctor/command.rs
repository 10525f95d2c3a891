//! The command `taxel doctor`.

use super::facts::Facts;
use super::finding::{Finding, Grade};
use super::judge::judge;
use crate::fault::Fault;
use crate::watch::{self, BoardArgs, WatchOptions};
use anyhow::{Context, Result, bail, ensure};
use clap::Args;
use serde_json::json;
use taxel::client::Buses;
use taxel::error::{ErrorKind, SourceError};
use taxel::robot::ReadRobot;
use taxel::source::{Source, SourceOptions, SourceSpec};
use taxel::text::date;

/// Shown below the help.
const EXAMPLES: &str = "Examples:
  taxel doctor
  taxel doctor --source serial:/dev/ttyACM0 --for 20s --json";

/// Diagnose a board: what is wrong, and what to do about it
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct DoctorArgs {
    /// A source, as --source takes it, or a robot's file (.toml): all its boards
    #[arg(value_name = "SOURCE", conflicts_with = "source")]
    pub place: Option<SourceSpec>,
    /// The board: `auto`, `usb[:SERIAL]`, `serial:PATH[@BAUD]`, `tcp:HOST:PORT`, `zenoh:ROBOT/BOARD`, `sim[:TOUCHES]`
    #[arg(long, value_name = "SOURCE", default_value = "auto")]
    pub source: SourceSpec,
    /// Time of the board to listen, such as 5s
    #[arg(long = "for", value_name = "TIME", default_value = "5s", value_parser = watch::time, allow_negative_numbers = true)]
    pub seconds: f64,
    /// Print JSON instead of a table
    #[arg(long)]
    pub json: bool,
}

impl DoctorArgs {
    /// The robot whose boards are all meant; none for a board.
    pub fn robot(&self) -> Result<Option<ReadRobot>> {
        let ok = self.seconds.is_finite() && self.seconds > 0.0;
        ensure!(ok, Fault::usage("--for must be a time above 0"));
        let SourceSpec::Robot { file, board: None } = self.source() else { return Ok(None) };
        Ok(Some(ReadRobot::read(file)?))
    }

    /// The source.
    fn source(&self) -> &SourceSpec {
        self.place.as_ref().unwrap_or(&self.source)
    }
}

/// Runs the command. Error if the board does not work.
pub fn run(args: &DoctorArgs) -> Result<()> {
    let spec = args.source();
    let options = SourceOptions { seconds: Some(args.seconds), ..SourceOptions::default() };
    let source = BoardArgs::of(spec.clone()).read()?.open_any(&options).context(
        "no link (`taxel ports` lists what is plugged in; docs/guides/troubleshooting.md says more)",
    )?;
    let label = source.label.clone();
    let Examined { found, heard, .. } = examine(spec, source, args.seconds, Buses::default());
    let worst = worst(&found);
    if args.json {
        println!("{}", json!({ "type": "doctor", "source": label, "verdict": worst, "findings": found }));
    } else {
        println!("{label}");
        found.iter().for_each(|finding| println!("{}", line(finding)));
    }
    heard?;
    match worst {
        Grade::Bad => {
            bail!(Fault::board(format!("{label} does not work as it should: {}", first_cure(&found))))
        }
        _ if args.json => {}
        Grade::Weak => println!("It works. What could be better is marked with !"),
        Grade::Good => println!("All is well."),
    }
    Ok(())
}

/// A board that was watched.
#[derive(Debug)]
pub struct Examined {
    /// Findings on the board.
    pub found: Vec<Finding>,
    /// The error that ended the watch.
    pub heard: Result<()>,
    /// Number of the USB host controller that it is on, the same for all that share it; none if it is on none.
    pub bus: Option<usize>,
}

/// Watches a board for some seconds; it may share one of these controllers with others.
pub fn examine(spec: &SourceSpec, source: Source, seconds: f64, buses: Buses) -> Examined {
    let mut facts = Facts::new(buses);
    let live = WatchOptions { seconds: Some(seconds), ..WatchOptions::of(spec.clone()) };
    let heard = watch::watch(&live, source, &mut facts);
    let found = match heard.as_ref().err().and_then(foreign) {
        Some(what) => vec![Finding::bad("link", what, ELSEWHERE)],
        None => judge(&facts, env!("CARGO_PKG_VERSION"), &date::today()),
    };
    Examined { found, heard, bus: facts.bus }
}

/// Remedy for a port on which something else speaks.
const ELSEWHERE: &str = "name the port of the board and its speed: `taxel ports` lists what is plugged in";

/// Returns what speaks in place of a board, if that has ended the watch.
fn foreign(error: &anyhow::Error) -> Option<String> {
    match error.downcast_ref::<taxel::Error>()?.kind() {
        ErrorKind::Source(SourceError::Foreign(what)) => Some(what.clone()),
        _ => None,
    }
}

/// The worst of the findings.
pub fn worst(found: &[Finding]) -> Grade {
    found.iter().map(|finding| finding.grade).max().unwrap_or(Grade::Good)
}

/// A finding and its remedy in a line.
pub fn line(finding: &Finding) -> String {
    let mark = match finding.grade {
        Grade::Good => ' ',
        Grade::Weak => '!',
        Grade::Bad => 'X',
    };
    let cure = if finding.cure.is_empty() { String::new() } else { format!(" -> {}", finding.cure) };
    format!("{mark} {:<12} {}{cure}", finding.of, finding.what)
}

/// Remedy of the first finding of what does not work.
pub fn first_cure(found: &[Finding]) -> &str {
    found.iter().find(|finding| finding.grade == Grade::Bad).map_or("", |finding| finding.cure)
}
