//! `taxel config touches`: lists the scripts of touches that the simulated board can play.

use anyhow::Result;
use serde_json::{Value, json};
use taxel::sim::{self, SceneInfo};

/// Arguments of `taxel config touches`.
#[derive(Debug, Clone, clap::Args)]
pub struct TouchesArgs {
    /// Print JSON instead of a table
    #[arg(long)]
    pub json: bool,
}

/// Runs the command.
pub fn run(args: &TouchesArgs) -> Result<()> {
    let scenes = sim::list();
    if args.json {
        println!("{}", report(&scenes));
    } else {
        print!("{}", table(&scenes));
    }
    Ok(())
}

/// `[{"name", "title", "duration_s"}]`.
pub fn report(scenes: &[SceneInfo]) -> Value {
    let scene = |s: &SceneInfo| json!({ "name": s.name, "title": s.title, "duration_s": s.duration });
    scenes.iter().map(scene).collect()
}

/// Readable form: one line for each scene.
pub fn table(scenes: &[SceneInfo]) -> String {
    let width = scenes.iter().map(|s| s.name.chars().count()).max().unwrap_or(0);
    let line = |s: &SceneInfo| format!("{:width$}  {:>5.2} s  {}\n", s.name, s.duration, s.title);
    scenes.iter().map(line).collect()
}
