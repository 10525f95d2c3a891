//! The cognitive map against 60 digits: one step from any state, and where the shipped map settles.

use crate::bounds::exact::Real;
use crate::bounds::table::bound;
use crate::random::Noise;
use num_bigint::BigInt;
use taxel_core::format::{Q15, name};
use taxel_core::intent::{
    CONCEPTS, Edge, Inference, Map, MapConfig, MapInput, Outcome, Rule, Source, Touch, Transfer, tactile,
};

/// A map of `n` concepts, of which as many as there may be edges for are driven by all, with weights in steps
/// of 10^-decimals.
fn random(n: u8, decimals: u8, rule: Rule, transfer: Transfer, noise: &mut Noise) -> MapConfig {
    let mut config = MapConfig { name: name("any"), decimals, rule, transfer, ..MapConfig::default() };
    let step = 10i64.pow(decimals.into());
    let mut within = |limit: i64| noise.below(2 * limit as u64 + 1) as i64 - limit;
    config.lambda = [100, 500, 1000, 2500, 3500, 5000, 20_000, u16::MAX][(within(1000) + 1000) as usize % 8];
    config.threshold = within(step) as i16;
    for concept in 0..n {
        config.concepts.push(name(&concept.to_string())).unwrap();
    }
    for (from, to) in (0..n).flat_map(|to| (0..n).map(move |from| (from, to))) {
        let _ = config.edges.push(Edge { from, to, weight: within(step) as i16 });
    }
    config
}

/// The next state by the definition, from a state in units of 2^-15.
fn step(config: &MapConfig, state: &[i32]) -> Vec<Real> {
    let y: Vec<i64> = state
        .iter()
        .map(|x| i64::from(if config.rule == Rule::Rescaled { 2 * x - 32768 } else { *x }))
        .collect();
    let unit = 10i64.pow(config.decimals.into());
    (0..state.len())
        .map(|j| {
            let causes = config.edges.iter().filter(|edge| usize::from(edge.to) == j);
            let sum: i64 = causes.map(|edge| i64::from(edge.weight) * y[usize::from(edge.from)]).sum();
            let own = if config.rule == Rule::Kosko { 0 } else { unit * y[j] };
            let z = sum + own - (i64::from(config.threshold) << 15);
            let argument = Real::ratio(BigInt::from(z) * config.lambda, BigInt::from(unit) * 32_768_000);
            match config.transfer {
                Transfer::Sigmoid => argument.logistic(),
                Transfer::Positive if z < 0 => Real::ratio(0, 1),
                _ => argument.tanh(),
            }
        })
        .collect()
}

#[test]
fn one_step_is_within_its_bound() {
    let mut noise = Noise(8);
    for (transfer, quantity) in [
        (Transfer::Sigmoid, "activation after a step, sigmoid"),
        (Transfer::Tanh, "activation after a step, tanh"),
        (Transfer::Positive, "activation after a step, tanh"),
    ] {
        let stated = bound(quantity, "one_step_is_within_its_bound");
        let (mut count, mut worst) = (0, 0f64);
        for round in 0..900u32 {
            let rule = [Rule::Kosko, Rule::Mkosko, Rule::Rescaled][round as usize % 3];
            let (n, decimals) = (1 + (round % 16) as u8, 1 + (round / 16 % 4) as u8);
            let config = random(n, decimals, rule, transfer, &mut noise);
            let map = Map::<CONCEPTS>::build(&config).unwrap();
            for _ in 0..4 {
                let mut state = [0i32; CONCEPTS];
                let value = |noise: &mut Noise| noise.below(65_537) as i32 - 32_768;
                state.iter_mut().take(n.into()).for_each(|v| *v = value(&mut noise));
                let have = map.step(&state);
                for (have, want) in have.into_iter().zip(step(&config, &state[..n.into()])) {
                    let error = (Real::ratio(have, 32768) - want).abs().to_f64();
                    assert!(error <= stated.absolute, "{error} {config:?} {state:?}");
                    worst = worst.max(error);
                    count += 1;
                }
            }
        }
        println!("{transfer:?}: {count} activations, largest error {:.3} steps of 2^-15", worst * 32768.0);
        assert!(count > 10_000);
    }
}

/// Every activation of the shipped map when it has settled, from any inputs.
#[test]
fn the_shipped_map_settles_within_its_bound() {
    let stated = bound("activation of the shipped map", "the_shipped_map_settles_within_its_bound");
    let config = tactile();
    let map = Map::<22>::build(&config).unwrap();
    let caused = |concept: usize| config.edges.iter().any(|edge| usize::from(edge.to) == concept);
    let mut noise = Noise(10);
    let (mut count, mut worst) = (0, 0f64);
    for _ in 0..20_000 {
        let mut start = [0i32; 22];
        for (_, value) in start.iter_mut().enumerate().filter(|(concept, _)| !caused(*concept)) {
            let ends = [-32_768, -32_767, 0, 1, 32_767, 32_768];
            let any = noise.below(65_537) as i32 - 32_768;
            *value = *ends.get(noise.below(12) as usize).unwrap_or(&any);
        }
        let Inference { state, outcome, .. } = map.infer(&start, 64);
        assert_eq!(outcome, Outcome::Fixed);
        // Floats, whose own error is a millionth of the bound; no way is longer than five edges.
        let mut exact = start.map(|v| f64::from(v) / 32768.0);
        for _ in 0..6 {
            let before = exact;
            for concept in (0..22usize).filter(|concept| caused(*concept)) {
                let causes = config.edges.iter().filter(|edge| usize::from(edge.to) == concept);
                let sum: f64 =
                    causes.map(|edge| f64::from(edge.weight) / 100.0 * before[usize::from(edge.from)]).sum();
                exact[concept] = (f64::from(config.lambda) / 1000.0 * sum.max(0.0)).tanh();
            }
        }
        for (have, want) in state.into_iter().zip(exact) {
            worst = worst.max((f64::from(have) / 32768.0 - want).abs());
            count += 1;
        }
    }
    println!("{count} activations, largest error {worst:.3e}");
    assert!(worst <= stated.absolute, "{worst:e}");
}

/// States beyond -1 ..= 1 count as their ends.
#[test]
fn states_outside_their_range_are_clamped() {
    let mut noise = Noise(9);
    for transfer in
        [Transfer::Bivalent, Transfer::Trivalent, Transfer::Sigmoid, Transfer::Tanh, Transfer::Positive]
    {
        for rule in [Rule::Kosko, Rule::Mkosko, Rule::Rescaled] {
            let map = Map::<10>::build(&random(6, 2, rule, transfer, &mut noise)).unwrap();
            let ends = [i32::MIN, i32::MAX, -map.one() - 1, map.one() + 1, 0, map.one(), 0, 0, 0, 0];
            let inside = ends.map(|v| v.clamp(-map.one(), map.one()));
            assert_eq!(map.step(&ends), map.step(&inside));
            assert_eq!(map.infer(&ends, 50), map.infer(&inside, 50));
            let none = map.infer(&ends, 0);
            assert_eq!((none.state, none.steps, none.outcome), (inside, 0, Outcome::Unsettled));
            assert_eq!(map.q15(i32::MAX).0, if map.one() == 32768 { i32::MAX } else { 32768 });
        }
    }
}

/// Measures beyond the ramps, and slots that are not there.
#[test]
fn measures_outside_their_ramp_are_held_at_its_ends() {
    let map = Map::<22>::build(&tactile()).unwrap();
    let of = |press, friendliness| {
        let touch = Touch { load: press, pressure: press, friendliness, blow: press, ..Touch::default() };
        let state = map.encode(Some(&touch), &[]);
        [state[0], state[1], state[2], state[3]]
    };
    assert_eq!(of(0, i8::MIN), [0, -32768, -32768, 32768]);
    assert_eq!(of(u32::MAX, i8::MAX), [32768, 32768, 32768, -32768]);
    let mut config: MapConfig =
        MapConfig { name: name("fed"), decimals: 1, lambda: 1000, ..MapConfig::default() };
    config.concepts.push(name("fed")).unwrap();
    let source = Source::Host(3);
    config
        .inputs
        .push(MapInput { concept: 0, source, low: -32768, high: 32768, at_low: -10, at_high: 10 })
        .unwrap();
    let map = Map::<10>::build(&config).unwrap();
    let fed = |value| map.encode(None, &[Q15(0), Q15(0), Q15(0), Q15(value)])[0];
    assert_eq!([i32::MIN, -32768, 7, 32768, i32::MAX].map(fed), [-32768, -32768, 7, 32768, 32768]);
    assert_eq!(map.encode(None, &[Q15(9); 3])[0], 0, "no such slot");
}
