//! Faulty lines and inputs, and the results of a self-test.

use super::scripts::all_pressed;
use super::watched::WatchedBoard;
use crate::faults::{examine, pin_faults};
use taxel::files::scripts;
use taxel::sim::{Stuck, rewire};
use taxel_core::board::{Input, Job};
use taxel_core::format::Micros;
use taxel_core::garment::Garment;
use taxel_core::health::TaxelHealth;
use taxel_core::selftest::{Fault, Findings, PinFault};
use taxel_core::wire::{Receiver, Report, Request, decode, encode};

#[test]
fn every_fault_of_a_line_or_an_input_is_reported_as_itself() {
    let mut rng = fastrand::Rng::with_seed(7);
    // Inverted lines, exchanged inputs and turned blocks do not affect the self-test.
    for garment in [Garment::reference(), Garment::mat(), rewire(&Garment::reference(), &mut rng)] {
        let mut script = all_pressed(0.1);
        script.touches.retain(|touch| garment.panels.iter().any(|panel| panel.name.as_str() == touch.panel));
        assert_eq!(examine(&garment, &script), Findings { lines: 9, inputs: 4, faults: Default::default() });
        let faults = pin_faults(&garment);
        assert_eq!(faults.len(), 8 + 18 + 12);
        for fault in faults {
            script.faults.pins = vec![fault];
            assert_eq!(examine(&garment, &script).faults, [fault], "{}", garment.name);
        }
    }
}

#[test]
fn several_faults_are_reported_side_by_side() {
    let mut script = scripts::parse("duration_s = 1", "rest.toml").unwrap();
    let faults = [
        (2, Fault::Bridged(12)),
        (3, Fault::StuckHigh),
        (8, Fault::StuckLow),
        (26, Fault::Supplied),
        (28, Fault::Open),
    ];
    script.faults.pins = faults.map(|(pin, fault)| PinFault { pin, fault }).to_vec();
    assert_eq!(examine(&Garment::reference(), &script).faults, script.faults.pins[..]);
}

#[test]
fn a_self_test_reports_its_findings_and_gives_every_taxel_another_chance() {
    let mut script = all_pressed(0.1);
    script.faults.stuck = vec![Stuck { taxel: 77, code: 300 }];
    let mut watched = WatchedBoard::new();
    assert_eq!(watched.play(&script, 100).len(), 1);
    let gain = |watched: &WatchedBoard| watched.board.state().condition.gain()[77];
    assert_eq!(gain(&watched), 0);
    let mut wire = [0; 64];
    let frame = encode(&Request::SelfTest, &mut wire).unwrap();
    watched.board.step(Micros(0), Input::Received(frame), &mut ());
    let jobs = std::iter::from_fn(|| watched.board.step(Micros(0), Input::Tick, &mut ()));
    assert!(jobs.take(9).any(|job| job == Job::Examine));
    script.faults.pins = vec![PinFault { pin: 9, fault: Fault::Bridged(10) }];
    let findings = examine(&watched.garment, &script);
    let lost = watched.board.health().overruns;
    watched.board.step(Micros(20_480), Input::Examined(Ok(findings.clone())), &mut ());
    assert_eq!(watched.board.health().overruns - lost, 4, "of 5.12 ms each");
    assert_eq!((watched.board.health_of(77), gain(&watched)), (TaxelHealth::Good, 4096));
    assert_eq!(reported(&mut watched), [Ok((Micros(20_480), findings)), Err(true)]);
    script.faults.pins.clear();
    assert_eq!(watched.play(&script, 100).keys().copied().collect::<Vec<_>>(), [77], "it is found again");
}

#[test]
fn a_garment_that_is_put_on_is_examined_and_reported() {
    let mut watched = WatchedBoard::new();
    let (mut wire, mut bytes) = ([0; 2048], [0; 2048]);
    watched.garment.wiring.column.lines.swap(0, 3);
    let garment = postcard::to_slice(&watched.garment, &mut bytes).unwrap();
    for request in [Request::Start, Request::SetGarment(garment)] {
        let frame = encode(&request, &mut wire).unwrap();
        watched.board.step(Micros(0), Input::Received(frame), &mut ());
    }
    let jobs = |watched: &mut WatchedBoard| -> Vec<Job> {
        let jobs = std::iter::from_fn(|| watched.board.step(Micros(0), Input::Tick, &mut ()));
        jobs.take(9).filter(|job| !matches!(job, Job::Drive(..))).collect()
    };
    assert_eq!(jobs(&mut watched)[0], Job::Examine);
    let mut script = scripts::parse("duration_s = 1", "rest.toml").unwrap();
    script.faults.pins = vec![PinFault { pin: 12, fault: Fault::StuckLow }];
    let findings = examine(&watched.garment, &script);
    assert_eq!(findings.faults[..], script.faults.pins[..]);
    watched.board.step(Micros(9), Input::Examined(Ok(findings.clone())), &mut ());
    assert!(!jobs(&mut watched).contains(&Job::Examine), "once is enough");
    assert_eq!(reported(&mut watched), [Ok((Micros(9), findings))]);
}

/// Self-test reports of a board, and its answers.
fn reported(watched: &mut WatchedBoard) -> Vec<Result<(Micros, Findings), bool>> {
    let (mut reported, mut receiver) = (Vec::new(), Box::new(Receiver::<8192>::new()));
    while let [byte, ..] = watched.board.pending(Micros(20_480), &mut ()) {
        if let Some(Ok(body)) = receiver.push(*byte) {
            match decode(body).unwrap() {
                (_, Report::SelfTest(report)) => reported.push(Ok((report.time, report.findings))),
                (_, Report::Answer(answer)) if answer.request == Request::SelfTest.number() => {
                    reported.push(Err(answer.refusal.is_none()))
                }
                (0u32.., _) => {}
            }
        }
        watched.board.sent(1);
    }
    reported
}
