//! Result of a run of a map, in f64 and in the arithmetic of the board, as JSON.

use super::engine::Trajectory;
use crate::error::Result;
use serde_json::{Value, json};
use taxel_core::intent::Outcome;

/// `{"f64": ..., "q15": ...}`; if the core refuses the map, `q15` is null and `q15_error` is the reason.
pub fn report(float: &Trajectory, fixed: &Result<Trajectory>) -> Value {
    match fixed {
        Ok(fixed) => json!({ "f64": trajectory(float), "q15": trajectory(fixed) }),
        Err(error) => json!({ "f64": trajectory(float), "q15": null, "q15_error": error.to_string() }),
    }
}

fn trajectory(t: &Trajectory) -> Value {
    let (outcome, period) = match t.outcome {
        Outcome::Fixed => ("fixed", 1),
        Outcome::Cycle(period) => ("cycle", period),
        Outcome::Unsettled => ("unsettled", 0),
    };
    json!({ "trajectory": t.states, "final": t.last(), "steps": t.steps, "outcome": outcome, "period": period })
}
