//! `taxel fcm combine` and `taxel fcm merge`: combine several maps into one, and report disagreements.

use super::aggregate::Aggregation;
use super::board::BoardMap;
use super::load;
use super::map::MapFile;
use super::unite::{Shared, United, unite};
use crate::output::{Force, Output, tell};
use anyhow::Result;
use serde_json::{Value, json};
use std::path::PathBuf;

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
    pub force: Force,
    /// How the fuzzy sets of an edge's weights are aggregated before the centroid is taken
    #[arg(long, value_enum, default_value = "sum")]
    pub how: Aggregation,
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
    pub force: Force,
    /// Aggregate weights that differ, instead of refusing them
    #[arg(long, value_enum)]
    pub combine: Option<Aggregation>,
    /// Print JSON instead of a table
    #[arg(long)]
    pub json: bool,
}

/// Runs `combine`: a map with both concepts but no edge votes `none`.
pub fn combine(args: CombineArgs) -> Result<()> {
    let output = Output::stream(&args.output, args.force, &args.maps)?;
    write(&args.maps, output, Shared::Vote(args.how), args.json)
}

/// Runs `merge`: a map without an edge has no vote.
pub fn merge(args: MergeArgs) -> Result<()> {
    let output = Output::stream(&args.output, args.force, &args.maps)?;
    write(&args.maps, output, args.combine.map_or(Shared::Agree, Shared::Combine), args.json)
}

fn write(paths: &[String], output: Output, shared: Shared, as_json: bool) -> Result<()> {
    // Distinguished by file name: maps of one subject mostly have the same name.
    let named = |path: &String| Ok(MapFile { name: path.clone(), ..load::map(path)? });
    let maps = paths.iter().map(named).collect::<Result<Vec<_>>>()?;
    let (name, is_standard) = (load::name(&output)?, output.is_standard());
    let united = unite(&maps, &name, shared)?;
    BoardMap::build(&united.map)?;
    load::save(&united.map, output)?;
    let told = if as_json { format!("{}\n", report(&united)) } else { table(&united).to_string() };
    tell(is_standard, &told);
    Ok(())
}

/// `{"map", "concepts", "edges": [{"from", "to", "weight", "said", "spread", "sign_conflict"}], "conflicts"}`.
pub fn report(united: &United) -> Value {
    json!({
        "map": united.map.name,
        "concepts": united.map.concept.iter().map(|concept| &concept.name).collect::<Vec<_>>(),
        "edges": united.edges.iter().map(|edge| edge.json()).collect::<Value>(),
        "conflicts": united.conflicts,
    })
}

/// Readable form: one line for each edge, the largest disagreement first.
pub fn table(united: &United) -> String {
    let mut edges: Vec<_> = united.edges.iter().collect();
    edges.sort_by(|a, b| b.spread().total_cmp(&a.spread()));
    let name = |edge: &super::unite::Opinions| format!("{} -> {}", edge.from, edge.to);
    let width = edges.iter().map(|edge| name(edge).chars().count()).max().unwrap_or(0).max(4);
    let mut text = format!("{:width$} {:>7} {:>7}  said\n", "edge", "weight", "spread");
    for edge in edges {
        let said: Vec<String> = edge.said.iter().map(|(map, weight)| format!("{weight} ({map})")).collect();
        let conflict = if edge.is_conflict() { "; SIGNS CONFLICT" } else { "" };
        text += &format!(
            "{:width$} {:>7} {:>7.2}  {}{conflict}\n",
            name(edge),
            edge.weight.value(),
            edge.spread(),
            said.join(", ")
        );
    }
    united.conflicts.iter().for_each(|conflict| text += &format!("note: {conflict}\n"));
    text + &format!(
        "{}: {} concepts, {} edges\n",
        united.map.name,
        united.map.concept.len(),
        united.map.edge.len()
    )
}
