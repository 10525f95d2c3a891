//! Training and evaluation of a model of touches, of gestures or of intention.

use crate::touches::{
    Data, Files, Provenance, Report, Times, TrainSettings, as_it_is, courses, cross, example, nested, read,
    saturation, train, units,
};
use anyhow::{Result, ensure};
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};
use taxel::files::output::{Force, Output};
use taxel_core::gesture::{Model, ShippedModel};

/// Arguments of `train`.
#[derive(Debug, Clone, Args)]
pub struct TouchesTrainArgs {
    /// Recorded touches to learn from
    #[command(flatten)]
    pub files: Files,
    /// File to write
    #[arg(short, long, value_name = "MODEL")]
    pub output: PathBuf,
    /// Replace the output if it exists
    #[arg(long)]
    pub force: bool,
}

impl TouchesTrainArgs {
    /// The output file of the model.
    pub fn output(&self) -> Result<Output> {
        let inputs = [Some(&self.files.frames), self.files.labels.as_ref()];
        Ok(Output::file(&self.output, Force { force: self.force }, inputs.into_iter().flatten())?)
    }
}

/// Arguments of `eval`; `C` names the groups that may be left out.
#[derive(Debug, Clone, Args)]
pub struct TouchesEvalArgs<C: ValueEnum + Clone + Send + Sync + 'static> {
    /// Recorded touches to recognise
    #[command(flatten)]
    pub files: Files,
    /// Model to evaluate [default: the shipped one]; unused with --cross
    #[arg(long)]
    pub model: Option<PathBuf>,
    /// Cross-validate, leaving out one of these at a time
    #[arg(long, value_name = "GROUPS")]
    pub cross: Option<C>,
    /// With --cross: also choose the settings without the group that is tested; takes minutes
    #[arg(long, requires = "cross")]
    pub nested: bool,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// Task of a command.
#[derive(Debug, Clone, Copy)]
pub struct Task {
    /// The shipped model.
    pub shipped: ShippedModel,
    /// Training settings.
    pub settings: TrainSettings,
    /// Settings that `--nested` chooses from.
    pub candidates: fn() -> Vec<TrainSettings>,
}

impl Task {
    /// Trains on all touches and writes the model.
    pub fn train(&self, data: &Data, output: Output) -> Result<()> {
        eprintln!("{} touches of {} classes", data.touches.len(), data.classes.len());
        print(&doubts(data));
        let courses = courses(data, &self.settings);
        let examples: Vec<_> =
            courses.iter().zip(&data.touches).map(|(course, touch)| example(touch, course)).collect();
        let bytes = train(data, &examples, &self.settings)?;
        let name = output.name().display().to_string();
        output.write(&bytes)?;
        let from: Vec<String> =
            Model::read(&bytes)?.experts().map(|expert| expert.from().to_string()).collect();
        eprintln!("{name}: {} bytes, experts from frames {}", bytes.len(), from.join(", "));
        Ok(())
    }

    /// Evaluates as asked, and prints the report.
    pub fn eval<C>(&self, args: &TouchesEvalArgs<C>, data: Data, times: &Times) -> Result<()>
    where
        C: ValueEnum + Clone + Send + Sync + 'static,
    {
        if let (Some(model), Some(_)) = (&args.model, &args.cross) {
            eprintln!("note: --cross trains on the files; {} is not used", model.display());
        }
        let mut doubts = doubts(&data);
        let mut report = match (&args.cross, args.nested) {
            (None, _) => self.apply(data, args.model.as_deref(), times, &mut doubts)?,
            (Some(_), false) => cross(&data, &self.settings, times)?,
            (Some(_), true) => nested(&data, &(self.candidates)())?,
        };
        print(&doubts);
        report.add("doubts", doubts.into());
        if args.json {
            println!("{}", report.json());
        } else {
            print!("{}", report.text());
        }
        Ok(())
    }

    /// Applies the model of a file, else the shipped one. Adds to the doubts if the touches do not fit it.
    fn apply(
        &self,
        mut data: Data,
        model: Option<&Path>,
        times: &Times,
        doubts: &mut Vec<String>,
    ) -> Result<Report> {
        let bytes = model.map_or_else(|| Ok(self.shipped.bytes().to_vec()), read)?;
        let model = Model::read(&bytes)?;
        add_classes(&mut data, &model)?;
        doubts.extend(units(&data, &model));
        let trained_on = Provenance::of(&model)?.knows(&data.sources);
        let mut report = as_it_is(&model, &data, times)?;
        if trained_on {
            eprintln!(
                "warning: the model was trained on this file; use --cross for its accuracy on other touches"
            );
        }
        report.add("trained_on", trained_on.into());
        report.add("model_bytes", bytes.len().into());
        Ok(report)
    }
}

/// Reasons against conclusions from these touches, in sentences.
fn doubts(data: &Data) -> Vec<String> {
    data.doubts.iter().cloned().chain(saturation(data)).collect()
}

/// Prints warnings.
fn print(doubts: &[String]) {
    doubts.iter().for_each(|doubt| eprintln!("warning: {doubt}"));
}

/// Adds the model's classes that the labels do not name. Error if they have none in common.
fn add_classes(data: &mut Data, model: &Model<'_>) -> Result<()> {
    let known = (0..model.classes()).filter_map(|class| model.name(class)).map(|name| name.to_string());
    let (own, more): (Vec<String>, Vec<String>) = known.partition(|name| data.classes.contains(name));
    let labels = data.classes.join(", ");
    ensure!(!own.is_empty(), "the model knows {}, the labels {labels}", more.join(", "));
    data.classes.extend(more);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_may_name_fewer_classes_than_the_model_knows() {
        let model = Model::read(ShippedModel::Intent.bytes()).unwrap();
        let data = |classes: &[&str]| Data {
            rows: 8,
            columns: 8,
            classes: classes.iter().map(ToString::to_string).collect(),
            touches: Vec::new(),
            idle: Vec::new(),
            doubts: Vec::new(),
            sources: Vec::new(),
        };
        let mut few = data(&["attack", "tango"]);
        add_classes(&mut few, &model).unwrap();
        assert_eq!(few.classes, ["attack", "tango", "kindness", "threat"]);
        let why = add_classes(&mut data(&["tango"]), &model).unwrap_err().to_string();
        assert_eq!(why, "the model knows kindness, threat, attack, the labels tango");
    }
}
