//! `taxel ports`: lists what is plugged in, and which of it is a board.

use super::flash;
use anyhow::Result;
use clap::Args;
use serde_json::{Value, json};
use taxel::source::{PortKind, overheard, ports};

/// Shown below the help.
const EXAMPLES: &str = "Examples:
  taxel ports
  taxel ports --listen
  taxel ports --json";

/// List serial ports, and which of them is a board
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct PortsArgs {
    /// Print JSON instead of a table
    #[arg(long)]
    pub json: bool,
    /// Open the ports that are no board's, and name what speaks there: some devices restart when they are opened
    #[arg(long, conflicts_with = "json")]
    pub listen: bool,
}

/// Runs the command.
pub fn run(args: PortsArgs) -> Result<()> {
    let (found, drives) = (ports(), flash::drives());
    if args.json {
        let each: Vec<Value> = found
            .iter()
            .map(|(name, kind, usb)| json!({ "port": name, "kind": kind.word(), "usb": usb }))
            .chain(drives.iter().map(|drive| json!({ "drive": drive, "kind": "boot-loader" })))
            .collect();
        println!("{}", Value::from(each));
        return Ok(());
    }
    for (name, kind, usb) in &found {
        println!("{name:<20} {:<12} {usb}", kind.word());
        if args.listen && *kind == PortKind::Other {
            println!("{:<20} {}", "", overheard(name));
        }
    }
    for drive in &drives {
        println!("{:<20} boot loader  `taxel flash` writes the firmware there", drive.display());
    }
    println!("{}", advice(found.iter().map(|(_, kind, _)| *kind), drives.len()));
    Ok(())
}

/// Advice on what was found.
fn advice(kinds: impl Iterator<Item = PortKind> + Clone, drives: usize) -> &'static str {
    let any = |kind| kinds.clone().any(|k| k == kind);
    match (any(PortKind::Board), any(PortKind::Probe), drives) {
        (true, ..) => "A board is there: `taxel live`.",
        (_, true, _) => {
            "A probe is there, which may pass on a board's UART: `taxel live --source serial:PORT`."
        }
        (_, _, 1..) => "A board waits for its firmware: `taxel flash FILE.uf2`.",
        _ if kinds.clone().next().is_some() => {
            "None of these identifies itself as a taxel board; over a UART adapter: `taxel live --source serial:PORT`; `taxel ports --listen` names other sensors."
        }
        _ => {
            "No serial port and no boot loader's drive: is the board plugged in, with a cable that carries data?"
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_advice_fits_what_is_there() {
        let of = |kinds: &[PortKind], drives| advice(kinds.iter().copied(), drives);
        assert!(of(&[PortKind::Other, PortKind::Board], 1).contains("`taxel live`"));
        assert!(of(&[PortKind::Probe], 0).contains("serial:PORT"));
        assert!(of(&[PortKind::Other], 1).contains("taxel flash"));
        assert!(of(&[PortKind::Other], 0).starts_with("None"));
        assert!(of(&[], 0).starts_with("No serial port"));
    }
}
