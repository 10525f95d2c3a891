//! The dialogue of `taxel setup`.

use super::ask::{Ask, Gesture};
use super::feel::Feeler;
use super::solver::{Found, Next, Solver};
use super::touch::Touch;
use super::user::User;
use crate::commands::garment;
use crate::fault::Fault;
use crate::watch::raw::RawBoard;
use crate::watch::{Overwrite, time};
use anyhow::{Context, Result, bail};
use clap::Args;
use fastrand::Rng;
use serde_json::{Value, json};
use std::path::PathBuf;
use taxel::files::output::Output;
use taxel::sim;
use taxel::source::SourceSpec;
use taxel_core::garment::{Circuit, Garment, Layout, Pins};

/// Frames after a change of garment that may still be of the old one.
const OLD: u32 = 2;

/// Shown below the help.
const EXAMPLES: &str = "Examples:
  taxel setup --garment reference -o garment.toml
  taxel setup --source serial:/dev/ttyACM0 --garment mine.toml -o garment.toml
  taxel setup --simulate 7 --json";

/// Identify a garment's wires by touch, and write its garment file
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct SetupArgs {
    /// The board: `auto`, `usb[:SERIAL]`, `serial:PATH[@BAUD]`, `tcp:HOST:PORT`, `zenoh:ROBOT/BOARD`, `sim[:TOUCHES]`
    #[arg(long, value_name = "SOURCE", default_value = "auto")]
    pub source: SourceSpec,
    /// The intended garment, a preset or a TOML file: its panels, blocks and pins are used [default: the
    /// board's]
    #[arg(long, value_name = "G")]
    pub garment: Option<String>,
    /// File to write [default: print the garment]
    #[arg(long, short, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Whether an existing output is replaced.
    #[command(flatten)]
    pub force: Overwrite,
    /// Longest wait for a touch
    #[arg(long, value_name = "TIME", default_value = "20s", value_parser = time)]
    pub wait: f64,
    /// Print the dialogue as JSON, one object per line
    #[arg(long)]
    pub json: bool,
    /// Simulate a board with random wiring from this seed, and a user who touches as asked
    #[arg(long, value_name = "N", conflicts_with = "source")]
    pub simulate: Option<u64>,
}

/// Somebody who touches when asked.
trait Hands {
    /// Returns the touch that was felt, if any.
    fn touch(&mut self, ask: &Ask) -> Result<Option<Touch>>;
}

impl Hands for User {
    fn touch(&mut self, ask: &Ask) -> Result<Option<Touch>> {
        Ok(User::touch(self, ask))
    }
}

/// A board, touched by a person.
struct Watch<'a> {
    board: &'a mut RawBoard,
    feeler: Feeler,
    wait: f64,
}

impl Hands for Watch<'_> {
    fn touch(&mut self, _: &Ask) -> Result<Option<Touch>> {
        let mut began = None;
        loop {
            let frame = self.board.frame()?;
            let time = frame.time_us as f64 / 1e6;
            if let Some(touch) = self.feeler.take(time, &frame.codes) {
                return Ok(Some(touch));
            }
            if time - *began.get_or_insert(time) > self.wait && !self.feeler.is_touched() {
                return Ok(None);
            }
        }
    }
}

/// Runs the command.
pub fn run(args: SetupArgs) -> Result<()> {
    if !args.wait.is_finite() || args.wait <= 0.0 {
        bail!(Fault::usage("--wait must be a time above 0"));
    }
    let inputs = args.garment.iter().map(PathBuf::from).chain(args.source.file());
    let output = args.output.as_ref().map(|name| Output::stream(name, args.force, inputs)).transpose()?;
    let found = match args.simulate {
        Some(seed) => simulated(&args, seed)?,
        None => on_a_board(&args)?,
    };
    let comment = "Wiring found by `taxel setup`. Names, pitch and seams are those of the given garment.";
    if args.json && output.is_none() {
        return Ok(());
    }
    garment::write(&found.garment, comment, output)
}

fn simulated(args: &SetupArgs, seed: u64) -> Result<Found> {
    let template = taxel::files::garments::load(args.garment.as_deref().unwrap_or("reference"))?;
    let mut solver = solver(&template)?;
    let mut rng = Rng::with_seed(seed);
    let wired = sim::rewire(&template, &mut rng);
    let mut user = User::new(&wired, solver.bundle(), None, rng)?;
    converse(args, &template, &mut solver, &mut user)
}

fn on_a_board(args: &SetupArgs) -> Result<Found> {
    let given = args.garment.as_deref().map(taxel::files::garments::load).transpose()?;
    let mut board = RawBoard::open(&args.source)?;
    let template = given.unwrap_or_else(|| board.garment().clone());
    let mut solver = solver(&template)?;
    board.use_garment(&solver.bundle().probe(&template))?;
    if !args.json {
        println!("{}: hands off for a moment.", board.label());
    }
    let mut watch =
        Watch { feeler: Feeler::new(template.wiring.falling), wait: args.wait, board: &mut board };
    for _ in 0..OLD {
        watch.board.frame()?;
    }
    while !watch.feeler.is_ready() {
        let frame = watch.board.frame()?;
        watch.feeler.take(0.0, &frame.codes);
    }
    let found = converse(args, &template, &mut solver, &mut watch)?;
    board.leave(&found.garment)?;
    Ok(found)
}

fn solver(template: &Garment) -> Result<Solver> {
    let checked = Layout::build(template, usize::from(u16::MAX), 4095)
        .and_then(|layout| Circuit::build(template, &layout, Pins::ANY));
    checked.with_context(|| format!("garment {}", template.name))?;
    Solver::new(template)
}

/// Asks for touches until the garment is found, or cannot be.
fn converse(
    args: &SetupArgs,
    template: &Garment,
    solver: &mut Solver,
    hands: &mut impl Hands,
) -> Result<Found> {
    let say = |line: Value, text: String| if args.json { println!("{line}") } else { println!("{text}") };
    let mut number = 0;
    loop {
        match solver.what_next() {
            Next::Ask(ask) => {
                number += 1;
                say(question(&ask, template), in_words(number, &ask, template));
                let touch = hands.touch(&ask)?;
                match &touch {
                    Some(touch) => {
                        let seconds = touch.duration();
                        say(
                            json!({ "type": "felt", "seconds": seconds }),
                            format!("   felt for {seconds:.1} s"),
                        );
                    }
                    None => say(json!({ "type": "silent" }), "   nothing was felt".into()),
                }
                solver.take(touch);
            }
            Next::Found(found) => {
                say(answer(&found), summary(&found));
                return Ok(*found);
            }
            Next::NotSure(why) => {
                if args.json {
                    println!("{}", json!({ "type": "not_sure", "why": why }));
                }
                bail!("not sure: {why}");
            }
        }
    }
}

fn in_words(number: u32, ask: &Ask, template: &Garment) -> String {
    let again = ask.why.as_ref().map_or(String::new(), |why| format!("   Again, please: {why}.\n"));
    format!("{again}{number}. {}\n{}", ask.sentence(template), ask.picture(template))
}

fn question(ask: &Ask, template: &Garment) -> Value {
    let (gesture, at) = match ask.gesture {
        Gesture::Down { column, .. } => ("down", Some(column)),
        Gesture::Across { row } => ("across", Some(row)),
        Gesture::Corner => ("corner", None),
    };
    let panel = template.panels.get(ask.panel).map_or("", |panel| panel.name.as_str());
    json!({
        "type": "ask", "panel": ask.panel, "panel_name": panel, "gesture": gesture, "at": at,
        "text": ask.sentence(template), "why": ask.why,
    })
}

fn answer(found: &Found) -> Value {
    let dead = found.dead.iter().map(|(panel, input)| json!({ "panel": panel, "input": input }));
    json!({
        "type": "found", "touches": found.touches, "margin": found.margin, "off_taxels": found.off,
        "dead": dead.collect::<Vec<_>>(), "garment": found.garment,
    })
}

fn summary(found: &Found) -> String {
    let mut text = format!(
        "Found, after {} touches, all within {:.1} taxels of where they were asked for; least margin {:.0} %.",
        found.touches,
        found.off,
        100.0 * found.margin
    );
    for (panel, input) in &found.dead {
        let name = found.garment.panels.get(*panel).map_or("", |panel| panel.name.as_str());
        text += &format!(
            "\nPanel {name} gives no signal; assuming GP{input}, the only input left; look for a broken wire, \
             then set up again."
        );
    }
    text
}
