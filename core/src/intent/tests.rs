//! The stage as a whole: the shipped map on typical touches, the checks of a configuration, the debounce.

extern crate std;

use super::*;
use crate::format::{Micros, Q15, name};
use std::string::ToString;
use std::vec::Vec as List;
use std::{format, println};

/// A touch of one contact, whose force rose by that many newtons per second.
fn touch(newton: f64, mm: f64, ms: u32, friendliness: i8, rise: u32) -> Touch {
    let press = (newton * f64::from(PRESS_PER_NEWTON)) as u32;
    Touch {
        press,
        breadth: (mm * 10.0) as u32,
        friendliness,
        duration_ms: ms,
        rise,
        force: press,
        blow: rise,
        load: press,
        cover_mm2: (mm * mm) as u32,
        peak: (50.0 * newton) as u32,
        age_ms: ms,
        pressure: (1e5 * newton / (mm * mm)) as u32,
        rising_us: if rise < 1_000 { 1_000 * press / rise.max(1) } else { 10_000 },
        ..Touch::default()
    }
}

/// Sums of such touches, each on a region of its own.
fn felt(touches: &[Touch]) -> Felt {
    let mut felt = Felt::default();
    for (region, touch) in (0u8..).zip(touches) {
        felt.add(region, touch.force, touch.peak as u16, touch.cover_mm2.div_ceil(100) as u16, 100, 40);
    }
    felt
}

/// Such a touch, which gives way.
fn pat(newton: f64, mm: f64, ms: u32, friendliness: i8, rise: u32) -> Touch {
    Touch { gives: 1, ..touch(newton, mm, ms, friendliness, rise) }
}

/// Kindness, threat and attack of a touch, and the steps of the inference.
fn judged(map: &Map, touch: &Touch) -> ([f64; 3], u16) {
    let run = map.infer(&map.encode(Some(touch), &[]), 16);
    assert_eq!(run.outcome, Outcome::Fixed);
    (Leading::INTENTIONS.map(|i| map.q15(run.state[map.find(i.as_str()).unwrap()]).to_f64()), run.steps)
}

/// A touch of newtons, mm, ms, a friendliness and a rise.
type Make = fn(f64, f64, u32, i8, u32) -> Touch;

/// The least lead of `intention` over those on the other side of kindness, and its least activation, over a
/// grid of touches.
fn worst(
    (intention, touch): (usize, Make),
    newtons: &[f64],
    widths: &[f64],
    times: &[u32],
    rises: &[u32],
) -> (f64, f64) {
    let map = Map::build(&tactile()).unwrap();
    let (mut lead, mut level) = (f64::MAX, f64::MAX);
    for newton in newtons {
        for mm in widths {
            for ms in times {
                for (place, rise) in
                    PLACES.iter().flat_map(|place| rises.iter().map(move |rise| (*place, *rise)))
                {
                    let (values, _) = judged(&map, &touch(*newton, *mm, *ms, place, rise));
                    let own = values[intention];
                    let others = (0..3)
                        .filter(|i| (*i == 0) != (intention == 0))
                        .map(|i| values[i])
                        .fold(f64::MIN, f64::max);
                    (lead, level) = (lead.min(own - others), level.min(own));
                }
            }
        }
    }
    (lead, level)
}

const PLACES: [i8; 5] = [-20, 0, 30, 50, 80];

#[test]
fn typical_touches_have_their_meaning() {
    let short = [20, 40, 80, 120];
    for (label, intention, newtons, widths, times, rises) in [
        (
            "pat",
            (0, pat as Make),
            &[2.0, 5.0, 10.0, 15.0][..],
            &[54.0, 60.0, 90.0][..],
            &[100, 200, 400][..],
            &[50, 400][..],
        ),
        ("tap", (0, pat), &[1.0, 2.0, 5.0], &[24.0, 30.0], &short, &[50, 200]),
        ("hold", (1, touch), &[27.0, 40.0, 60.0], &[54.0, 60.0, 90.0], &[600, 1000, 5000], &[130, 400]),
        ("crush", (1, touch), &[250.0, 500.0], &[100.0, 300.0], &[600, 5000], &[20, 130]),
        ("lash", (2, touch), &[10.0, 20.0, 30.0, 60.0], &[8.0, 20.0, 30.0], &short, &[1000, 3000]),
        ("blow", (2, touch), &[30.0, 40.0, 100.0], &[54.0, 60.0, 80.0], &short, &[2000, 3000]),
    ] {
        let (lead, level) = worst(intention, newtons, widths, times, rises);
        println!("{label:8} leads by {lead:.2} at least, activation {level:.2} at least");
        assert!(lead > 0.2 && level > 0.6, "{label}: {lead} {level}");
    }
}

#[test]
fn light_touches_are_no_attack() {
    let map = Map::build(&tactile()).unwrap();
    let mut most = [0.0f64; 2];
    for place in PLACES {
        for newton in [0.5, 1.0, 2.0, 3.0] {
            for ms in [20, 60, 120] {
                // All of it within a frame of the reference board.
                let rise = (1000.0 * newton / 10.0) as u32;
                most[0] = most[0].max(judged(&map, &touch(newton, 20.0, ms, place, rise)).0[2]);
            }
            for ms in [100, 500, 3000] {
                let ([_, threat, attack], _) = judged(&map, &touch(newton, 20.0, ms, place, 100));
                most[1] = most[1].max(threat).max(attack);
            }
        }
    }
    println!("a lash at 5 %: attack at most {:.2}; a finger: threat, attack at most {:.2}", most[0], most[1]);
    assert!(most.iter().all(|value| *value < 0.4), "{most:?}");
}

/// Feelings follow meanings, whatever the measures: a threat causes no happiness.
#[test]
fn feelings_follow_meanings_whatever_is_measured() {
    let map = Map::<CONCEPTS>::build(&tactile()).unwrap();
    let at = |name: &str| map.find(name).unwrap();
    let inputs: List<usize> = tactile().inputs.iter().map(|input| usize::from(input.concept)).collect();
    let mut state = 7u32;
    let mut random = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 15) as i32 - 65_536
    };
    let mut led = [0; 3];
    for _ in 0..100_000 {
        let mut start = [0; CONCEPTS];
        // Half of the values are beyond the ends of the ramp, and are clamped.
        inputs.iter().for_each(|input| start[*input] = random());
        let run = map.infer(&start, 16);
        let value = |name: &str| map.q15(run.state[at(name)]).to_f64();
        let [kindness, threat, attack] = Leading::INTENTIONS.map(|leading| value(leading.as_str()));
        assert!([kindness, threat, attack].iter().all(|value| (0.0..=1.0).contains(value)));
        led.iter_mut().zip([kindness, threat, attack]).for_each(|(led, it)| *led += usize::from(it >= 0.5));
        if threat >= 0.5 || attack >= 0.5 {
            assert!(value("happiness") < 0.01 && value("politeness") < 0.01, "{start:?}");
            assert!(value("anger") > 0.0 || kindness > 0.2, "{start:?}");
        }
        if kindness >= 0.5 && threat.max(attack) < 0.1 {
            assert!(value("happiness") > 0.2 && value("anger") < 0.01, "{start:?}");
        }
        assert!(value("happiness").min(value("anger")) < 0.3, "{start:?}");
    }
    assert!(led.iter().all(|count| *count > 1_000), "{led:?}");
}

#[test]
fn without_a_touch_every_activation_is_exactly_zero() {
    let map = Map::<CONCEPTS>::build(&tactile()).unwrap();
    let run = map.infer(&map.encode(None, &[]), 16);
    assert_eq!((run.state, run.steps, run.outcome), ([0; CONCEPTS], 1, Outcome::Fixed));
}

#[test]
fn the_shipped_map_is_complete() {
    let map = tactile();
    assert_eq!((map.concepts.len(), map.edges.len(), map.inputs.len()), (22, 41, 20));
}

#[test]
fn the_shipped_map_settles_within_its_longest_path() {
    let map = Map::build(&tactile()).unwrap();
    let mut most = 0;
    for newton in 0..40 {
        for mm in [5.0, 35.0, 45.0, 80.0] {
            for ms in [0, 30, 300, 900] {
                most = most.max(judged(&map, &touch(f64::from(newton), mm, ms, 20, 700)).1);
            }
        }
    }
    // grip -> threat -> kindness -> happiness, anger -> politeness: five levels, and one to see no change.
    assert!(most <= 6, "{most}");
}

fn edit(change: impl Fn(&mut MapConfig)) -> std::string::String {
    let mut config = tactile();
    change(&mut config);
    Map::<CONCEPTS>::build(&config).unwrap_err().to_string()
}

#[test]
fn a_refused_map_names_what_is_wrong() {
    assert_eq!(edit(|c| c.edges[0].weight = 200), "W[time][sting] = 2 is outside [-1, 1]");
    assert_eq!(edit(|c| c.edges[0].weight = -105), "W[time][sting] = -1.05 is outside [-1, 1]");
    assert_eq!(edit(|c| c.edges[0].weight = i16::MIN), "W[time][sting] = -327.68 is outside [-1, 1]");
    assert_eq!(edit(|c| c.edges[1].to = 22), "edge 1 names concept 22, and there are 22");
    assert_eq!(edit(|c| c.edges[1].from = 255), "edge 1 names concept 255, and there are 22");
    assert_eq!(edit(|c| c.edges[1] = c.edges[0]), "edge time -> sting is given twice");
    assert_eq!(edit(|c| c.concepts[3] = name("press")), "concept press is named twice");
    assert_eq!(edit(|c| c.concepts.clear()), "the map has no concept");
    assert_eq!(edit(|c| c.lambda = 0), "lambda = 0 makes every concept constant");
    assert_eq!(edit(|c| c.decimals = 5), "decimals = 5 is outside 0 ..= 4");
    assert_eq!(edit(|c| c.threshold = 101), "threshold = 1.01 is outside [-1, 1]");
    let own = |concept, value| Threshold { concept, value };
    assert_eq!(
        edit(|c| c.thresholds.push(own(5, -150)).unwrap()),
        "threshold of threat = -1.5 is outside [-1, 1]"
    );
    assert_eq!(
        edit(|c| c.thresholds.push(own(22, 0)).unwrap()),
        "a threshold names concept 22, and there are 22"
    );
    let twice = edit(|c| c.thresholds.extend([own(5, 0), own(5, 1)]));
    assert_eq!(twice, "the threshold of threat is given twice");
    assert_eq!(edit(|c| c.inputs[0].low = 148_000), "input press: low = 148000 is not below high = 148000");
    assert_eq!(edit(|c| c.inputs[2].at_low = -101), "input location: -1.01 is outside [-1, 1]");
    assert_eq!(edit(|c| c.inputs[2].concept = 4), "concept kindness is an input and has an incoming edge");
    let small = Map::<8>::build(&tactile()).unwrap_err();
    assert_eq!(small.to_string(), "22 concepts, and there is room for 8");
    let sparse = Map::<22, 20>::build(&tactile()).unwrap_err();
    assert_eq!(sparse.to_string(), "41 edges, and there is room for 20");
    let mut stage = IntentConfig::new(tactile());
    stage.level = 1001;
    assert_eq!(
        Intent::<CONCEPTS>::build(&stage).unwrap_err().to_string(),
        "level = 1001 thousandths is above 1"
    );
}

#[test]
fn no_sum_overflows_even_with_every_weight_at_its_limit() {
    for transfer in [Transfer::Bivalent, Transfer::Trivalent, Transfer::Sigmoid, Transfer::Tanh] {
        for decimals in 0..=4u8 {
            let one = 10i16.pow(decimals.into());
            let mut config = MapConfig::<16, 256> {
                decimals,
                transfer,
                lambda: u16::MAX,
                held: true,
                ..Default::default()
            };
            (config.rule, config.threshold) = (Rule::Rescaled, one);
            for at in 0..16u8 {
                config.concepts.push(name(&format!("{at}"))).unwrap();
                config.edges.extend((0..16).map(|from| Edge {
                    from,
                    to: at,
                    weight: if at % 2 == 0 { one } else { -one },
                }));
            }
            match Map::<16, 256>::build(&config) {
                // Overflow checks are on in this profile: an overflow would panic.
                Ok(map) => {
                    for start in [[i32::MIN; 16], [i32::MAX; 16], [0; 16]] {
                        map.infer(&start, 20);
                    }
                }
                Err(error) => assert!(transfer.is_threshold() && decimals == 4, "{error}"),
            }
        }
    }
}

#[test]
fn a_slow_cycle_has_its_exact_period() {
    // A ring of five concepts passes one activation on.
    let mut config = MapConfig::<16, 64> { transfer: Transfer::Bivalent, lambda: 1000, ..Default::default() };
    for at in 0..5u8 {
        config.concepts.push(name(&format!("c{at}"))).unwrap();
        config.edges.push(Edge { from: at, to: (at + 1) % 5, weight: 1 }).unwrap();
    }
    let map = Map::<5>::build(&config).unwrap();
    let run = map.infer(&[1, 0, 0, 0, 0], 100);
    assert_eq!(run.outcome, Outcome::Cycle(5));
    assert_eq!(map.infer(&[1, 0, 0, 0, 0], 4).outcome, Outcome::Unsettled);
    assert_eq!(map.infer(&[1; 5], 100).outcome, Outcome::Fixed);
}

#[test]
fn thresholds_are_the_level_that_sums_are_measured_from() {
    let mut config = MapConfig::<16, 64> { decimals: 1, lambda: 1000, held: true, ..Default::default() };
    config.concepts.extend(["cause", "effect"].map(name));
    config.edges.push(Edge { from: 0, to: 1, weight: 3 }).unwrap();
    for (transfer, threshold, expected) in [
        (Transfer::Bivalent, 3, 0),
        (Transfer::Bivalent, 2, 10),
        (Transfer::Trivalent, 3, 0),
        (Transfer::Trivalent, 4, -10),
        (Transfer::Sigmoid, 3, 16384),
        (Transfer::Tanh, 3, 0),
    ] {
        (config.transfer, config.threshold) = (transfer, threshold);
        let map = Map::<2>::build(&config).unwrap();
        assert_eq!(map.step(&[map.one(), 0])[1], expected, "{transfer:?} {threshold}");
        // This threshold for one concept alone, and its negative for all others.
        config.thresholds.push(Threshold { concept: 1, value: threshold }).unwrap();
        config.threshold = -threshold;
        assert_eq!(Map::<2>::build(&config).unwrap().step(&[map.one(), 0])[1], expected);
        config.thresholds.clear();
    }
}

#[test]
fn the_parts_of_a_reason_add_up() {
    let map = Map::<CONCEPTS>::build(&tactile()).unwrap();
    let run = map.infer(&map.encode(Some(&touch(20.0, 20.0, 60, 0, 1000)), &[]), 16);
    let attack = map.find("attack").unwrap();
    let why = map.why(&run.state, attack).unwrap();
    let sum: i32 = why.parts.iter().map(|part| part.value.0).sum();
    assert_eq!((why.parts.len(), why.sum, why.threshold), (5, Q15(sum), Q15(0)));
    // and they explain the activation: tanh(3.5 sum)
    assert!((map.q15(run.state[attack]).to_f64() - (3.5 * why.sum.to_f64()).tanh()).abs() < 1e-3);
    let largest = why.parts.iter().max_by_key(|part| part.value.0).unwrap();
    assert_eq!(map.concepts()[usize::from(largest.from)], "shape");
    assert_eq!(map.why(&run.state, 0), None);
    assert_eq!(map.why(&run.state, 99), None);
}

/// Feeds touches, one list per 5 ms frame, and lists the announcements: (ms, intention).
fn announced(frames: impl IntoIterator<Item = List<Touch>>) -> List<(u64, Leading)> {
    let stage = Intent::<CONCEPTS>::build(&IntentConfig::new(tactile())).unwrap();
    let mut state = IntentState::default();
    let mut out = List::new();
    for (at, touches) in frames.into_iter().enumerate() {
        let ms = 5 * at as u64;
        match stage.process(&mut state, &touches, &felt(&touches), &[], Micros(1000 * ms)) {
            Some(meaning) if meaning.changed => out.push((ms, meaning.leading)),
            _ => {}
        }
        assert_eq!(stage.why(&state).is_some(), state.leading() != Leading::None);
    }
    out
}

#[test]
fn a_lash_of_25_ms_is_announced_and_ends_after_the_hold() {
    let frames = (0..200).map(|at| match at {
        20..25 => std::vec![touch(25.0, 15.0, 5 * (at - 20), 0, 0)],
        _ => List::new(),
    });
    assert_eq!(announced(frames), [(130, Leading::Attack), (755, Leading::None)]);
}

#[test]
fn a_contact_shorter_than_the_evidence_asked_for_still_counts_after_its_release() {
    let frames =
        (0..100).map(|at| if at == 20 { std::vec![touch(40.0, 10.0, 5, 0, 0)] } else { List::new() });
    assert_eq!(announced(frames).first(), Some(&(130, Leading::Attack)));
}

#[test]
fn of_several_touches_the_strongest_counts() {
    let frames = (0..100u32).map(|at| {
        let hand = touch(6.0, 80.0, 5 * at, 30, 0);
        let strap = touch(30.0, 15.0, 5 * (at.max(40) - 40), 30, 0);
        if (40..52).contains(&at) { std::vec![hand, strap] } else { std::vec![hand] }
    });
    let heard: List<Leading> = announced(frames).into_iter().map(|(_, leading)| leading).collect();
    assert_eq!(heard, [Leading::Attack]);
}

/// The same force in the same time, applied at once or gradually.
#[test]
fn how_steeply_the_force_came_distinguishes_a_blow_from_a_grab() {
    let came = |rise_ms: u32| {
        announced((0..260u32).map(|at| {
            let ms = 5 * at.saturating_sub(20);
            let newton = 40.0 * f64::from((ms + 5).min(rise_ms)) / f64::from(rise_ms);
            let felt = (20..120).contains(&at);
            if felt { std::vec![touch(newton, 70.0, ms, 30, 0)] } else { List::new() }
        }))
    };
    let words =
        |said: List<(u64, Leading)>| said.into_iter().map(|(_, leading)| leading).collect::<List<_>>();
    assert_eq!(words(came(15)), [Leading::Attack, Leading::None], "who stays after a blow has hit");
    assert_eq!(words(came(200)), [Leading::Threat, Leading::None]);
}

/// A push begins as lightly as a hand that is laid on.
#[test]
fn what_still_comes_is_not_called_kind() {
    let came = |newton: f64| {
        announced((0..200u32).map(|at| {
            let force = newton / (1.0 + (-(5.0 * f64::from(at) - 300.0) / 25.0).exp());
            let is_over = newton < 20.0 && at > 90 || at > 180;
            if force < 0.3 || is_over { List::new() } else { std::vec![touch(force, 70.0, 5 * at, 30, 0)] }
        }))
    };
    let said = |newton: f64, of: Leading| came(newton).iter().any(|(_, leading)| *leading == of);
    assert!(!said(60.0, Leading::Kindness) && said(60.0, Leading::Threat));
    assert!(said(8.0, Leading::Kindness) && !said(8.0, Leading::Threat));
}

/// A garment before its tare seems to be pressed all over.
#[test]
fn what_was_there_in_the_first_frame_did_not_come_suddenly() {
    let heard = announced((0..100u32).map(|at| std::vec![touch(200.0, 200.0, 5 * at, 30, 0)]));
    assert!(heard.iter().all(|(_, leading)| *leading != Leading::Attack), "{heard:?}");
    let heard =
        announced((0..100u32).map(|at| {
            if at == 0 { List::new() } else { std::vec![touch(200.0, 200.0, 5 * (at - 1), 30, 0)] }
        }));
    assert!(heard.iter().any(|(_, leading)| *leading == Leading::Attack), "{heard:?}");
}

#[test]
fn a_quiet_stage_says_nothing_after_its_first_word() {
    let stage = Intent::<CONCEPTS>::build(&IntentConfig::new(tactile())).unwrap();
    let mut state = IntentState::default();
    let first = stage.process(&mut state, &[], &Felt::default(), &[], Micros(0)).unwrap();
    assert!(
        !first.changed && first.activations.iter().all(|v| *v == Q15(0)) && first.activations.len() == 22
    );
    let mut later = (1..1000)
        .map(|ms| stage.process(&mut state, &[], &Felt::default(), &[], Micros(1000 * ms)).is_none());
    assert!(later.all(|quiet| quiet));
}

#[test]
fn a_host_value_feeds_its_concept() {
    let mut config = tactile();
    config.inputs[2] = MapInput {
        concept: 2,
        source: Source::Host(1),
        low: -32768,
        high: 32768,
        at_low: -100,
        at_high: 100,
    };
    let map = Map::<CONCEPTS>::build(&config).unwrap();
    assert_eq!(map.encode(None, &[Q15(5), Q15(-12345)])[2], -12345);
    assert_eq!(map.encode(None, &[])[2], 0);
}

/// A rise and a fall are a trapezoid; without a touch it is 0 like every other input.
#[test]
fn the_inputs_of_a_concept_add_up() {
    let mut config = MapConfig::<4, 4> { decimals: 1, lambda: 1000, ..Default::default() };
    config.concepts.push(name("medium")).unwrap();
    let source = Source::Press;
    let ramp = |low, high, at_high| MapInput { concept: 0, source, low, high, at_low: 0, at_high };
    config.inputs.extend([ramp(100, 300, 10), ramp(500, 700, -10)]);
    let map = Map::<4>::build(&config).unwrap();
    let of = |press| map.encode(Some(&Touch { press, ..Touch::default() }), &[])[0];
    let points = [0, 100, 200, 300, 400, 500, 600, 700, u32::MAX];
    assert_eq!(points.map(of), [0, 0, 16384, 32768, 32768, 32768, 16384, 0, 0]);
    assert_eq!(map.encode(None, &[])[0], 0);
    config.inputs.extend([ramp(100, 300, 10)]);
    let map = Map::<4>::build(&config).unwrap();
    assert_eq!(map.encode(Some(&Touch { press: 400, ..Touch::default() }), &[])[0], 32768, "held at 1");
}

/// Sixty-four concepts, each driven by three others, settle where the definition does.
#[test]
fn a_map_of_64_concepts_is_inferred() {
    let mut config: std::boxed::Box<MapConfig<64, 192>> = std::boxed::Box::default();
    (config.decimals, config.lambda) = (2, 1000);
    for at in 0..64u8 {
        config.concepts.push(name(&format!("c{at}"))).unwrap();
        let cause = |k: u8| Edge { from: (at + k * k) % 64, to: at, weight: 20 - 15 * i16::from(k) };
        config.edges.extend([1, 2, 3].map(cause));
    }
    config.threshold = -10;
    assert_eq!(config.edges.len(), 192);
    let map = Map::<64, 192>::build(&*config).unwrap();
    let run = map.infer(&[0; 64], 200);
    assert_eq!(run.outcome, Outcome::Fixed);
    let mut exact = [0f64; 64];
    for _ in 0..200 {
        let mut sums = [0.1; 64];
        for edge in &config.edges {
            sums[usize::from(edge.to)] += f64::from(edge.weight) / 100.0 * exact[usize::from(edge.from)];
        }
        exact = sums.map(f64::tanh);
    }
    let worst =
        run.state.iter().zip(exact).map(|(q, x)| (f64::from(*q) / 32768.0 - x).abs()).fold(0.0, f64::max);
    println!("64 concepts: {worst:.1e} from the fixed point in f64");
    assert!(worst < 2e-4, "{worst}");
}

#[test]
fn a_configuration_travels_by_postcard() {
    let config = IntentConfig::new(tactile());
    let mut bytes = [0; 2048];
    let used = postcard::to_slice(&config, &mut bytes).unwrap();
    println!("the shipped stage takes {} bytes", used.len());
    assert_eq!(postcard::from_bytes::<IntentConfig>(used).unwrap(), config);
}
