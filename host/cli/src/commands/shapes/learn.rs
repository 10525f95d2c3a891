//! `taxel shapes learn`: adds a class to a base, or examples to a class, from touches on a board.

use super::hold::Hold;
use crate::watch::{self, BoardArgs, Overwrite, WatchOptions, time};
use anyhow::{Result, ensure};
use std::path::PathBuf;
use taxel::files::bases::{Base, ImagesFile, LEFT_OUT};
use taxel::files::output::{Force, Output, is_same};
use taxel::learn::fingerprint::Fingerprint;
use taxel::learn::shapes::extend::{check_name, extend};
use taxel::source::{SourceOptions, SourceSpec};
use taxel_core::shape::Point;

/// Arguments of `taxel shapes learn`.
#[derive(Debug, Clone, clap::Args)]
pub struct ShapesLearnArgs {
    /// Name of the class, at most 16 bytes
    pub name: String,
    /// The board that the object is held against
    #[command(flatten)]
    pub board: BoardArgs,
    /// Number of touches to wait for
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u16).range(1..=1000))]
    pub touches: u16,
    /// Stop waiting after this time of the board, such as 10s [default: a simulated scene is played once]
    #[arg(long = "for", value_name = "TIME", value_parser = time)]
    pub seconds: Option<f64>,
    /// Base to add to: a file, or the name of a shipped base [default: the output file; if it does not exist,
    /// an empty base]
    #[arg(long, value_name = "BASE")]
    pub base: Option<PathBuf>,
    /// Largest number of prototypes to add
    #[arg(long, value_name = "N", default_value_t = 8)]
    pub prototypes: usize,
    /// File to write
    #[arg(short, long, value_name = "BASE")]
    pub output: PathBuf,
    /// Whether an existing output is replaced.
    #[command(flatten)]
    pub force: Overwrite,
}

/// Runs the command.
pub fn run(args: ShapesLearnArgs) -> Result<()> {
    check_name(&args.name)?;
    let output = output(&args)?;
    let mut base = match &args.base {
        Some(base) => Base::open(base)?,
        None if args.output.exists() => Base::open(&args.output)?,
        None => Base::empty()?,
    };
    let (points, source) = held(&args, &base)?;
    let added = extend(&mut base, &args.name, &points, args.prototypes)?;
    base.trained_on.push(source);
    base.save(output)?;
    let (file, name) = (args.output.display(), &args.name);
    eprintln!("{file}: {added} prototypes of {name} from {} touches", points.len());
    let count = base.gallery.prototypes.len();
    if base.card.split == LEFT_OUT && count > 1 {
        eprintln!("{:.0} % of {count} are recognised by the others", 100.0 * base.card.accuracy);
    }
    Ok(())
}

/// The output file. A base that is extended is read first, and may be replaced.
fn output(args: &ShapesLearnArgs) -> Result<Output> {
    let extends = args.base.as_ref().is_none_or(|base| is_same(base, &args.output));
    let force = Force { force: args.force.force || extends };
    let base = args.base.iter().filter(|_| !extends);
    let inputs = base.cloned().chain(args.board.files());
    Ok(Output::file(&args.output, force, inputs)?)
}

/// A point for each touch that was held against a board.
fn held(args: &ShapesLearnArgs, base: &Base) -> Result<(Vec<Point>, ImagesFile)> {
    let options = SourceOptions { seconds: args.seconds, ..SourceOptions::default() };
    let (source, _) = args.board.open(options)?;
    let (label, wanted) = (source.label.clone(), usize::from(args.touches));
    eprintln!(
        "{label}: hold {} against the garment {wanted} times for half a second, each time at another place and angle",
        args.name
    );
    let mut hold = Hold::new(&base.gallery.space, wanted);
    let watched = WatchOptions { seconds: args.seconds, ..WatchOptions::on(args.board.clone()) };
    watch::watch(&watched, source, &mut hold)?;
    let points = hold.held;
    if (1..wanted).contains(&points.len()) {
        eprintln!("{label} ended after {} of {wanted} touches", points.len());
    }
    ensure!(!points.is_empty(), "{label} ended before anything was held against it for half a second");
    let fingerprint = match &args.board.source() {
        SourceSpec::Replay { recording, .. } => Fingerprint::of(&recording.path)?.to_string(),
        _ => String::new(),
    };
    let images = points.len();
    Ok((points, ImagesFile { file: label, fingerprint, sets: Vec::new(), images }))
}
