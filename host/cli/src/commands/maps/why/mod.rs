//! `taxel fcm why`: explains an activation in numbers that add up, and what would change it.

mod robot;

use crate::commands::maps::reported::ReportedArgs;
use anyhow::Result;
use serde_json::json;
use taxel::fcm::decimal::Decimal;
use taxel::fcm::load;
use taxel::fcm::reported::ReportedIntent;
use taxel::fcm::why::{explain, explain_reported, report, text, what_if};

/// Arguments of `taxel fcm why`.
#[derive(Debug, Clone, clap::Args)]
pub struct WhyArgs {
    /// TOML file, or the name of a shipped map
    #[arg(required_unless_present = "source")]
    pub map: Option<String>,
    /// Activation of a concept that nothing causes, as NAME=VALUE
    #[arg(long, value_parser = load::assignment)]
    pub input: Vec<(String, Decimal)>,
    /// Alternatively a source.
    #[command(flatten)]
    pub reported: ReportedArgs,
    /// Concept to explain [default: the announced or the strongest intention, else the strongest concept that
    /// has causes]
    #[arg(long)]
    pub of: Option<String>,
    /// Change to try: another value of an input, or a concept held at a value against its causes, as NAME=VALUE
    #[arg(long, value_parser = load::assignment)]
    pub set: Vec<(String, Decimal)>,
    /// Paths to list
    #[arg(long, default_value_t = 12)]
    pub paths: usize,
    /// Print JSON instead of a table; it has all paths
    #[arg(long)]
    pub json: bool,
}

/// Runs the command.
pub fn run(args: WhyArgs) -> Result<()> {
    if let Some(robot) = args.reported.robot()? {
        return robot::run(&args, &robot);
    }
    let reported = args.reported.listen()?;
    let (file, inputs) = match (&reported, &args.map) {
        (Some(reported), _) => (reported.map.clone(), reported.inputs()),
        (None, map) => (load::map(map.as_deref().unwrap_or_default())?, args.input.clone()),
    };
    let explained = match &reported {
        Some(reported) => explain_reported(reported, args.of.as_deref())?,
        None => explain(&file, &inputs, args.of.as_deref())?,
    };
    let changed = if args.set.is_empty() { None } else { Some(what_if(&file, &inputs, &args.set)?) };
    if args.json {
        let mut value = report(&explained, changed.as_ref());
        if let Some(ReportedIntent { report, seconds, .. }) = &reported {
            value["leading"] = json!(report.leading.as_str());
            value["frame"] = json!(report.frame);
            value["seconds"] = json!(seconds);
        }
        println!("{value}");
    } else {
        print!("{}", reported.as_ref().map_or_else(String::new, ReportedIntent::text));
        print!("{}", text(&file, &explained, changed.as_ref(), args.paths));
    }
    Ok(())
}
