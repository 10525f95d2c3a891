//! Fit of the garment, found by touches whose place on the robot is known.

use super::dressed::DressedArgs;
use super::fit_text;
use super::mark_dialogue::MarkDialogue;
use crate::fault::Fault;
use crate::watch::{BoardArgs, Overwrite, WatchOptions, stop, watch};
use anyhow::{Context, Result, bail, ensure};
use clap::{ArgGroup, Args};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use taxel::body::fit::{KnownTouch, Mark, known_touches, marks, picked};
use taxel::body::{self, Fit, Form, ReadBody, Surface};
use taxel::files::input;
use taxel::files::output::Output;
use taxel::robot::BoardConfig;
use taxel::source::{SourceOptions, SourceSpec};
use taxel_core::garment::Layout;

/// A body, its garment, and touches.
#[derive(Debug, Clone, Args)]
#[command(group(ArgGroup::new("known").required(true).args(["touches", "marks", "pick"])))]
pub struct FitArgs {
    #[command(flatten)]
    dressed: DressedArgs,
    /// Touches whose place on the robot is known: a CSV file `panel,column,row,link,x,y,z`
    #[arg(long, value_name = "FILE")]
    touches: Option<PathBuf>,
    /// Marks on the robot, which are touched one after the other: a file with `link x y z` a line, metres
    #[arg(long, value_name = "FILE")]
    marks: Option<PathBuf>,
    /// Pick N marks on each panel, where the body says that its taxels are
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(3..=100))]
    pick: Option<u16>,
    /// The board that feels the touches of the marks: `auto`, `usb[:SERIAL]`, `serial:PATH[@BAUD]`, `tcp:HOST:PORT`,
    /// `zenoh:ROBOT/BOARD`, `sim[:TOUCHES]` or `replay:FILE[@SPEED]`
    #[arg(long, value_name = "SOURCE", default_value = "auto", conflicts_with = "touches")]
    source: SourceSpec,
    /// The body file to write, which says how each panel sits; - for the standard output
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Whether an existing file is replaced.
    #[command(flatten)]
    force: Overwrite,
    /// Print JSON instead of tables
    #[arg(long)]
    json: bool,
}

/// Finds how each panel sits, and writes the body file that says so.
pub fn run(args: &FitArgs) -> Result<()> {
    let read = body::read(&args.dressed.body)?;
    let inputs = [Some(Path::new(&args.dressed.body)), Some(Path::new(&args.dressed.garment))];
    let inputs = inputs.into_iter().chain([args.touches.as_deref(), args.marks.as_deref()]).flatten();
    let recorded = args.source.file();
    let inputs = inputs.chain(recorded.as_deref()).chain(read.lists());
    let output = Output::stream(&args.output, args.force, inputs)?;
    beside(args, &read)?;
    let (garment, layout) = args.dressed.garment()?;
    let touches = match &args.touches {
        Some(file) => known_touches(&file.display().to_string(), &text(file)?)?,
        None => {
            let surface = read.surface(&garment, &layout)?;
            asked(args, marked(args, &surface, &layout)?, &surface, &layout)?
        }
    };
    let fit = read.fit(&garment, &layout, &touches)?;
    let said = if args.json { fit_text::json(&fit) } else { fit_text::table(&fit, &touches) };
    // A body on the standard output is not mixed with words.
    match args.output.as_os_str() == "-" {
        true => eprint!("{said}"),
        false => print!("{said}"),
    }
    ensure!(!fit.panels.is_empty(), "no panel has been touched at three places or more: nothing is written");
    Ok(output.write(read.with_offsets(&fit.panels)?.as_bytes())?)
}

/// Refuses an output from where the lists of the body are not found: they lie beside it.
fn beside(args: &FitArgs, read: &ReadBody) -> Result<()> {
    let listed = read.body.patches.iter().find_map(|patch| match &patch.on {
        Form::Taxels(file) if Path::new(file).is_relative() => Some(file),
        _ => None,
    });
    let folder = |path: &Path| {
        path.parent().filter(|path| *path != Path::new("")).unwrap_or(Path::new(".")).canonicalize()
    };
    let Some(file) = listed.filter(|_| args.output.as_os_str() != "-") else { return Ok(()) };
    if folder(&args.output).ok() != folder(Path::new(&args.dressed.body)).ok() {
        let (output, body) = (args.output.display(), &args.dressed.body);
        bail!(Fault::usage(format!("{output}: must lie beside {body}, which lists taxels in {file}")));
    }
    Ok(())
}

fn text(file: &Path) -> Result<String> {
    input::text(file).with_context(|| format!("cannot read {}", file.display()))
}

/// The marks to be touched, each on a link that carries a panel.
fn marked(args: &FitArgs, surface: &Surface, layout: &Layout) -> Result<Vec<Mark>> {
    let Some(file) = &args.marks else {
        return Ok(picked(surface, layout, usize::from(args.pick.unwrap_or_default())));
    };
    let name = file.display().to_string();
    let marks = marks(&name, &text(file)?)?;
    ensure!(!marks.is_empty(), "{name}: it has no marks");
    for mark in &marks {
        let links = surface.links();
        ensure!(
            links.contains(&mark.link),
            "{name}: no panel lies on a link {:?}; panels lie on {}",
            mark.link,
            links.join(", ")
        );
    }
    Ok(marks)
}

/// Shows the marks one after the other, and takes the touch of each from the board.
fn asked(args: &FitArgs, marks: Vec<Mark>, surface: &Surface, layout: &Layout) -> Result<Vec<KnownTouch>> {
    // A simulated board has it; a real one has its own.
    let garment = matches!(args.source, SourceSpec::Sim(_)).then(|| args.dressed.garment.clone());
    let config = BoardConfig { garment, ..BoardConfig::of(args.source.clone()) };
    let board = BoardArgs { config, ..BoardArgs::default() };
    let (source, _) = board.open(SourceOptions::default())?;
    stop::catch()?;
    let mut dialogue = MarkDialogue::new(marks, links(surface, layout));
    watch(&WatchOptions::on(board), source, &mut dialogue)?;
    dialogue.touches()
}

/// Link of each panel that has a place, by the panel's name.
fn links(surface: &Surface, layout: &Layout) -> HashMap<String, String> {
    let link = |fit: Fit| (fit.panel, surface.links()[fit.link].clone());
    surface.fits(layout).into_iter().map(link).collect()
}
