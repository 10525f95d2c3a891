//! Evaluation of a model as it is, and of the method on groups that were kept apart.

use super::data::{Data, Touch};
use super::knn::nearest;
use super::map::mapped;
use super::model::{Course, Settings, apply, courses, train};
use super::report::{Outcome, Report, accuracy};
use crate::progress::{Progress, Unit};
use anyhow::{Result, ensure};
use serde_json::json;
use taxel_core::gesture::{Features, Model};

/// Touches observed for a time only.
#[derive(Debug, Clone)]
pub struct Times {
    /// What time is told in.
    pub unit: &'static str,
    /// Times, and how many frames each is; they ascend.
    pub steps: Vec<(f64, usize)>,
}

/// What was recognised, in the order of the touches.
#[derive(Debug, Clone, Default)]
struct Found {
    last: Vec<Outcome>,
    /// For each of the times.
    early: Vec<Vec<Outcome>>,
    /// What stretches in which nobody touches were taken for.
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
        let frames: Vec<usize> = times.steps.iter().map(|(_, frames)| *frames).collect();
        let touches: Vec<&Touch> = data.touches.iter().filter(|touch| of(touch)).collect();
        self.early.resize(frames.len(), Vec::new());
        for (touch, (last, early)) in touches.iter().zip(apply(model, data, &touches, &frames)?) {
            self.last.push((touch.class, last));
            self.early.iter_mut().zip(early).for_each(|(list, class)| list.push((touch.class, class)));
        }
        let idle: Vec<&Touch> = data.idle.iter().filter(|touch| of(touch)).collect();
        self.idle.extend(apply(model, data, &idle, &[])?.into_iter().map(|(last, _)| last));
        Ok(())
    }

    fn report(self, data: &Data, times: &Times) -> Report {
        let mut report = Report::new(&data.classes, self.last.clone());
        let steps = || times.steps.iter().map(|(time, _)| *time);
        let reached: Vec<f64> = self.early.iter().map(|list| accuracy(list)).collect();
        let over = steps().zip(&reached).map(|(time, share)| json!({ times.unit: time, "accuracy": share }));
        let first = steps().zip(&reached).find(|(_, share)| **share >= 0.9 * report.accuracy());
        report.add("over_time", over.collect());
        report.add(&format!("{}_to_90_percent_of_final", times.unit), json!(first.map(|(time, _)| time)));
        let onsets = data
            .classes
            .iter()
            .enumerate()
            .map(|(class, name)| (name.clone(), json!(self.onset(class, times))));
        report.add(&format!("median_onset_{}", times.unit), serde_json::Map::from_iter(onsets).into());
        let recall = |class: usize| {
            let own: Vec<Outcome> = self.last.iter().filter(|(was, _)| *was == class).copied().collect();
            accuracy(&own)
        };
        let recalls =
            data.classes.iter().enumerate().map(|(class, name)| (name.clone(), json!(recall(class))));
        report.add("recall", serde_json::Map::from_iter(recalls).into());
        if !self.idle.is_empty() {
            let count = |class: usize| self.idle.iter().filter(|taken| **taken == class).count();
            let counts =
                data.classes.iter().enumerate().map(|(class, name)| (name.clone(), json!(count(class))));
            report.add("idle_stretches_taken_for", serde_json::Map::from_iter(counts).into());
        }
        report
    }

    /// The median time from which touches of a class that are recognised at their end are taken for it without a break.
    fn onset(&self, class: usize, times: &Times) -> Option<f64> {
        let right = self.last.iter().enumerate().filter(|(_, outcome)| **outcome == (class, class));
        let since = right.map(|(touch, _)| {
            let wrong = self.early.iter().rposition(|list| list[touch].1 != class);
            let step = wrong.map_or(0, |step| step + 1).min(times.steps.len().saturating_sub(1));
            times.steps.get(step).map_or(0.0, |(time, _)| *time)
        });
        let mut since: Vec<f64> = since.collect();
        since.sort_by(f64::total_cmp);
        since.get(since.len() / 2).copied()
    }
}

/// Applies a model as it is.
pub fn as_it_is(model: &Model<'_>, data: &Data, times: &Times) -> Result<Report> {
    let mut found = Found::default();
    found.add(model, data, |_| true, times)?;
    Ok(found.report(data, times))
}

/// Trains on all groups but one and applies to that one, for each; beside it nearest neighbours and a cognitive map, which
/// know the same features.
pub fn cross(data: &Data, settings: &Settings, times: &Times) -> Result<Report> {
    let groups = data.groups();
    ensure!(groups.len() >= 2, "there is one group only: nothing can be kept apart");
    let courses = courses(data, settings);
    let (mut found, mut by_group) = (Found::default(), serde_json::Map::new());
    let (mut near, mut map) = (Vec::new(), Vec::new());
    let mut progress = Progress::of("learning", Unit::Steps("models"), Some(groups.len() as u64));
    for (done, group) in (0..).zip(&groups) {
        progress.at(done);
        let (apart, known): (Vec<usize>, Vec<usize>) =
            (0..data.touches.len()).partition(|i| data.touches[*i].group == *group);
        let examples: Vec<_> = known.iter().map(|i| (&courses[*i], data.touches[*i].class)).collect();
        let bytes = train(data, &examples, settings)?;
        let before = found.last.len();
        found.add(&Model::read(&bytes)?, data, |touch| touch.group == *group, times)?;
        let share = accuracy(&found.last[before..]);
        progress.clear();
        eprintln!("{group}: {:.1} % of {} touches", 100.0 * share, apart.len());
        by_group.insert(group.clone(), json!(share));
        let whole: Vec<(&Features, usize)> =
            examples.iter().map(|(course, class)| (&course.whole, *class)).collect();
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

/// Trains on the touches of the groups that are known and applies to another group.
pub(super) fn apart(
    data: &Data,
    courses: &[Course],
    settings: &Settings,
    known: &[&str],
    group: &str,
) -> Result<Vec<Outcome>> {
    let touches = || data.touches.iter().zip(courses);
    let examples: Vec<_> = touches()
        .filter(|(touch, _)| known.contains(&touch.group.as_str()))
        .map(|(touch, course)| (course, touch.class))
        .collect();
    let bytes = train(data, &examples, settings)?;
    let asked: Vec<&Touch> = data.touches.iter().filter(|touch| touch.group == group).collect();
    let taken = apply(&Model::read(&bytes)?, data, &asked, &[])?;
    Ok(asked.iter().zip(taken).map(|(touch, (last, _))| (touch.class, last)).collect())
}
