//! Kernels apart from the chain: reading alone, the plain chain, and number formats, with their errors
//! against f64.

use super::case::Step;
use super::error::Error;
use super::row::Cost;
use serde_json::{Value, json};
use std::f64::consts::PI;
use taxel_core::fold::FOLDED;
use taxel_core::format::Code;
use taxel_suite::activation::{Activation, CONCEPTS, Maps};
use taxel_suite::chain::TAXELS;
use taxel_suite::copies::PAIRS;
use taxel_suite::kernel::Kernel;
use taxel_suite::measure::Measure;
use taxel_suite::pattern::TouchPattern;
use taxel_suite::windows::{self, AREA, SIDE, WINDOWS};

/// Measured rounds of windows or states.
const MEASURED: u32 = 4;
const COMPARED: u32 = 250;

/// Name of the row of a whole inference.
pub const INFERENCE: &str = "map, to its end";

/// Name of the rows that subtract what folds press, by taxel that folds.
pub const SUBTRACTION: &str = "folds, subtract";

/// One kernel on one kind of input.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Form {
    /// Operation.
    pub what: &'static str,
    /// Scene or format.
    pub form: &'static str,
    kernel: Kernel,
    pattern: Option<TouchPattern>,
}

impl Form {
    /// All kernels.
    pub fn all() -> Vec<Form> {
        let of = |what, pattern: TouchPattern, kernel| Form {
            what,
            form: pattern.name(),
            kernel,
            pattern: Some(pattern),
        };
        let scenes = [TouchPattern::Empty, TouchPattern::Five, TouchPattern::Texture];
        let mut all = vec![
            of("read each code", TouchPattern::Five, Kernel::Read),
            of("read and compare", TouchPattern::Five, Kernel::Compare),
        ];
        all.extend(scenes.map(|pattern| of("dense chain", pattern, Kernel::Dense)));
        all.extend(Measure::ALL.map(|measure| Form {
            what: "measure",
            form: measure.name(),
            kernel: Kernel::Measure(measure),
            pattern: None,
        }));
        all.extend(Activation::ALL.map(|activation| Form {
            what: "map, one step",
            form: activation.name(),
            kernel: Kernel::Activate(activation),
            pattern: None,
        }));
        all.push(of("gestures, a frame", TouchPattern::Five, Kernel::Touch));
        all.push(of("gestures, a decision", TouchPattern::Five, Kernel::Decide));
        let others = [
            ("shape, description", "16 x 16", Kernel::Describe),
            ("shape, nearest", "of 200", Kernel::Nearest),
            ("copy, 64 bytes", "to all places", Kernel::Copy),
        ];
        all.extend(others.map(|(what, form, kernel)| Form { what, form, kernel, pattern: None }));
        all.push(Form { what: INFERENCE, form: "Q15", kernel: Kernel::Infer, pattern: None });
        all.extend([("all that is felt", false), ("beyond levels", true)].map(|(form, beyond_levels)| {
            Form {
                what: SUBTRACTION,
                form,
                kernel: Kernel::Subtract { beyond_levels },
                // Each taxel presses.
                pattern: Some(TouchPattern::Texture),
            }
        }));
        all
    }

    /// Inputs in order.
    pub fn steps(&self) -> Vec<Step> {
        let codes = |round| {
            let mut codes = [Code(0); TAXELS];
            match self.pattern {
                Some(pattern) => pattern.codes(round, &mut codes),
                None => windows::fill(round, &mut codes),
            }
            Step::Kernel(self.kernel, Box::new(codes))
        };
        (1..=MEASURED).map(codes).collect()
    }

    /// Row from the costs of the steps, per frame, contact, step of the map, copy or taxel that folds.
    pub fn row(self, costs: &[Cost]) -> FormRow {
        let each = match self.kernel {
            Kernel::Measure(_) | Kernel::Describe => WINDOWS,
            Kernel::Copy => PAIRS,
            Kernel::Subtract { .. } => FOLDED,
            _ => 1,
        };
        let sum: u64 = costs.iter().flat_map(|cost| cost.stages).sum();
        FormRow {
            form: self,
            cost: sum / (costs.len().max(1) * each) as u64,
            stack: costs.iter().filter_map(|cost| cost.stack).max(),
            errors: match self.kernel {
                Kernel::Measure(measure) => measured(measure),
                Kernel::Activate(activation) => activated(activation),
                _ => Vec::new(),
            },
        }
    }
}

/// Cost and errors of a kernel.
#[derive(Debug, Clone)]
pub struct FormRow {
    /// The kernel.
    pub form: Form,
    /// Cost per frame, contact, step, copy or taxel that folds.
    pub cost: u64,
    /// Bytes of stack.
    pub stack: Option<u64>,
    /// Errors by quantity and unit.
    pub errors: Vec<(&'static str, Error)>,
}

impl FormRow {
    /// JSON form.
    pub fn json(&self) -> Value {
        let errors = self.errors.iter().map(|(what, error)| (what.to_string(), error.json()));
        json!({
            "what": self.form.what,
            "form": self.form.form,
            "cost": self.cost,
            "stack_bytes": self.stack,
            "errors": errors.collect::<serde_json::Map<String, Value>>(),
        })
    }
}

/// Errors of centroid, NMI and azimuth over many windows.
fn measured(measure: Measure) -> Vec<(&'static str, Error)> {
    let mut errors = [Error::default(); 3];
    let mut codes = [Code(0); TAXELS];
    for round in 1..=COMPARED {
        windows::fill(round, &mut codes);
        for window in codes.chunks(AREA) {
            let exact = exact(window);
            let found = measure.values(measure.of(window));
            errors[0].add((found[0] - exact[0]).hypot(found[1] - exact[1]));
            errors[1].add(found[2] / exact[2] - 1.0);
            // An axis has no direction.
            let turn = (found[3] - exact[3]).rem_euclid(PI);
            errors[2].add(turn.min(PI - turn));
        }
    }
    ["centroid_taxel", "nmi_relative", "azimuth_rad"].into_iter().zip(errors).collect()
}

/// Column, row, NMI, azimuth from the definition: integers, then f64.
fn exact(window: &[Code]) -> [f64; 4] {
    let [mut m, mut sx, mut sy, mut sxx, mut syy, mut sxy] = [0i64; 6];
    for (taxel, code) in window.iter().enumerate() {
        let (x, y, f) = ((taxel % SIDE) as i64, (taxel / SIDE) as i64, i64::from(code.0));
        (m, sx, sy) = (m + f, sx + x * f, sy + y * f);
        (sxx, syy, sxy) = (sxx + x * x * f, syy + y * y * f, sxy + x * y * f);
    }
    let (a, b, c) = (m * sxx - sx * sx, m * syy - sy * sy, m * sxy - sx * sy);
    let mass = m as f64;
    let azimuth = 0.5 * (2.0 * c as f64).atan2((a - b) as f64);
    [sx as f64 / mass, sy as f64 / mass, ((a + b) as f64 / mass).sqrt() / mass, azimuth]
}

/// Errors of one step of the map from many states.
fn activated(activation: Activation) -> Vec<(&'static str, Error)> {
    let maps = Maps::shipped().expect("what ships is a map");
    let (weights, lambda) = maps.plain();
    let mut error = Error::default();
    let mut random = fastrand::Rng::with_seed(1);
    for _ in 0..COMPARED * WINDOWS as u32 {
        let state: [i32; CONCEPTS] = std::array::from_fn(|_| random.i32(-32768..=32768));
        let next = activation.step(&maps, &state);
        for (raw, weights) in next.iter().zip(weights).filter(|(_, w)| w.iter().any(|w| *w != 0.0)) {
            // The weights are hundredths, whatever their f32 value.
            let hundredths = weights.iter().map(|w| (f64::from(*w) * 100.0).round() / 100.0);
            let sum: f64 = hundredths.zip(&state).map(|(w, y)| w * f64::from(*y) / 32768.0).sum();
            error.add(activation.value(*raw) - (f64::from(lambda) * sum.max(0.0)).tanh());
        }
    }
    vec![("activation", error)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Centroid (taxels), NMI (relative), azimuth (rad): the largest errors, rounded up.
    #[test]
    fn each_format_is_as_far_off_as_the_table_says() {
        let bounds = [
            // Half a step of 2^-16 along each axis; half a step of 2^-24 of an NMI from 0.008; the core's
            // bound.
            (Measure::Exact, [1.1e-5, 4e-6, 1.3e-6]),
            (Measure::Q15, [4.5e-3, 2.1e-3, 4.5e-3]),
            (Measure::SumsMicromath, [7e-7, 0.062, 1.5e-3]),
            (Measure::SumsLibm, [7e-7, 1.6e-7, 1.4e-7]),
            (Measure::Micromath, [7e-7, 0.062, 1.5e-3]),
            (Measure::Libm, [7e-7, 2e-6, 6e-6]),
        ];
        for (measure, bounds) in bounds {
            for ((what, error), bound) in measured(measure).iter().zip(bounds) {
                let largest = error.largest;
                assert!(largest <= bound && error.rms() > 0.0, "{measure:?}, {what}: {largest:e}");
            }
        }
        for (activation, bound) in
            [(Activation::Q15, 3e-5), (Activation::Micromath, 1.2e-3), (Activation::Libm, 8e-7)]
        {
            let error = activated(activation)[0].1;
            assert!(error.largest <= bound && error.rms() > 0.0, "{activation:?}: {:e}", error.largest);
        }
    }
}
