//! `taxel shapes prune`: removes prototypes that do not affect decisions.

use crate::watch::Overwrite;
use anyhow::Result;
use std::path::PathBuf;
use taxel::files::bases::Base;
use taxel::files::output::Output;
use taxel::learn::shapes::prune::prune;

/// Arguments of `taxel shapes prune`.
#[derive(Debug, Clone, clap::Args)]
pub struct PruneArgs {
    /// Base: a file, or the name of a shipped base
    pub base: PathBuf,
    /// File to write
    #[arg(short, long, value_name = "BASE")]
    pub output: PathBuf,
    /// Whether an existing output is replaced.
    #[command(flatten)]
    pub force: Overwrite,
}

/// Runs the command.
pub fn run(args: PruneArgs) -> Result<()> {
    let output = Output::stream(&args.output, args.force, [&args.base])?;
    let mut base = Base::open(&args.base)?;
    let before = base.gallery.prototypes.len();
    prune(&mut base.gallery);
    base.card.split += ", before pruning";
    base.save(output)?;
    eprintln!("{}: {} of {before} prototypes", args.output.display(), base.gallery.prototypes.len());
    Ok(())
}
