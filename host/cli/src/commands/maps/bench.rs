//! `taxel fcm bench`: times one inference against other programs, all in one run.

use anyhow::Result;
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::hint::black_box;
use std::process::{Command, Stdio};
use std::time::Instant;
use taxel::fcm::board::BoardMap;
use taxel::fcm::decimal::Decimal;
use taxel::fcm::engine::{Problem, Settings};
use taxel::fcm::load;
use taxel::fcm::map::EdgeFile;
use taxel::fcm::weight::Weight;
use taxel_core::intent::{MapConfig, Rule, Transfer};

/// Arguments of `taxel fcm bench`.
#[derive(Debug, Clone, clap::Args)]
pub struct BenchArgs {
    /// Print JSON instead of a table
    #[arg(long)]
    pub json: bool,
}

/// Inferences per timing, and number of timings, whose median is reported.
const REPEATED: u32 = 2000;
const ROUNDS: usize = 31;
/// An inference ends once no activation moves by more than this.
const STILL: f64 = 1e-3;
/// Tolerated difference between the results of two programs.
const EQUAL: f64 = 5e-3;
/// Initial activations.
const START: [(&str, &str); 4] = [("press", "0.8"), ("shape", "0.2"), ("location", "0.5"), ("time", "0.1")];

/// Runs the command.
pub fn run(args: BenchArgs) -> Result<()> {
    let rows = rows()?;
    if args.json {
        println!("{}", json!({ "unit": "us per inference", "rows": rows }));
    } else {
        print!("{}", table(&rows));
    }
    Ok(())
}

/// One row for each program: `program`, `us` (null if not installed), `equal`.
fn rows() -> Result<Vec<Value>> {
    let mut file = load::map("tactile")?;
    (file.transfer, file.lambda) = (Transfer::Sigmoid, 1.0);
    // Not all programs can hold a concept's value: here each concept has a cause.
    file.input.clear();
    for (entry, _) in START {
        let (from, to, weight) = ("politeness".into(), entry.into(), Weight::Number(0.1));
        file.edge.push(EdgeFile { from, to, weight, fixed: false, note: String::new() });
    }
    let start: Vec<(String, Decimal)> =
        START.iter().filter_map(|(name, value)| Some((name.to_string(), Decimal::parse(value)?))).collect();
    let (problem, settings) = file.problem(&start)?;
    let dense = Dense::new(&problem, &settings);
    let end = dense.settle();
    let equal = |other: &[f64]| {
        other.len() == end.len() && other.iter().zip(&end).all(|(a, b)| (a - b).abs() < EQUAL)
    };
    let row = |program: &str, us: Option<f64>, end: &[f64]| json!({ "program": program, "us": us, "equal": us.map(|_| equal(end)) });
    let mut rows = vec![row("taxel, f64", Some(time(|| _ = black_box(black_box(&dense).settle()))), &end)];
    let config: MapConfig = *file.to_config()?;
    let map = taxel_core::intent::Map::<{ taxel_core::intent::CONCEPTS }>::build(&config)?;
    let board = BoardMap::build(&file)?;
    let mut first = [0; taxel_core::intent::CONCEPTS];
    let numbered = start.iter().filter_map(|(name, value)| Some((file.find(name)?, *value)));
    first.iter_mut().zip(board.state(numbered)).for_each(|(slot, value)| *slot = value);
    let last = map.infer(&first, 100).state;
    let last: Vec<f64> = last.iter().take(map.len()).map(|x| board.value(*x)).collect();
    rows.push(row(
        "taxel, as the board (Q15, to its end)",
        Some(time(|| _ = black_box(map.infer(black_box(&first), 100)))),
        &last,
    ));
    for (program, script) in [("numpy", NUMPY), ("py-fcm", PY_FCM), ("fcmpy", FCMPY)] {
        let (us, end) = python(script, &problem).map_or((None, Vec::new()), |(us, end)| (Some(us), end));
        rows.push(row(program, us, &end));
    }
    Ok(rows)
}

fn table(rows: &[Value]) -> String {
    let mut text = String::from("one inference of ten concepts, sigmoid, to 1e-3, one thread\n");
    for row in rows {
        let program = row["program"].as_str().unwrap_or_default();
        let _ = match (row["us"].as_f64(), row["equal"].as_bool()) {
            (Some(us), Some(true)) => writeln!(text, "{program:<40} {us:>10.2} us"),
            (Some(us), _) => writeln!(text, "{program:<40} {us:>10.2} us (void: another result)"),
            (None, _) => writeln!(text, "{program:<40} {:>10}", "not installed"),
        };
    }
    text
}

/// A map as a dense matrix by effect and cause, in f64.
struct Dense {
    n: usize,
    weights: Vec<f64>,
    held: Vec<bool>,
    start: Vec<f64>,
    own: f64,
    lambda: f64,
}

impl Dense {
    fn new(problem: &Problem, settings: &Settings) -> Dense {
        let n = problem.names.len();
        let weights: Vec<f64> = (0..n * n).map(|at| problem.weights[at % n][at / n].to_f64()).collect();
        Dense {
            n,
            held: weights.chunks(n).map(|row| row.iter().all(|w| *w == 0.0)).collect(),
            weights,
            start: problem.start.iter().map(|value| value.to_f64()).collect(),
            own: if settings.rule == Rule::Kosko { 0.0 } else { 1.0 },
            lambda: settings.lambda,
        }
    }

    /// Infers with rule kosko or mkosko, sigmoid.
    fn settle(&self) -> Vec<f64> {
        let mut x = self.start.clone();
        let mut next = x.clone();
        for _ in 0..1000 {
            let mut moved = 0.0f64;
            for (j, row) in self.weights.chunks(self.n).enumerate().filter(|(j, _)| !self.held[*j]) {
                let z = row.iter().zip(&x).map(|(w, x)| w * x).sum::<f64>() + self.own * x[j];
                next[j] = 1.0 / (1.0 + (-self.lambda * z).exp());
                moved = moved.max((next[j] - x[j]).abs());
            }
            std::mem::swap(&mut x, &mut next);
            if moved <= STILL {
                break;
            }
        }
        x
    }
}

/// Median duration of a call, us.
fn time(mut call: impl FnMut()) -> f64 {
    let mut times = [0.0; ROUNDS];
    for time in &mut times {
        let start = Instant::now();
        (0..REPEATED).for_each(|_| call());
        *time = start.elapsed().as_secs_f64() * 1e6 / f64::from(REPEATED);
    }
    times.sort_unstable_by(f64::total_cmp);
    times[ROUNDS / 2]
}

/// Median duration, us, and result of a Python program; none if it does not run. `W`, `x0`, `names` and
/// `median` are defined for it.
fn python(script: &str, problem: &Problem) -> Option<(f64, Vec<f64>)> {
    let numbers: Vec<Vec<f64>> =
        problem.weights.iter().map(|row| row.iter().map(|w| w.to_f64()).collect()).collect();
    let start: Vec<f64> = problem.start.iter().map(|value| value.to_f64()).collect();
    let given = json!({ "W": numbers, "x0": start, "names": problem.names });
    let text = format!("import json\ngiven = json.loads('''{given}''')\n{COMMON}{script}");
    let output = Command::new("python3")
        .args(["-c", &text])
        .stdin(Stdio::null())
        .stderr(Stdio::null())
        .output()
        .ok()?;
    let answer: Value =
        serde_json::from_slice(output.stdout.split(|b| *b == b'\n').rfind(|line| !line.is_empty())?).ok()?;
    let end = answer["end"].as_array()?.iter().filter_map(Value::as_f64).collect();
    Some((answer["us"].as_f64()?, end))
}

/// Beginning of every Python program.
const COMMON: &str = "
import time
W, x0, names = given['W'], given['x0'], given['names']
def tell(infer, repeated):
    times = []
    for _ in range(9):
        start = time.perf_counter()
        for _ in range(repeated): end = infer()
        times.append((time.perf_counter() - start) * 1e6 / repeated)
    print(json.dumps({'us': sorted(times)[4], 'end': [float(x) for x in end]}))
";

const NUMPY: &str = "
import numpy as np
W, x0 = np.array(W), np.array(x0)
driven = (W != 0).any(axis=0)
def infer():
    x = x0
    while True:
        new = np.where(driven, 1 / (1 + np.exp(-(x @ W))), x)
        if np.abs(new - x).max() <= 1e-3: return new
        x = new
tell(infer, 200)
";

const PY_FCM: &str = "
from py_fcm import FuzzyCognitiveMap
fcm = FuzzyCognitiveMap(max_it=100, stability_diff=1e-3, extra_steps=2, mem_influence=False, decision_function='LAST',
                        activation_function='sigmoid', lambda_val=1)
for name in names: fcm.add_concept(name)
for i, row in enumerate(W):
    for j, w in enumerate(row):
        if w: fcm.add_relation(names[i], names[j], w)
def infer():
    for name, x in zip(names, x0): fcm.init_concept(name, x)
    fcm.run_inference()
    end = fcm.get_final_state(names=names)
    return [end[name] for name in names]
tell(infer, 50)
";

const FCMPY: &str = "
import pandas as pd
from fcmpy import FcmSimulator
sim = FcmSimulator()
frame = pd.DataFrame(W, index=names, columns=names)
def infer():
    states = sim.simulate(initial_state=dict(zip(names, x0)), weight_matrix=frame, transfer='sigmoid', inference='kosko',
                          thresh=0.001, iterations=100, output_concepts=None, l=1)
    return states.iloc[-1]
tell(infer, 5)
";
