//! Fuzzy cognitive maps against exact trajectories of published and generated maps
//! (tests/reference/fcm_*.json: 50 digits, fractions for thresholds), for the f64 engine, the exact one and
//! the core's integers.

use serde_json::Value;
use taxel::fcm::decimal::Decimal;
use taxel::fcm::engine::{self, Problem, Settings};
use taxel::fcm::json::parse;
use taxel_core::intent::{Outcome, Rule, Transfer};

struct Case {
    label: String,
    settings: Settings,
    outcome: String,
    steps: usize,
    first: Vec<Vec<f64>>,
    last: Vec<f64>,
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|v| v.as_str().unwrap().parse().unwrap()).collect()
}

fn settings(case: &Value) -> Settings {
    let rule = match case["rule"].as_str().unwrap() {
        "kosko" => Rule::Kosko,
        "mKosko" => Rule::Mkosko,
        "rescaled" => Rule::Rescaled,
        other => panic!("{other}"),
    };
    let transfer = match case["transfer"].as_str().unwrap() {
        "bivalent" => Transfer::Bivalent,
        "trivalent" => Transfer::Trivalent,
        "sigmoid" => Transfer::Sigmoid,
        "tanh" => Transfer::Tanh,
        other => panic!("{other}"),
    };
    let lambda = case["lambda_"].as_f64().unwrap();
    Settings {
        rule,
        transfer,
        lambda,
        threshold: Decimal::default(),
        held: case["inputs_held"].as_bool().unwrap(),
    }
}

fn reference(name: &str) -> (Problem, Vec<Case>) {
    let path = format!("{}/../../tests/reference/fcm_{name}.json", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).unwrap();
    let json: Value = serde_json::from_str(&text).unwrap();
    let cases = json["cases"].as_array().unwrap().iter().map(|case| {
        let settings = settings(case);
        let held = if settings.held { "held" } else { "free" };
        Case {
            label: format!("{name} {:?} {:?} {} {held}", settings.rule, settings.transfer, settings.lambda),
            settings,
            outcome: case["outcome"].as_str().unwrap().into(),
            steps: case["steps"].as_u64().unwrap() as usize,
            first: case["trajectory_first8"].as_array().unwrap().iter().map(numbers).collect(),
            last: numbers(&case["final"]),
        }
    });
    (parse(&text).unwrap(), cases.collect())
}

const MAPS: [&str; 3] = ["fcmpy8", "heat8", "tactile10"];

fn all() -> impl Iterator<Item = (Problem, Case)> {
    MAPS.into_iter().flat_map(|name| {
        let (problem, cases) = reference(name);
        cases.into_iter().map(move |case| (problem.clone(), case))
    })
}

fn apart(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn f64_agrees_within_1e_12() {
    for (problem, case) in all() {
        let run = engine::run(&problem, &case.settings, 1500);
        for (at, (state, exact)) in run.states.iter().zip(&case.first).enumerate() {
            assert!(apart(state, exact) < 1e-12, "{} state {at}", case.label);
        }
        if case.outcome == "fixed" {
            assert!(apart(run.last(), &case.last) < 1e-12, "{} final", case.label);
            assert_eq!(run.outcome, Outcome::Fixed, "{}", case.label);
        }
    }
}

#[test]
fn the_limit_cycle_of_fcmpy8_is_found_by_both_engines() {
    let (problem, case) = all().find(|(_, case)| case.outcome == "cycle").unwrap();
    let float = engine::run(&problem, &case.settings, 1500);
    assert_eq!(float.outcome, Outcome::Cycle(2));
    assert!(apart(float.last(), &case.last) < 1e-12);
    let fixed = engine::q15(&problem, &case.settings, 1500).unwrap();
    assert_eq!(fixed.outcome, Outcome::Cycle(2));
    let distance = apart(fixed.last(), &case.last).min(apart(&fixed.states[1499], &case.last));
    assert!(distance < 1e-3, "{distance}");
}

#[test]
fn threshold_maps_agree_exactly_with_steps_and_outcome() {
    let mut count = 0;
    for (problem, case) in all().filter(|(_, case)| case.settings.transfer.is_threshold()) {
        for run in [
            engine::run(&problem, &case.settings, case.steps),
            engine::q15(&problem, &case.settings, case.steps).unwrap(),
        ] {
            assert_eq!(run.states, case.first, "{}", case.label);
            assert_eq!(run.last(), case.last, "{}", case.label);
            assert_eq!((run.steps, run.outcome), (case.steps, Outcome::Fixed), "{}", case.label);
        }
        count += 1;
    }
    assert_eq!(count, 24);
}

#[test]
fn the_core_reaches_the_same_fixed_points() {
    let mut worst = [(0.0, String::new()), (0.0, String::new())];
    for (problem, case) in all().filter(|(_, c)| !c.settings.transfer.is_threshold() && c.outcome == "fixed")
    {
        let run = engine::q15(&problem, &case.settings, 1500).unwrap();
        assert_eq!(run.outcome, Outcome::Fixed, "{}", case.label);
        // The whole tail, because a fixed point may be a small cycle (`ROUNDING`).
        let tail = &run.states[1400..];
        let extent = tail.iter().map(|state| apart(state, run.last()) * 32768.0).fold(0.0, f64::max);
        assert!(extent <= 8.0, "{}: wobbles by {extent}", case.label);
        let error = tail.iter().map(|state| apart(state, &case.last)).fold(0.0, f64::max);
        println!("{:48} {error:.2e} after {} steps", case.label, run.steps);
        let slot = &mut worst[usize::from(case.settings.transfer == Transfer::Tanh)];
        if error > slot.0 {
            *slot = (error, case.label);
        }
    }
    println!("sigmoid {:.2e} {}\ntanh {:.2e} {}", worst[0].0, worst[0].1, worst[1].0, worst[1].1);
    assert!(worst[0].0 < 7e-5 && worst[1].0 < 1.3e-4, "{worst:?}");
}

#[test]
fn the_core_follows_the_first_states() {
    let mut worst = [0.0f64; 2];
    for (problem, case) in all().filter(|(_, case)| !case.settings.transfer.is_threshold()) {
        let run = engine::q15(&problem, &case.settings, 8).unwrap();
        for (state, exact) in run.states.iter().zip(&case.first) {
            let slot = &mut worst[usize::from(case.settings.transfer == Transfer::Tanh)];
            *slot = slot.max(apart(state, exact));
        }
    }
    println!("first 8 states: sigmoid {:.2e}, tanh {:.2e}", worst[0], worst[1]);
    assert!(worst[0] < 2.1e-4 && worst[1] < 4e-4, "{worst:?}");
}

/// Rounding errors of steps accumulate until the map settles: the core is further off during the trajectory
/// than at its end.
#[test]
fn the_core_follows_the_whole_trajectory() {
    let mut worst = [(0.0, String::new()), (0.0, String::new())];
    for (problem, case) in all().filter(|(_, c)| !c.settings.transfer.is_threshold() && c.outcome == "fixed")
    {
        // Within 1e-12 of the reference wherever that has a state.
        let exact = engine::run(&problem, &case.settings, 1500);
        let run = engine::q15(&problem, &case.settings, 1500).unwrap();
        let errors = run.states.iter().zip(&exact.states).map(|(state, exact)| apart(state, exact));
        let (at, error) = errors.enumerate().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
        let slot = &mut worst[usize::from(case.settings.transfer == Transfer::Tanh)];
        if error > slot.0 {
            *slot = (error, format!("{} state {at}", case.label));
        }
    }
    println!("whole trajectory: sigmoid {:.2e} {}", worst[0].0, worst[0].1);
    println!("whole trajectory: tanh {:.2e} {}", worst[1].0, worst[1].1);
    assert!(worst[0].0 < 8e-4 && worst[1].0 < 2.5e-4, "{worst:?}");
}

/// A map with ever slower convergence stops in the core as soon as its steps are below half of 2^-15: `Fixed`
/// says that the state reproduces itself, not that it is near the limit.
#[test]
fn a_creeping_map_rests_before_its_limit() {
    let mut reported = Vec::new();
    for (problem, case) in all().filter(|(_, case)| case.outcome.starts_with("slow")) {
        let run = engine::q15(&problem, &case.settings, 1500).unwrap();
        let far = engine::run(&problem, &case.settings, 100_000);
        let [same, limit] = [&case.last, far.states.last().unwrap()].map(|state| apart(run.last(), state));
        println!(
            "creeping: {:36} {:?} after {} steps; {same:.1e} off the exact state then, {limit:.1e} off that after 100,000",
            case.label, run.outcome, run.steps
        );
        assert_eq!(run.outcome, Outcome::Fixed, "{}", case.label);
        reported.push((case.settings.transfer, same, limit));
    }
    assert_eq!(reported.len(), 3);
    for (transfer, same, limit) in reported {
        if transfer == Transfer::Tanh {
            assert!((1.1e-2..1.3e-2).contains(&same) && (0.2..0.24).contains(&limit), "{same} {limit}");
        } else {
            assert!(same < 5e-4 && limit < 5e-4, "{same} {limit}");
        }
    }
}

/// `infer`, which remembers one state, and the host, which remembers all, have the same result.
#[test]
fn the_core_ends_where_its_trajectory_does() {
    for (problem, case) in all() {
        let map = engine::core_map(&problem, &case.settings).unwrap();
        let mut start = [0; engine::Q15_CONCEPTS];
        for (out, value) in start.iter_mut().zip(&problem.start) {
            *out = value.scaled(map.one().into()) as i32;
        }
        let run = engine::q15(&problem, &case.settings, 4000).unwrap();
        let inference = map.infer(&start, 4000);
        assert_eq!(inference.outcome, run.outcome, "{}", case.label);
        let steps = usize::from(inference.steps);
        assert!(steps >= run.steps && steps <= 4 * run.steps, "{}: {steps} {}", case.label, run.steps);
        if run.steps > 0 && run.states[run.steps] == run.states[run.steps - 1] {
            assert_eq!(steps, run.steps, "{}", case.label);
        }
        let state: Vec<f64> =
            inference.state[..map.len()].iter().map(|v| f64::from(*v) / f64::from(map.one())).collect();
        assert!(run.states.contains(&state), "{}", case.label);
    }
}

fn tie(weights: [&str; 3], start: [&str; 3], rule: Rule, transfer: Transfer) -> [f64; 2] {
    let d = |text: &str| Decimal::parse(text).unwrap();
    let zero = Decimal::default();
    let mut matrix = vec![vec![zero; 4]; 4];
    for (row, weight) in matrix.iter_mut().zip(weights) {
        row[3] = d(weight);
    }
    let problem = Problem {
        names: ["a", "b", "c", "sum"].map(String::from).to_vec(),
        weights: matrix,
        start: start.map(d).into_iter().chain([zero]).collect(),
        ..Problem::default()
    };
    let settings = Settings { rule, transfer, lambda: 1.0, threshold: zero, held: true };
    let runs = [engine::run(&problem, &settings, 1), engine::q15(&problem, &settings, 1).unwrap()];
    runs.map(|run| run.last()[3])
}

#[test]
fn decimal_ties_are_exactly_zero() {
    for transfer in [Transfer::Bivalent, Transfer::Trivalent] {
        for (weights, start) in [
            (["0.1", "0.2", "-0.3"], ["1", "1", "1"]),
            (["0.15", "0.15", "-0.30"], ["1", "1", "1"]),
            (["1", "1", "-1"], ["0.1", "0.2", "0.3"]),
            (["0.1", "0.2", "-0.3"], ["0.7", "0.7", "0.7"]),
            (["0.0001", "0.0002", "-0.0003"], ["0.9999", "0.9999", "0.9999"]),
            (["0.3", "0.6", "-0.9"], ["0.1", "0.1", "0.1"]),
        ] {
            assert_eq!(tie(weights, start, Rule::Kosko, transfer), [0.0; 2], "{weights:?} {start:?}");
            assert_eq!(tie(weights, start, Rule::Mkosko, transfer), [0.0; 2], "{weights:?} {start:?}");
        }
        assert_eq!(tie(["0.1", "0.2", "-0.2999"], ["1"; 3], Rule::Kosko, transfer), [1.0; 2]);
    }
}

/// The published rule, C_j = 1 if C E_j > 0 else 0, has no memory: without a cycle among the edges the inputs
/// become 0 at the first step, their effects at the second, and so on.
#[test]
fn the_published_rule_puts_out_every_map_without_cycles() {
    let d = |text: &str| Decimal::parse(text).unwrap();
    let mut random = 1u64;
    let mut next = |below: u64| {
        random = random.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (random >> 33) % below
    };
    for n in 2..=10usize {
        for _ in 0..20 {
            let mut weights = vec![vec![Decimal::default(); n]; n];
            for (i, row) in weights.iter_mut().enumerate() {
                row.iter_mut()
                    .skip(i + 1)
                    .for_each(|w| *w = Decimal { digits: next(21) as i128 - 10, decimals: 1 });
            }
            let (names, start) = ((0..n).map(|i| i.to_string()).collect(), vec![d("1"); n]);
            let problem = Problem { names, weights, start, ..Problem::default() };
            let settings = Settings {
                rule: Rule::Kosko,
                transfer: Transfer::Bivalent,
                lambda: 1.0,
                threshold: Decimal::default(),
                held: false,
            };
            for run in [engine::run(&problem, &settings, n), engine::q15(&problem, &settings, n).unwrap()] {
                assert_eq!(run.last(), vec![0.0; n]);
            }
        }
    }
}

#[test]
fn a_file_is_refused_in_one_sentence() {
    for (text, message) in [
        (
            r#"{"names":["press","kindness"],"W":[[0,2],[0,0]],"x0":[0,0]}"#,
            "W[press][kindness] = 2 is outside [-1, 1]",
        ),
        (r#"{"names":["a","b"],"W":[[0,0],[0,0]],"x0":[0,-1.5]}"#, "x0[b] = -1.5 is outside [-1, 1]"),
        (r#"{"names":["a","b"],"W":[[0,0]],"x0":[0,0]}"#, "W has 1 rows, and there are 2 concepts"),
        (r#"{"names":["a","b"],"W":[[0,0],[0]],"x0":[0,0]}"#, "W[b] has 1 values, and there are 2 concepts"),
        (r#"{"names":["a","b"],"W":[[0,0],[0,0]],"x0":[0]}"#, "x0 has 1 values, and there are 2 concepts"),
        (r#"{"names":["a"],"W":[[0]]}"#, "x0 is missing"),
        (r#"{"names":["a"],"x0":[0]}"#, "W is missing"),
        (r#"{"names":["a","a"],"W":[[0,0],[0,0]],"x0":[0,0]}"#, "names: a is given twice"),
        ("{\"names\":[\"a\"],\n\"W\":[[NaN]],\"x0\":[0]}", "line 2: NaN is not a finite number"),
        (r#"{"names":["a"],"W":[["NaN"]],"x0":[0]}"#, "W[a][a] = \"NaN\" is not a finite number"),
        (r#"{"names":["a"],"W":[[null]],"x0":[0]}"#, "W[a][a] = null is not a finite number"),
        ("[1]", "not a JSON object with the keys names, W and x0"),
        ("{", "not JSON: EOF while parsing an object at line 1 column 1"),
    ] {
        assert_eq!(parse(text).unwrap_err().to_string(), message);
    }
}
