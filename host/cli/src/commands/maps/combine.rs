//! `taxel fcm combine` and `taxel fcm merge`: combine several maps into one, and report disagreements.

use crate::commands::print_beside;
use crate::watch::Overwrite;
use anyhow::Result;
use std::path::PathBuf;
use taxel::fcm::aggregate::Aggregation;
use taxel::fcm::board::BoardMap;
use taxel::fcm::combine::{report, table};
use taxel::fcm::load;
use taxel::fcm::map::MapFile;
use taxel::fcm::unite::{EdgeConflict, unite};
use taxel::files::output::Output;

/// Arguments of `taxel fcm combine`.
#[derive(Debug, Clone, clap::Args)]
pub struct CombineArgs {
    /// Maps of one subject, each by another expert
    #[arg(required = true, num_args = 2..)]
    pub maps: Vec<String>,
    /// File to write; the map is named after it
    #[arg(short, long)]
    pub output: PathBuf,
    /// Whether an existing output is replaced.
    #[command(flatten)]
    pub force: Overwrite,
    /// How the fuzzy sets of an edge's weights are aggregated before the centroid is taken
    #[arg(long, value_enum, default_value = "sum")]
    pub how: How,
    /// Print JSON instead of a table
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `taxel fcm merge`.
#[derive(Debug, Clone, clap::Args)]
pub struct MergeArgs {
    /// Maps of different subjects that share concepts
    #[arg(required = true, num_args = 2..)]
    pub maps: Vec<String>,
    /// File to write; the map is named after it
    #[arg(short, long)]
    pub output: PathBuf,
    /// Whether an existing output is replaced.
    #[command(flatten)]
    pub force: Overwrite,
    /// Aggregate weights that differ, instead of refusing them
    #[arg(long, value_enum)]
    pub combine: Option<How>,
    /// Print JSON instead of a table
    #[arg(long)]
    pub json: bool,
}

/// [`Aggregation`] on the command line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum How {
    /// Add memberships: repeated statements count.
    Sum,
    /// Take the greatest membership: repeated statements change nothing.
    Max,
}

impl From<How> for Aggregation {
    fn from(how: How) -> Aggregation {
        match how {
            How::Sum => Aggregation::Sum,
            How::Max => Aggregation::Max,
        }
    }
}

/// Runs `combine`: a map with both concepts but no edge votes `none`.
pub fn combine(args: CombineArgs) -> Result<()> {
    let output = Output::stream(&args.output, args.force, &args.maps)?;
    write(&args.maps, output, EdgeConflict::Vote(args.how.into()), args.json)
}

/// Runs `merge`: a map without an edge has no vote.
pub fn merge(args: MergeArgs) -> Result<()> {
    let output = Output::stream(&args.output, args.force, &args.maps)?;
    write(
        &args.maps,
        output,
        args.combine.map_or(EdgeConflict::Agree, |how| EdgeConflict::Combine(how.into())),
        args.json,
    )
}

fn write(paths: &[String], output: Output, shared: EdgeConflict, as_json: bool) -> Result<()> {
    // Distinguished by file name: maps of one subject mostly have the same name.
    let named = |path: &String| Ok(MapFile { name: path.clone(), ..load::map(path)? });
    let maps = paths.iter().map(named).collect::<Result<Vec<_>>>()?;
    let (name, is_standard) = (load::name(&output)?, output.is_standard());
    let united = unite(&maps, &name, shared)?;
    BoardMap::build(&united.map)?;
    load::save(&united.map, output)?;
    let text = if as_json { format!("{}\n", report(&united)) } else { table(&united).to_string() };
    print_beside(is_standard, &text);
    Ok(())
}
