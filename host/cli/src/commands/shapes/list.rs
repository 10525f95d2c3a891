//! `taxel shapes list`: lists the classes of a base.

use anyhow::Result;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use taxel::files::bases::{Base, shipped_names};

/// Arguments of `taxel shapes list`.
#[derive(Debug, Clone, clap::Args)]
pub struct ListArgs {
    /// Bases: files, or names of shipped bases [default: all shipped bases]
    pub bases: Vec<PathBuf>,
    /// Print JSON instead of a table
    #[arg(long)]
    pub json: bool,
}

/// Runs the command.
pub fn run(args: ListArgs) -> Result<()> {
    let shipped = || shipped_names().map(PathBuf::from).collect();
    let paths: Vec<PathBuf> = if args.bases.is_empty() { shipped() } else { args.bases };
    let bases =
        paths.iter().map(|path| Ok((path.as_path(), Base::open(path)?))).collect::<Result<Vec<_>>>()?;
    if args.json {
        println!("{}", bases.iter().map(|(path, base)| report(path, base)).collect::<Value>());
    } else {
        bases.iter().for_each(|(path, base)| print!("{}", table(path, base)));
    }
    Ok(())
}

/// Names of the classes, and the number of prototypes of each.
fn classes(base: &Base) -> Vec<(String, usize)> {
    let count =
        |class: usize| base.gallery.prototypes.iter().filter(|p| usize::from(p.class) == class).count();
    base.names().into_iter().enumerate().map(|(class, name)| (name, count(class))).collect()
}

fn report(path: &Path, base: &Base) -> Value {
    let class = |(name, count): (String, usize)| json!({ "name": name, "prototypes": count });
    json!({
        "base": path.display().to_string(),
        "classes": classes(base).into_iter().map(class).collect::<Value>(),
        "dimensions": base.gallery.space.weights.len(),
        "accuracy": base.card.accuracy,
    })
}

fn table(path: &Path, base: &Base) -> String {
    let head =
        format!("{}: {:.1} % right in {}\n", path.display(), 100.0 * base.card.accuracy, base.card.split);
    let line = |(name, count): (String, usize)| format!("  {name:<16} {count:>3} prototypes\n");
    head + &classes(base).into_iter().map(line).collect::<String>()
}
