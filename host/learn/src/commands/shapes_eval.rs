//! `taxel-learn shapes eval`: evaluates a base on labelled images.

use super::recipe::RecipeArgs;
use crate::shapes::cross::{SEED, deal, predict};
use crate::shapes::data::{Example, Examples, Images};
use crate::shapes::trained::{check, counted, trained};
use anyhow::Result;
use serde_json::{Value, json};
use std::path::PathBuf;
use taxel::files::bases::Base;
use taxel::learn::confusion::Confusion;
use taxel::learn::fingerprint::Fingerprint;
use taxel_core::shape::Recognised;

/// Arguments of `taxel-learn shapes eval`.
#[derive(Debug, Clone, clap::Args)]
pub struct ShapesEvalArgs {
    /// Images to recognise.
    #[command(flatten)]
    pub images: Images,
    /// Base: a file, or the name of a shipped base [default: the shipped one that knows most of the classes,
    /// for this grid]; unused with --cross
    #[arg(long, value_name = "BASE")]
    pub base: Option<PathBuf>,
    /// Cross-validate on the images, with this number of folds
    #[arg(long, value_name = "FOLDS", value_parser = clap::value_parser!(u16).range(2..=10_000))]
    pub cross: Option<u16>,
    /// Training settings, for --cross.
    #[command(flatten)]
    pub recipe: RecipeArgs,
    /// Print JSON instead of a table
    #[arg(long)]
    pub json: bool,
}

/// Results of an evaluation, and their origin.
struct Evaluation {
    confusion: Confusion,
    found: Vec<Recognised>,
    /// Right answers.
    right: Vec<bool>,
    base: Value,
    trained_on: bool,
}

/// Runs the command.
pub fn run(args: &ShapesEvalArgs) -> Result<()> {
    if let (Some(base), Some(_)) = (&args.base, args.cross) {
        eprintln!("note: --cross trains on the images; {} is not used", base.display());
    }
    let (examples, outcome) = match args.cross {
        Some(folds) => crossed(args, folds)?,
        None => applied(args)?,
    };
    if outcome.trained_on {
        eprintln!("warning: the base was trained on this file: the figures say nothing of other touches");
    }
    if args.json {
        println!("{}", report(args, &examples, &outcome));
    } else {
        let all = outcome.confusion.all();
        println!("{:.1} % of {all} right", 100.0 * outcome.confusion.accuracy());
        print!("{}", outcome.confusion.table());
    }
    Ok(())
}

/// Evaluates galleries trained on the other folds.
fn crossed(args: &ShapesEvalArgs, folds: u16) -> Result<(Examples, Evaluation)> {
    let examples = args.images.read(None)?;
    check(&examples)?;
    let list: Vec<&Example> = examples.list.iter().collect();
    let recipe = args.recipe.recipe();
    let found = predict(&list, &deal(&list, folds.into(), SEED), |others| {
        trained(others, &examples.names, &recipe).0
    });
    let confusion = counted(&list, &examples.names, &found);
    let right = list.iter().zip(&found).map(|(e, f)| f.class.map(usize::from) == Some(e.class)).collect();
    Ok((examples, Evaluation { confusion, found, right, base: Value::Null, trained_on: false }))
}

/// Evaluates an existing base.
fn applied(args: &ShapesEvalArgs) -> Result<(Examples, Evaluation)> {
    let (name, base) = match &args.base {
        Some(path) => (path.display().to_string(), Base::open(path)?),
        None => {
            let examples = args.images.read(None)?;
            let (name, base) = Base::shipped_for(&examples.kinds, examples.grid)?;
            (name.to_string(), base)
        }
    };
    let examples = args.images.read(Some(base.view))?;
    // Names of the base's classes are merged like those of the labels.
    let named = |name: String| args.images.classes.of(&name).map(String::from).unwrap_or(name);
    let known: Vec<String> = base.names().into_iter().map(named).collect();
    let mut answers = known.clone();
    answers.sort();
    answers.dedup();
    let mut confusion = Confusion::new(&examples.names, &answers);
    let (mut found, mut right) = (Vec::new(), Vec::new());
    for example in &examples.list {
        let recognised = base.gallery.recognise(&example.descriptor);
        let answer =
            recognised.class.and_then(|class| answers.binary_search(known.get(usize::from(class))?).ok());
        confusion.count(example.class, answer);
        right.push(confusion.is_right(example.class, answer));
        found.push(recognised);
    }
    let trained_on = base.knows_file(&Fingerprint::of(&args.images.images)?.to_string());
    Ok((examples, Evaluation { confusion, found, right, base: json!(name), trained_on }))
}

fn report(args: &ShapesEvalArgs, examples: &Examples, outcome: &Evaluation) -> Value {
    let mut report = outcome.confusion.figures();
    let mut add = |key: &str, value: Value| report.insert(key.into(), value);
    add("images", json!(outcome.found.len()));
    add("base", outcome.base.clone());
    add("cross", json!(args.cross));
    add("trained_on", json!(outcome.trained_on));
    add("view", json!(examples.view));
    add("calibration", calibration(outcome));
    add("by_set", examples.by_set(&outcome.right));
    report.into()
}

/// Mean confidence and accuracy, by quarters of the confidence.
fn calibration(outcome: &Evaluation) -> Value {
    let all =
        || outcome.found.iter().zip(&outcome.right).map(|(found, right)| (found.confidence.to_f64(), *right));
    let quarter = |n: usize| {
        let inside: Vec<(f64, bool)> =
            all().filter(|(confidence, _)| ((confidence * 4.0) as usize).min(3) == n).collect();
        let mean = |sum: f64| (!inside.is_empty()).then(|| sum / inside.len() as f64);
        json!({
            "answers": inside.len(),
            "confidence": mean(inside.iter().map(|(confidence, _)| confidence).sum()),
            "right": mean(inside.iter().filter(|(_, right)| *right).count() as f64),
        })
    };
    (0..4).map(quarter).collect()
}
