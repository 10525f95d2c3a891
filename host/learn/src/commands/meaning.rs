//! `taxel-learn meaning`: judges and learns the cognitive map on scripts of touches by several hands.

use crate::meaning::{Author, Row, counts, examples, learn, table};
use anyhow::Result;
use clap::{Args, Subcommand};
use std::path::PathBuf;
use taxel::fcm::learn::changed;
use taxel::fcm::load;
use taxel::files::output::{Force, Output};

/// The commands of `taxel-learn meaning`.
#[derive(Debug, Clone, Subcommand)]
pub enum MeaningCommand {
    /// Play all scripts, and say which are judged as their rules say
    Eval(MeaningEvalArgs),
    /// Learn the boundaries of threat and attack, and judge each author's scripts by a map learned without them
    Train(MeaningTrainArgs),
}

/// Arguments of `eval`.
#[derive(Debug, Clone, Args)]
pub struct MeaningEvalArgs {
    /// Folders of scripts, each with its rules.json: an author each
    #[arg(required = true, value_name = "FOLDER")]
    pub folders: Vec<PathBuf>,
    /// Map to judge [default: the shipped one]
    #[arg(long)]
    pub map: Option<PathBuf>,
    /// Also judge so many variants of each script: other forces, times, sizes, places and garments
    #[arg(long, value_name = "COUNT", default_value_t = 0)]
    pub variants: u64,
    /// Print the scripts that are right, too
    #[arg(long)]
    pub all: bool,
}

/// Arguments of `train`.
#[derive(Debug, Clone, Args)]
pub struct MeaningTrainArgs {
    /// Folders of scripts, each with its rules.json: an author each
    #[arg(required = true, value_name = "FOLDER")]
    pub folders: Vec<PathBuf>,
    /// File to write
    #[arg(short, long, value_name = "MAP")]
    pub output: PathBuf,
    /// Replace the output if it exists
    #[arg(long)]
    pub force: bool,
    /// Expert's map to begin with [default: the shipped one]
    #[arg(long)]
    pub map: Option<PathBuf>,
    /// Number of variants of each script that are learned from beside it
    #[arg(long, value_name = "COUNT", default_value_t = 2)]
    pub variants: u64,
}

/// Runs the command.
pub fn run(command: MeaningCommand) -> Result<()> {
    match command {
        MeaningCommand::Eval(args) => eval(&args),
        MeaningCommand::Train(args) => train(&args),
    }
}

fn train(args: &MeaningTrainArgs) -> Result<()> {
    let output = Output::file(&args.output, Force { force: args.force }, args.map.as_ref())?;
    let authors = args.folders.iter().map(|folder| Author::read(folder)).collect::<Result<Vec<_>>>()?;
    let name = args.map.as_ref().map_or("tactile".into(), |map| map.display().to_string());
    let expert = load::map(&name)?;
    let examples = examples(&authors, &expert, args.variants)?;
    // Each is judged by a map that has never heard its author.
    let folder = std::env::temp_dir().join(format!("taxel-learn-{}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    for (at, author) in authors.iter().enumerate().filter(|_| authors.len() > 1) {
        let map = folder.join("left-out.toml");
        std::fs::write(&map, toml::to_string(&learn(&expert, &examples, Some(at))?)?)?;
        println!("learned without {}:", author.name);
        let rows = table(std::slice::from_ref(author), Some(&map), None)?;
        rows.iter().filter(|row| !row.is_right()).for_each(|row| println!("{}", row.line()));
        print(author, &rows, 0);
    }
    std::fs::remove_dir_all(&folder)?;
    let learned = learn(&expert, &examples, None)?;
    for (from, to, before, after) in changed(&expert, &learned) {
        println!("{from} -> {to}: {before} becomes {after}");
    }
    output.write(toml::to_string(&learned)?.as_bytes())?;
    Ok(())
}

/// Prints how many of an author's scripts are right.
fn print(author: &Author, rows: &[Row], at: usize) {
    let [[sure, of_sure], [other, of_other]] = counts(rows, at);
    let (right, all) = (sure + other, of_sure + of_other);
    println!("{}: {right} of {all} right; {sure} of {of_sure} where people are sure", author.name);
}

fn eval(args: &MeaningEvalArgs) -> Result<()> {
    let authors = args.folders.iter().map(|folder| Author::read(folder)).collect::<Result<Vec<_>>>()?;
    for variant in std::iter::once(None).chain((1..=args.variants).map(Some)) {
        let rows = table(&authors, args.map.as_deref(), variant)?;
        match variant {
            Some(seed) => println!("variant {seed}:"),
            None => rows
                .iter()
                .filter(|row| args.all || !row.is_right())
                .for_each(|row| println!("{}", row.line())),
        }
        for (at, author) in authors.iter().enumerate() {
            print(author, &rows, at);
        }
    }
    Ok(())
}
