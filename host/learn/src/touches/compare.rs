//! Evaluates a model, or the method on left-out groups.

use super::apply::{Applied, Taken, apply};
use super::certainty::{Prediction, reliability, waits};
use super::course::{Course, courses};
use super::data::{Data, Touch};
use super::experts::TouchExample;
use super::knn::nearest;
use super::map::mapped;
use super::model::train;
use super::report::{Outcome, Report, accuracy};
use super::settings::{EARLY, TrainSettings};
use anyhow::{Result, ensure};
use serde_json::{Value, json};
use taxel::text::progress::{Progress, Unit};
use taxel_core::gesture::{Features, Model};

/// Observation times.
#[derive(Debug, Clone)]
pub struct Times {
    /// Unit of the times.
    pub unit: &'static str,
    /// Duration of a frame in that unit.
    pub frame: f64,
    /// Times with their numbers of frames, ascending.
    pub steps: Vec<(f64, usize)>,
    /// Frames between two decisions in the evaluation of waiting.
    pub every: usize,
}

impl Times {
    /// Numbers of frames after which a touch of at most `longest` frames is decided.
    fn asked(&self, longest: usize) -> Vec<usize> {
        let steps = self.steps.iter().map(|(_, frames)| *frames);
        let mut asked: Vec<usize> = steps.chain((self.every..=longest).step_by(self.every.max(1))).collect();
        asked.sort_unstable();
        asked.dedup();
        asked
    }
}

/// Decisions in the order of the touches, each with the true class.
#[derive(Debug, Clone, Default)]
struct Found {
    touches: Vec<(usize, Applied)>,
    /// Decisions about periods without a touch.
    idle: Vec<usize>,
}

impl Found {
    fn add(
        &mut self,
        model: &Model<'_>,
        data: &Data,
        of: impl Fn(&Touch) -> bool,
        times: &Times,
    ) -> Result<()> {
        let touches: Vec<&Touch> = data.touches.iter().filter(|touch| of(touch)).collect();
        let longest = touches.iter().map(|touch| data.frames(touch).len()).max().unwrap_or(0);
        let applied = apply(model, data, &touches, &times.asked(longest))?;
        self.touches.extend(touches.iter().map(|touch| touch.class).zip(applied));
        let idle: Vec<&Touch> = data.idle.iter().filter(|touch| of(touch)).collect();
        self.idle.extend(apply(model, data, &idle, &[])?.into_iter().map(|applied| applied.last.class));
        Ok(())
    }

    /// Decisions at the end of the touches.
    fn last(&self) -> Vec<Outcome> {
        self.touches.iter().map(|(was, applied)| (*was, applied.last.class)).collect()
    }

    /// Decisions after this many frames, or at the end of shorter touches.
    fn after(&self, frames: usize) -> Vec<Outcome> {
        self.touches.iter().map(|(was, applied)| (*was, applied.after(frames).class)).collect()
    }

    fn report(self, data: &Data, times: &Times) -> Report {
        let last = self.last();
        let mut report = Report::new(&data.classes, last.clone());
        let by_class = |value: &dyn Fn(usize) -> Value| -> Value {
            let each = data.classes.iter().enumerate().map(|(class, name)| (name.clone(), value(class)));
            serde_json::Map::from_iter(each).into()
        };
        let reached: Vec<(f64, f64)> =
            times.steps.iter().map(|(time, frames)| (*time, accuracy(&self.after(*frames)))).collect();
        let over = reached.iter().map(|(time, share)| json!({ times.unit: time, "accuracy": share }));
        let first = reached.iter().find(|(_, share)| *share >= 0.9 * report.accuracy());
        report.add("over_time", over.collect());
        report.add(&format!("{}_to_90_percent_of_final", times.unit), json!(first.map(|(time, _)| time)));
        let onset = |class| json!(self.onset(class, times));
        report.add(&format!("median_onset_{}", times.unit), by_class(&onset));
        let recall = |class: usize| {
            let own: Vec<Outcome> = last.iter().filter(|(was, _)| *was == class).copied().collect();
            json!(accuracy(&own))
        };
        report.add("recall", by_class(&recall));
        if !self.idle.is_empty() {
            let count = |class: usize| json!(self.idle.iter().filter(|taken| **taken == class).count());
            report.add("idle_stretches_taken_for", by_class(&count));
        }
        let predictions = self.predictions(times);
        if !predictions.is_empty() {
            report.add("reliability", reliability(&predictions));
            report.add("announced_when_certain", waits(&self.touches, times.unit, times.frame));
        }
        report
    }

    /// Decisions at each observation time within a touch, and at its end, with their confidence.
    fn predictions(&self, times: &Times) -> Vec<Prediction> {
        let mut predictions = Vec::new();
        for (was, applied) in &self.touches {
            let step = |(frames, _): &&(usize, Taken)| times.steps.iter().any(|(_, step)| step == frames);
            let steps: Vec<&(usize, Taken)> = applied.early.iter().filter(step).collect();
            let ended = steps.last().is_some_and(|(frames, _)| *frames == applied.frames);
            let last = (!ended).then_some(&applied.last);
            let all = steps.into_iter().map(|(_, taken)| taken).chain(last);
            predictions.extend(all.filter_map(|taken| Some((taken.confidence?, taken.class == *was))));
        }
        predictions
    }

    /// Median time from which touches of a class that are recognised at their end are recognised without a
    /// break.
    fn onset(&self, class: usize, times: &Times) -> Option<f64> {
        let right = self.touches.iter().filter(|(was, applied)| (*was, applied.last.class) == (class, class));
        let since = right.map(|(_, applied)| {
            let wrong = times.steps.iter().rposition(|(_, frames)| applied.after(*frames).class != class);
            let step = wrong.map_or(0, |step| step + 1).min(times.steps.len().saturating_sub(1));
            times.steps.get(step).map_or(0.0, |(time, _)| *time)
        });
        let mut since: Vec<f64> = since.collect();
        since.sort_by(f64::total_cmp);
        since.get(since.len() / 2).copied()
    }
}

/// Evaluates a model as it is.
pub fn as_it_is(model: &Model<'_>, data: &Data, times: &Times) -> Result<Report> {
    let mut found = Found::default();
    found.add(model, data, |_| true, times)?;
    Ok(found.report(data, times))
}

/// Leave-one-group-out: trains on all other groups and applies to each group in turn. For comparison also
/// nearest neighbours and a cognitive map, on the same features.
pub fn cross(data: &Data, settings: &TrainSettings, times: &Times) -> Result<Report> {
    let groups = data.groups();
    ensure!(groups.len() >= 2, "there is only one group: it cannot be left out");
    let courses = courses(data, settings);
    let (mut found, mut by_group) = (Found::default(), serde_json::Map::new());
    let (mut near, mut map) = (Vec::new(), Vec::new());
    let mut progress = Progress::of("learning", Unit::Steps("models"), Some(groups.len() as u64));
    for (done, group) in (0..).zip(&groups) {
        progress.at(done);
        let (apart, known): (Vec<usize>, Vec<usize>) =
            (0..data.touches.len()).partition(|i| data.touches[*i].group == *group);
        let examples: Vec<_> = known.iter().map(|i| example(&data.touches[*i], &courses[*i])).collect();
        let bytes = train(data, &examples, settings)?;
        let before = found.touches.len();
        found.add(&Model::read(&bytes)?, data, |touch| touch.group == *group, times)?;
        let share = accuracy(&found.last()[before..]);
        progress.clear();
        eprintln!("{group}: {:.1} % of {} touches", 100.0 * share, apart.len());
        by_group.insert(group.clone(), json!(share));
        let whole: Vec<(&Features, usize)> =
            examples.iter().map(|example| (&example.course.whole, example.class)).collect();
        let asked: Vec<&Features> = apart.iter().map(|i| &courses[*i].whole).collect();
        let was = || apart.iter().map(|i| data.touches[*i].class);
        near.extend(was().zip(nearest(&whole, data.classes.len(), &asked)));
        map.extend(was().zip(mapped(&whole, data.classes.len(), &asked)));
    }
    let mut report = found.report(data, times);
    report.add("by_group", by_group.into());
    report.add("beside", json!({ "knn": accuracy(&near), "map": accuracy(&map) }));
    Ok(report)
}

/// A touch with its training data.
pub fn example<'a>(touch: &'a Touch, course: &'a Course) -> TouchExample<'a> {
    TouchExample { course, class: touch.class, group: &touch.group }
}

/// Trains on the touches of the known groups and applies to those of another group as a whole. These are
/// decided by the last expert, so only this one is trained, and all examples count as one group, which skips
/// the fit of hand-over and confidence.
pub(super) fn apart(
    data: &Data,
    courses: &[Course],
    settings: &TrainSettings,
    known: &[&str],
    group: &str,
) -> Result<Vec<Outcome>> {
    let touches = || data.touches.iter().zip(courses);
    let examples: Vec<_> = touches()
        .filter(|(touch, _)| known.contains(&touch.group.as_str()))
        .map(|(touch, course)| TouchExample { group: "", ..example(touch, course) })
        .collect();
    let bytes = train(data, &examples, &TrainSettings { early: [None; EARLY], ..*settings })?;
    let asked: Vec<&Touch> = data.touches.iter().filter(|touch| touch.group == group).collect();
    let applied = apply(&Model::read(&bytes)?, data, &asked, &[])?;
    Ok(asked.iter().zip(applied).map(|(touch, applied)| (touch.class, applied.last.class)).collect())
}
