//! Reliability of the confidence of decisions, and the cost of waiting for it.

use super::apply::{Applied, Taken};
use serde_json::{Value, json};

/// Bins of the reliability table.
const BINS: usize = 10;

/// Confidences whose cost of waiting is reported.
const CERTAINTIES: [f64; 7] = [0.0, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9];

/// A prediction: its confidence, and whether it was right.
pub type Prediction = (f64, bool);

/// Reliability table: for each bin of confidence the number of predictions, their mean confidence and the
/// share of right ones. Also the expected calibration error: the mean difference of these two over the
/// predictions.
pub fn reliability(predictions: &[Prediction]) -> Value {
    let bin = |confidence: f64| ((confidence * BINS as f64) as usize).min(BINS - 1);
    let (mut bins, mut error) = (Vec::new(), 0.0);
    for index in 0..BINS {
        let own: Vec<Prediction> =
            predictions.iter().filter(|(confidence, _)| bin(*confidence) == index).copied().collect();
        if own.is_empty() {
            continue;
        }
        let count = own.len() as f64;
        let confidence = own.iter().map(|(confidence, _)| confidence).sum::<f64>() / count;
        let right = own.iter().filter(|(_, right)| *right).count() as f64 / count;
        error += count * (confidence - right).abs();
        let from = index as f64 / BINS as f64;
        bins.push(
            json!({ "from": from, "predictions": own.len(), "confidence": confidence, "right": right }),
        );
    }
    let count = predictions.len();
    json!({ "predictions": count, "expected_error": error / count.max(1) as f64, "bins": bins })
}

/// Returns for each confidence: the share of touches announced before their end, the median time until then (in
/// `unit`s; a frame is `frame`), and the shares of right answers among those announced and among all, where the rest
/// are decided at the end.
pub fn waits(touches: &[(usize, Applied)], unit: &str, frame: f64) -> Value {
    let row = |certainty: f64| {
        let sure = |(_, taken): &&(usize, Taken)| taken.confidence.is_some_and(|sure| sure >= certainty);
        let first = |applied: &Applied| applied.early.iter().find(sure).copied();
        let right = |was: &usize, taken: Taken| usize::from(taken.class == *was);
        let (mut times, mut announced, mut all) = (Vec::new(), 0, 0);
        for (was, applied) in touches {
            if let Some((frames, taken)) = first(applied) {
                times.push(frames);
                announced += right(was, taken);
            }
            all += right(was, first(applied).map_or(applied.last, |(_, taken)| taken));
        }
        times.sort_unstable();
        let share = |part: usize, whole: usize| part as f64 / whole.max(1) as f64;
        json!({
            "certainty": certainty,
            "announced": share(times.len(), touches.len()),
            unit: times.get(times.len() / 2).map(|frames| *frames as f64 * frame),
            "right": share(announced, times.len()),
            "right_of_all": share(all, touches.len()),
        })
    };
    CERTAINTIES.into_iter().map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_error_is_how_far_confidence_and_truth_are_apart() {
        // Of four at 0.9, three are right; of two at 0.5, one.
        let predictions: Vec<Prediction> =
            vec![(0.9, true), (0.9, true), (0.9, true), (0.9, false), (0.5, true), (0.5, false)];
        let table = reliability(&predictions);
        assert!((table["expected_error"].as_f64().unwrap() - 0.15 * 4.0 / 6.0).abs() < 1e-9, "{table}");
        assert_eq!((&table["bins"][1]["predictions"], &table["bins"][1]["right"]), (&json!(4), &json!(0.75)));
        assert_eq!(reliability(&[(1.0, true)])["bins"][0]["from"], json!(0.9));
    }

    #[test]
    fn who_waits_for_certainty_is_answered_later_and_righter() {
        let taken = |class, confidence| Taken { class, confidence: Some(confidence) };
        let applied = Applied {
            last: taken(1, 0.95),
            frames: 30,
            early: vec![(5, taken(0, 0.45)), (10, taken(1, 0.65))],
        };
        let table = waits(&[(1, applied)], "seconds", 0.1);
        assert_eq!((&table[0]["seconds"], &table[0]["right"]), (&json!(0.5), &json!(0.0)));
        assert_eq!((&table[3]["seconds"], &table[3]["right"]), (&json!(1.0), &json!(1.0)));
        let late = &table[6];
        assert_eq!((&late["announced"], &late["right_of_all"]), (&json!(0.0), &json!(1.0)));
        assert!(late["seconds"].is_null());
    }
}
