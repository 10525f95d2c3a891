//! `taxel fcm draw`: writes the graph of a map, for Graphviz to draw.

use crate::commands::maps::reported::ReportedArgs;
use crate::watch::Overwrite;
use anyhow::Result;
use std::path::PathBuf;
use taxel::fcm::board::BoardMap;
use taxel::fcm::decimal::Decimal;
use taxel::fcm::draw::dot;
use taxel::fcm::load;
use taxel::fcm::map::MapFile;
use taxel::files::output::Output;

/// Arguments of `taxel fcm draw`.
#[derive(Debug, Clone, clap::Args)]
pub struct DrawArgs {
    /// TOML file, or the name of a shipped map
    #[arg(required_unless_present = "source")]
    pub map: Option<String>,
    /// File to write (.dot): `dot -Tsvg FILE` draws it
    #[arg(short, long)]
    pub output: PathBuf,
    /// Whether an existing output is replaced.
    #[command(flatten)]
    pub force: Overwrite,
    /// Activation of a concept at the start, as NAME=VALUE; with it, activations are drawn
    #[arg(long, value_parser = load::assignment)]
    pub input: Vec<(String, Decimal)>,
    /// Alternatively a source, whose activations are drawn.
    #[command(flatten)]
    pub reported: ReportedArgs,
}

/// Runs the command.
pub fn run(args: DrawArgs) -> Result<()> {
    let inputs = args.map.iter().map(PathBuf::from).chain(args.reported.files());
    let output = Output::stream(&args.output, args.force, inputs)?;
    let (map, activations) = match args.reported.listen()? {
        Some(reported) => {
            let activations = reported.report.concepts.iter().map(|value| value.to_f64()).collect();
            (reported.map, Some(activations))
        }
        None => {
            let map = load::map(args.map.as_deref().unwrap_or_default())?;
            let activations = (!args.input.is_empty()).then(|| settled(&map, &args.input)).transpose()?;
            (map, activations)
        }
    };
    Ok(output.write(dot(&map, activations.as_deref()).as_bytes())?)
}

fn settled(map: &MapFile, inputs: &[(String, Decimal)]) -> Result<Vec<f64>> {
    let board = BoardMap::build(map)?;
    let start = inputs.iter().map(|(name, value)| Ok((map.index(name, "--input")?, *value)));
    let run = board.infer(&board.state(start.collect::<Result<Vec<_>>>()?));
    Ok(run.state.iter().take(map.concept.len()).map(|x| board.value(*x)).collect())
}
