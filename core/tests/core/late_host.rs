//! What a host hears of reactions when it comes late or reads slowly, and what its silence means to the
//! board.

use crate::board::{BoardAndHost, FINGER};
use taxel_core::format::{Micros, Q15, name};
use taxel_core::garment::Line;
use taxel_core::intent::{Feed, Source};
use taxel_core::react::{Cause, ReactionConfig};
use taxel_core::scene::Scene;
use taxel_core::wire::{Report, Request};

fn row(cause: Cause, level: i32) -> ReactionConfig {
    let output = Some(Line { pin: 18, inverted: false });
    ReactionConfig { name: name("guard"), cause, region: name(""), level, hysteresis: 0, hold_ms: 0, output }
}

fn scene(row: ReactionConfig) -> Scene {
    let mut scene = Scene::shipped();
    scene.react.clear();
    scene.react.push(row).unwrap();
    scene
}

/// A board whose reaction to pressure is at rest.
fn guarding() -> BoardAndHost {
    let mut bench = BoardAndHost::new(scene(row(Cause::Pressure, 300)));
    bench.ask(&Request::Tare { frames: 1 });
    bench.scan();
    bench.drain(usize::MAX, |_| ());
    bench
}

fn press(bench: &mut BoardAndHost, code: u16) {
    bench.press(&FINGER, code);
    (0..4).for_each(|_| bench.scan());
}

fn reported(bench: &mut BoardAndHost) -> Vec<bool> {
    let mut reported = Vec::new();
    bench.drain(usize::MAX, |report| {
        if let Report::Reaction(report) = report {
            reported.push(report.reaction.active);
        }
    });
    reported
}

#[test]
fn a_host_that_connects_late_is_sent_what_lasts() {
    let mut bench = guarding();
    press(&mut bench, 900);
    assert!(reported(&mut bench).is_empty(), "nobody listens");
    bench.ask(&Request::Start);
    assert_eq!(reported(&mut bench), [true]);
    press(&mut bench, 0);
    assert_eq!(reported(&mut bench), [false]);
}

#[test]
fn a_host_that_reads_slowly_is_sent_how_each_reaction_stands() {
    for times in [20, 21] {
        let mut bench = guarding();
        bench.ask(&Request::Start);
        reported(&mut bench);
        (0..times).for_each(|at| press(&mut bench, if at % 2 == 0 { 900 } else { 0 }));
        let lost = bench.board.health().lost;
        let reported = reported(&mut bench);
        assert_eq!(
            (reported.last(), reported.len() < times),
            (Some(&(times % 2 == 1)), true),
            "{reported:?}"
        );
        assert!(lost as usize >= times - reported.len());
    }
}

#[test]
fn what_a_host_fed_holds_until_it_says_nothing_for_three_seconds() {
    let mut scene = Scene::shipped();
    let map = &mut scene.intent.as_mut().unwrap().map;
    (map.inputs[0].source, map.inputs[0].low, map.inputs[0].high) = (Source::Host(1), -32_768, 32_768);
    let concept = map.concepts[usize::from(map.inputs[0].concept)].clone();
    let mut bench = BoardAndHost::new(scene);
    let feed = Feed { concept, value: Q15(7), age_ms: 0, timeout_ms: 0, default: Q15(0) };
    assert_eq!(bench.answer(&Request::Feed(feed)), None);
    for _ in 0..20 {
        bench.now += 2_999_999;
        bench.ask(&Request::Sync { token: 1 });
        bench.tick();
        assert_eq!(bench.board.state().fed.values(Micros(bench.now))[1], Q15(7));
    }
    bench.now += 3_000_000;
    bench.tick();
    assert_eq!(bench.board.state().fed.values(Micros(bench.now))[1], Q15(0));
}

#[test]
fn raw_codes_that_are_asked_for_change_nothing_else() {
    let mut bench = guarding();
    bench.ask(&Request::Start);
    reported(&mut bench);
    let before = bench.board.setup().scene.clone();
    let mut rates = Vec::new();
    for hz in [10, 0] {
        assert_eq!(bench.answer(&Request::Stream { raw_hz: hz, budget_hz: 1 }), None);
        let mut raw = 0;
        (0..100).for_each(|_| {
            bench.scan();
            bench.drain(usize::MAX, |report| raw += usize::from(matches!(report, Report::Raw(_))));
        });
        rates.push(raw);
    }
    assert!((4..=6).contains(&rates[0]) && rates[1] <= 1, "{rates:?} in half a second each");
    assert_eq!(bench.board.setup().scene, before);
}

#[test]
fn blindness_is_longer_than_the_board_may_look_away() {
    let mut bench = guarding();
    let mut refused = |level: i32| {
        let bytes = postcard::to_allocvec(&scene(row(Cause::Blind, level))).unwrap();
        bench.answer(&Request::SetScene(&bytes))
    };
    let least = (1..100).find(|level| refused(*level).is_none()).expect("some time is accepted");
    assert!(least > 1, "{least} ms");
    let why = "scene: react[0].level must be longer than two frames and a self-test may take, ms";
    assert_eq!(refused(least - 1).as_deref(), Some(why));
    assert_eq!(refused(3_600_001).as_deref(), Some("scene: react[0].level must be 1 to 3600000 ms"));
}
