//! Another scene or garment while a reaction lasts: its pin, and its end.

use crate::board::{BoardAndHost, FINGER};
use taxel_core::board::Job;
use taxel_core::format::name;
use taxel_core::garment::Garment;
use taxel_core::gesture::GestureConfig;
use taxel_core::react::{Cause, ReactionConfig};
use taxel_core::scene::Scene;
use taxel_core::wire::{Report, Request};

/// A reaction to pressure from 300 counts on, which lasts down to 100.
fn scene() -> Scene {
    let mut scene = Scene::shipped();
    let output = scene.react[0].output;
    let (cause, region) = (Cause::Pressure, name(""));
    let row = ReactionConfig {
        name: name("guard"),
        cause,
        region,
        level: 300,
        hysteresis: 200,
        hold_ms: 0,
        output,
    };
    scene.react.clear();
    scene.react.push(row).unwrap();
    scene
}

/// Levels to which the reaction's pin is driven now.
fn driven(bench: &mut BoardAndHost) -> Vec<bool> {
    let pin = scene().react[0].output.unwrap().pin;
    let jobs = std::iter::from_fn(|| bench.tick()).take(20);
    jobs.filter_map(|job| if let Job::Drive(at, level) = job { (at == pin).then_some(level) } else { None })
        .collect()
}

/// Ends and beginnings that are reported.
fn reported(bench: &mut BoardAndHost) -> Vec<bool> {
    let mut reported = Vec::new();
    bench.drain(usize::MAX, |report| {
        if let Report::Reaction(report) = report {
            assert_eq!((report.reaction.index, report.reaction.name.as_str()), (0, "guard"));
            reported.push(report.reaction.active);
        }
    });
    reported
}

/// A board whose reaction lasts at 200 counts, inside the hysteresis.
fn guarding() -> BoardAndHost {
    let mut bench = BoardAndHost::new(scene());
    bench.ask(&Request::Start);
    bench.ask(&Request::Tare { frames: 1 });
    bench.scan();
    assert_eq!((driven(&mut bench), reported(&mut bench)), (vec![false], vec![]));
    for code in [900, 200] {
        bench.press(&FINGER, code);
        (0..3).for_each(|_| bench.scan());
    }
    assert_eq!((driven(&mut bench), reported(&mut bench)), (vec![true], vec![true]));
    bench
}

fn set(bench: &mut BoardAndHost, scene: &Scene) {
    assert_eq!(bench.answer(&Request::SetScene(&postcard::to_allocvec(scene).unwrap())), None);
}

#[test]
fn another_stream_and_other_gestures_touch_nothing_else() {
    let mut bench = guarding();
    let mut other = scene();
    (other.stream.frames_hz, other.stream.pressing_hz) = (20, 10);
    (other.contact.forms_in_frame, other.gestures) = (3, Some(GestureConfig::default()));
    set(&mut bench, &other);
    assert_eq!((driven(&mut bench), reported(&mut bench)), (vec![], vec![]));
    bench.scan();
    assert_eq!((driven(&mut bench), reported(&mut bench)), (vec![], vec![]));
    other.stream.key_ms = 0;
    let why = bench.answer(&Request::SetScene(&postcard::to_allocvec(&other).unwrap())).unwrap();
    assert_eq!(why, "scene: stream.key_ms must be 1 to 1000");
    let mut images = 0;
    (0..100).for_each(|_| {
        bench.scan();
        bench.drain(usize::MAX, |report| images += usize::from(matches!(report, Report::Frame(_))));
    });
    assert!((9..=11).contains(&images), "{images} in half a second");
}

#[test]
fn a_reaction_goes_on_in_another_table_until_that_decides() {
    let mut bench = guarding();
    let mut other = scene();
    other.symbol.span_ms[0] += 1;
    set(&mut bench, &other);
    assert_eq!(driven(&mut bench), [true], "not low for a moment");
    bench.scan();
    assert_eq!(
        (driven(&mut bench), reported(&mut bench)),
        (vec![], vec![]),
        "200 counts are inside the hysteresis"
    );
    // The new table says that it is over.
    other.react[0].hysteresis = 50;
    set(&mut bench, &other);
    assert_eq!((driven(&mut bench), reported(&mut bench)), (vec![true], vec![]));
    (0..3).for_each(|_| bench.scan());
    assert_eq!((driven(&mut bench), reported(&mut bench)), (vec![false], vec![false]));
}

#[test]
fn what_has_no_row_any_more_ends_and_is_reported() {
    let renamed = |mut scene: Scene| {
        scene.react[0].name = name("watch");
        scene
    };
    let without = |mut scene: Scene| {
        scene.react.clear();
        scene
    };
    for change in [renamed, without] {
        let mut bench = guarding();
        bench.ask(&Request::SetScene(&postcard::to_allocvec(&change(scene())).unwrap()));
        assert_eq!((driven(&mut bench), reported(&mut bench)), (vec![false], vec![false]));
    }
    let mut bench = guarding();
    bench.ask(&Request::SetGarment(&postcard::to_allocvec(&Garment::block()).unwrap()));
    assert_eq!((driven(&mut bench), reported(&mut bench)), (vec![false], vec![false]));
}
