//! Nested cross-validation: settings are chosen without the touches that they are tested on.

use super::compare::apart;
use super::course::courses;
use super::data::Data;
use super::report::{Outcome, Report, accuracy};
use super::settings::TrainSettings;
use anyhow::{Result, anyhow, ensure};
use serde_json::json;
use taxel::text::progress::{Progress, Unit};

/// Chooses for each group the settings that perform best in cross-validation on the other groups, trains with them on
/// all the others, and applies to the group.
pub fn nested(data: &Data, candidates: &[TrainSettings]) -> Result<Report> {
    let groups = data.groups();
    ensure!(groups.len() >= 3, "nested selection takes three groups or more, there are {}", groups.len());
    let same = |a: &TrainSettings, b: &TrainSettings| {
        (a.pressed, a.halves, a.mirrored) == (b.pressed, b.halves, b.mirrored)
    };
    let first = candidates.first();
    let first = first.ok_or_else(|| anyhow!("there are no settings to choose from"))?;
    ensure!(
        candidates.iter().all(|other| same(first, other)),
        "settings differ in the training data of a touch"
    );
    let courses = courses(data, first);
    let (mut found, mut chosen) = (Vec::new(), serde_json::Map::new());
    let steps = groups.len() * (candidates.len() * (groups.len() - 1) + 1);
    let mut progress = Progress::of("learning", Unit::Steps("models"), Some(steps as u64));
    let mut done = 0;
    for group in &groups {
        let others: Vec<&str> = groups.iter().filter(|other| *other != group).map(String::as_str).collect();
        let mut best: Option<(f64, usize)> = None;
        for (number, settings) in candidates.iter().enumerate() {
            let mut inner: Vec<Outcome> = Vec::new();
            for test in &others {
                let known: Vec<&str> = others.iter().filter(|other| *other != test).copied().collect();
                inner.extend(apart(data, &courses, settings, &known, test)?);
                done += 1;
                progress.at(done);
            }
            let share = accuracy(&inner);
            if best.is_none_or(|(before, _)| share > before) {
                best = Some((share, number));
            }
        }
        let (share, number) = best.unwrap_or_default();
        let own = apart(data, &courses, &candidates[number], &others, group)?;
        done += 1;
        progress.clear();
        eprintln!(
            "{group}: {:.1} % of {} touches; the others {:.1} %",
            100.0 * accuracy(&own),
            own.len(),
            100.0 * share
        );
        chosen.insert(group.clone(), json!(candidates[number]));
        found.extend(own);
    }
    let mut report = Report::new(&data.classes, found);
    report.add("candidates", candidates.len().into());
    report.add("chosen", chosen.into());
    Ok(report)
}
