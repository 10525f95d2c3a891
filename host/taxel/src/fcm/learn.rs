//! Improves weights by labelled touches, within the limits set by the expert.

use super::map::MapFile;
use super::search::{Verdict, judge, search};
use super::touches::Touches;
use crate::error::{MapFileError, Result};
use serde_json::{Value, json};

/// Result of learning.
#[derive(Debug, Clone)]
pub struct Learned {
    /// Map with its new weights.
    pub map: MapFile,
    /// Judgement of the expert's map on all touches.
    pub before: Verdict,
    /// Judgement of each touch by a map that was learnt without its fold.
    pub cross: Verdict,
    /// Judgement of the new map on its training touches.
    pub after: Verdict,
}

/// Learns from all touches, and cross-validates.
pub fn learn(file: &MapFile, touches: &Touches, folds: usize) -> Result<Learned> {
    let classes = &touches.classes;
    let part = touches.folds(folds);
    let mut cross = Verdict { confusion: vec![vec![0; classes.len()]; classes.len()], loss: 0.0 };
    for fold in 0..folds {
        let left_out =
            touches.touches.iter().zip(&part).filter(|(_, own)| **own == fold).map(|(touch, _)| touch);
        let count = left_out.clone().count();
        if count == touches.touches.len() {
            fail!(MapFileError::Unanswerable, "all touches are in one fold: nothing is left to learn from");
        }
        if count > 0 {
            let map = search(file, touches, |at| part[at] != fold)?;
            let judged = judge(&map, classes, left_out)?;
            cross.loss += judged.loss * count as f64 / touches.touches.len() as f64;
            for (all, own) in cross.confusion.iter_mut().flatten().zip(judged.confusion.iter().flatten()) {
                *all += own;
            }
        }
    }
    let map = search(file, touches, |_| true)?;
    let (before, after) = (judge(file, classes, &touches.touches)?, judge(&map, classes, &touches.touches)?);
    Ok(Learned { map, before, cross, after })
}

/// Edges with a changed weight: cause, effect, before, after.
pub fn changed<'a>(
    file: &'a MapFile,
    map: &'a MapFile,
) -> impl Iterator<Item = (&'a str, &'a str, f64, f64)> {
    let pairs = file.edge.iter().zip(&map.edge).filter(|(before, after)| before.weight != after.weight);
    pairs.map(|(before, after)| (&*before.from, &*before.to, before.weight.value(), after.weight.value()))
}

/// `{"touches", "classes", "before", "cross", "after", "changed"}`; the three judgements have `accuracy`,
/// `loss` and `confusion`.
pub fn report(file: &MapFile, touches: &Touches, learned: &Learned) -> Value {
    let judged = |j: &Verdict| json!({ "accuracy": j.accuracy(), "loss": j.loss, "confusion": j.confusion });
    let edge =
        |(from, to, before, after)| json!({ "from": from, "to": to, "before": before, "after": after });
    json!({
        "touches": touches.touches.len(), "classes": touches.classes, "accuracy": learned.cross.accuracy(),
        "confusion": learned.cross.confusion, "before": judged(&learned.before), "cross": judged(&learned.cross),
        "after": judged(&learned.after), "changed": changed(file, &learned.map).map(edge).collect::<Value>(),
    })
}

/// Readable form.
pub fn text(file: &MapFile, touches: &Touches, learned: &Learned) -> String {
    let share = |judged: &Verdict| format!("{:.1} %", 100.0 * judged.accuracy());
    let mut text = format!(
        "{} touches; right before: {}; on touches left out while learning: {}; on those learned from: {}\n",
        touches.touches.len(),
        share(&learned.before),
        share(&learned.cross),
        share(&learned.after)
    );
    text += "left out (a row for each label, a column for each answer):\n";
    for (class, row) in touches.classes.iter().zip(&learned.cross.confusion) {
        text += &format!("  {class:<16} {}\n", row.iter().map(|n| format!("{n:>5}")).collect::<String>());
    }
    for (from, to, before, after) in changed(file, &learned.map) {
        text += &format!("  {from} -> {to}: {before} becomes {after}\n");
    }
    text
}
