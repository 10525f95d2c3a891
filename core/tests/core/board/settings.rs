//! Stored settings: saving, resetting, and what a board begins with.

use super::BoardAndHost;
use taxel_core::acquire::ScanError;
use taxel_core::board::{Input, Job, Part, Saved};
use taxel_core::boot::{Aside, Boot, BootCause};
use taxel_core::format::Micros;
use taxel_core::garment::Garment;
use taxel_core::scene::Scene;
use taxel_core::wire::{Report, Request};

#[test]
fn jobs_that_fail_are_reported() {
    let mut bench = BoardAndHost::new(Scene::shipped());
    bench.ask(&Request::SelfTest);
    let jobs: Vec<_> =
        std::iter::from_fn(|| bench.tick()).take_while(|job| !matches!(job, Job::Scan(_))).collect();
    assert_eq!(jobs.last(), Some(&Job::Examine));
    bench.board.step(Micros(0), Input::Examined(Err(ScanError::Output(9))), &mut ());
    let error = ScanError::Converter { input: 26, taxel: 5 };
    bench.board.step(Micros(0), Input::Scanned(Err(error)), &mut ());
    let mut reported = Vec::new();
    bench.drain(usize::MAX, |report| match report {
        Report::Answer(answer) => {
            reported.push(format!("{} {}", answer.request, answer.refusal.unwrap_or("yes")))
        }
        Report::Log(log) => reported.push(log.text.to_string()),
        _ => {}
    });
    assert_eq!(
        reported,
        ["13 pin 9 cannot be driven", "scan: converter input on pin 26 gave no sample (at taxel 5)"]
    );
    assert!(matches!(bench.tick(), Some(Job::Scan(_))), "a failed scan is followed by the next");
}

#[test]
fn each_hello_says_how_the_board_came_to_start() {
    let mut bench = BoardAndHost::new(Scene::shipped());
    let boot = Boot { cause: BootCause::Panic, resets: 3, aside: Aside::Resets };
    bench.board.booted(boot);
    let reported = |bench: &mut BoardAndHost| {
        let mut reported = Vec::new();
        bench.drain(usize::MAX, |report| {
            if let Report::Hello(hello) = report {
                reported.push(hello.boot);
            }
        });
        reported
    };
    bench.tick();
    assert_eq!(reported(&mut bench), [Some(boot)]);
    bench.now += 1_000_000;
    bench.tick();
    assert_eq!(reported(&mut bench), [Some(boot)], "each second");
    bench.ask(&Request::Start);
    assert_eq!(reported(&mut bench), [Some(boot)]);
    // What is stored now is in force.
    bench.ask(&Request::Save);
    until_save(&mut bench);
    bench.board.step(Micros(bench.now), Input::Saved(Ok(Saved::Written)), &mut ());
    bench.ask(&Request::Start);
    assert_eq!(reported(&mut bench), [Some(Boot { aside: Aside::No, ..boot })]);
}

#[test]
fn settings_are_reset_then_the_board_starts_anew_when_it_has_answered() {
    let mut bench = BoardAndHost::new(Scene::shipped());
    bench.scan();
    let asked = |bench: &mut BoardAndHost, undo| {
        bench.ask(&Request::ResetSettings { undo });
        let reset = std::iter::from_fn(|| bench.tick()).find(|job| !matches!(job, Job::Drive(..)));
        assert_eq!(reset, Some(Job::ResetSettings { undo }));
    };
    let answer = |bench: &mut BoardAndHost| {
        let mut answers = Vec::new();
        bench.drain(usize::MAX, |report| {
            if let Report::Answer(answer) = report {
                answers.push((answer.request, answer.refusal.map(str::to_string)));
            }
        });
        answers
    };
    asked(&mut bench, true);
    bench.board.step(Micros(bench.now), Input::SettingsReset(Err("the flash cannot be read")), &mut ());
    assert_eq!(answer(&mut bench), [(15, Some("the flash cannot be read".to_string()))]);
    for _ in 0..100 {
        assert_ne!(bench.tick(), Some(Job::Restart), "what has failed changes nothing");
        bench.scan();
    }
    asked(&mut bench, false);
    bench.board.step(Micros(bench.now), Input::SettingsReset(Ok(Saved::Written)), &mut ());
    assert_eq!(answer(&mut bench), [(15, None)]);
    let restarts = (0..20).position(|_| {
        let job = bench.tick();
        bench.scan();
        job == Some(Job::Restart)
    });
    assert_eq!(restarts, Some(10), "50 ms later");
}

#[test]
fn a_stored_garment_that_would_outlast_the_watchdog_is_refused_and_what_ships_stays() {
    let mut bench = BoardAndHost::new(Scene::shipped());
    let mut slow = Garment::block();
    slow.wiring.settle_ns = 10_000_000;
    bench.board.restore(Part::Garment, &postcard::to_allocvec(&slow).expect("it fits"));
    assert_eq!(bench.board.setup().garment, Garment::block());
    let mut logs = Vec::new();
    bench.drain(usize::MAX, |report| {
        if let Report::Log(log) = report {
            logs.push(log.text.to_string());
        }
    });
    let why = "stored garment: a frame takes 641 ms, at most 500: lower wiring.settle_ns (10000000)";
    assert_eq!(logs, [why]);
}

/// Ticks, scans and reads on until the board wants to save; what it logged before.
fn until_save(bench: &mut BoardAndHost) -> Vec<String> {
    let mut logs = Vec::new();
    for _ in 0..100 {
        bench.drain(usize::MAX, |report| {
            if let Report::Log(log) = report {
                logs.push(log.text.to_string());
            }
        });
        match bench.tick() {
            Some(Job::Save) => return logs,
            Some(Job::Scan(_)) => bench.scan(),
            _ => {}
        }
    }
    panic!("the board does not save");
}

#[test]
fn a_save_is_announced_and_what_it_costs_is_counted() {
    let mut bench = BoardAndHost::new(Scene::shipped());
    bench.scan();
    bench.ask(&Request::Save);
    assert_eq!(until_save(&mut bench), ["scanning stops for about 150 ms while the settings are stored"]);
    bench.now += 200_000;
    bench.board.step(Micros(bench.now), Input::Saved(Ok(Saved::Written)), &mut ());
    // Scans of 4 ms.
    assert_eq!(bench.board.health().overruns, 50);
    let mut answers = Vec::new();
    bench.drain(usize::MAX, |report| {
        if let Report::Answer(answer) = report {
            answers.push((answer.request, answer.refusal.map(str::to_string)));
        }
    });
    assert_eq!(answers, [(14, None)]);
}

#[test]
fn the_flash_is_spared() {
    let mut bench = BoardAndHost::new(Scene::shipped());
    bench.scan();
    // Settings that have not changed cost nothing.
    for round in 0..40 {
        bench.ask(&Request::Save);
        until_save(&mut bench);
        let saved = if round < 28 { Saved::Unchanged } else { Saved::Written };
        bench.board.step(Micros(bench.now), Input::Saved(Ok(saved)), &mut ());
    }
    let refusal = bench.answer(&Request::Save).expect("it is refused");
    assert!(refusal.starts_with("the flash has been written often enough"), "{refusal}");
    bench.now += 300_000_000;
    bench.ask(&Request::Save);
    until_save(&mut bench);
}

#[test]
fn half_a_tare_is_not_stored() {
    let mut bench = BoardAndHost::new(Scene::shipped());
    bench.ask(&Request::Tare { frames: 9 });
    assert_eq!(bench.answer(&Request::Save).as_deref(), Some("a tare is under way"));
}
