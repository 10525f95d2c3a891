//! Lines and inputs that break at run time: the board finds and reports them as at the start.

use super::scripts::varied;
use super::watched::{FRAME_S, TAXELS};
use crate::faults::pin_faults;
use taxel::sim::{PINS, Script, SimBoard, SimClock};
use taxel_core::acquire::{Clock, MuxScan};
use taxel_core::board::{BoardInfo, Saved, Settings, Shipped};
use taxel_core::format::Micros;
use taxel_core::garment::{Garment, Pins};
use taxel_core::pipeline::{Probe, Stage};
use taxel_core::run::{Link, Platform, block_on, run};
use taxel_core::scene::Scene;
use taxel_core::selftest::{Fault, Findings, PinFault};
use taxel_core::wire::{Checksum, HealthMap, Receiver, Report, Request, SelfTestReport, decode, encode};

/// Frame in which something breaks.
const BROKEN: u32 = 60;
/// Frames within which a fault is reported.
const SOON: u32 = 100;

/// The host's end: its requests, and the reports received.
struct Host {
    requests: Vec<u8>,
    receiver: Box<Receiver<8192>>,
    self_tests: Vec<SelfTestReport>,
    maps: Vec<HealthMap>,
    overruns: u32,
}

impl Host {
    fn new() -> Host {
        let mut requests = Vec::new();
        for request in [Request::Tare { frames: 16 }, Request::Start] {
            requests.extend_from_slice(encode(&request, &mut [0; 64]).unwrap());
        }
        let receiver = Box::new(Receiver::new());
        Host { requests, receiver, self_tests: Vec::new(), maps: Vec::new(), overruns: 0 }
    }
}

impl Link for Host {
    fn try_read(&mut self, buffer: &mut [u8]) -> usize {
        let count = self.requests.len().min(buffer.len());
        buffer[..count].copy_from_slice(&self.requests[..count]);
        self.requests.drain(..count);
        count
    }

    fn try_write(&mut self, bytes: &[u8]) -> usize {
        for byte in bytes {
            let Some(body) = self.receiver.push(*byte) else { continue };
            match decode::<(u32, Report)>(body.unwrap()).unwrap().1 {
                Report::SelfTest(report) => self.self_tests.push(report),
                Report::HealthMap(map) => self.maps.push(map),
                Report::Health(health) => self.overruns = health.overruns,
                _ => {}
            }
        }
        bytes.len()
    }
}

/// Runs until a time.
struct Until {
    clock: SimClock,
    end: Micros,
}

impl Clock for Until {
    fn now(&self) -> Micros {
        self.clock.now()
    }
}

impl Probe for Until {
    fn begin(&mut self, _: Stage) {}
}

impl Checksum for Until {}

impl Platform for Until {
    fn alive(&mut self) -> bool {
        self.now() < self.end
    }

    fn save(&mut self, _: &Settings<'_>) -> Result<Saved, &'static str> {
        Err("there is no flash")
    }

    fn reset_settings(&mut self, _: bool) -> Result<Saved, &'static str> {
        Err("there is no flash")
    }

    fn restart(&mut self) {
        self.end = self.now();
    }

    async fn idle(&mut self, until: Micros) {
        self.clock.advance_to(until.0.min(self.now().0 + 1000));
    }
}

/// Runs a board for this many frames of a script.
fn reported(garment: &Garment, script: &Script, frames: u32) -> Host {
    let info =
        BoardInfo { firmware: "", chip: "", pins: Pins::ANY, full_scale: 4095, link_bytes_per_s: 1_000_000 };
    let mut board = Box::new(Shipped::new(info, garment.clone(), Scene::shipped()).unwrap());
    let SimBoard { mut lines, delay, adc, clock, .. } = SimBoard::new(garment, script, script.seed).unwrap();
    let end = Micros((f64::from(frames) * FRAME_S * 1e6) as u64);
    let mut until = Until { clock: clock.clone(), end };
    let mut scan = MuxScan::<_, _, _, _, PINS, TAXELS>::new(&mut lines, delay, adc, clock);
    let mut host = Host::new();
    block_on(run(&mut scan, &mut host, &mut until, &mut board));
    host
}

/// Frame of a time.
fn frame(time: Micros) -> u32 {
    (time.0 as f64 / 1e6 / FRAME_S) as u32
}

/// Touches during which these faults occur.
fn breaking(faults: &[PinFault], seed: u64) -> Script {
    let mut script = varied(f64::from(BROKEN + 2 * SOON) * FRAME_S, seed);
    script.faults.from_s = f64::from(BROKEN) * FRAME_S;
    script.faults.pins = faults.to_vec();
    script
}

/// Each is identified and reported once, without an earlier report about a taxel. There was no fault at the
/// start.
#[test]
fn every_line_and_input_that_breaks_in_use_is_reported_as_itself_within_100_frames() {
    let garment = Garment::reference();
    let seeds = if super::is_campaign() { 10 } else { 1 };
    let (mut count, mut latest) = (0, 0);
    for (seed, fault) in (1..=seeds).flat_map(|seed| pin_faults(&garment).into_iter().map(move |f| (seed, f)))
    {
        let host = reported(&garment, &breaking(&[fault], seed), BROKEN + SOON);
        let [whole, broken] = &host.self_tests[..] else { panic!("{fault:?}: {:?}", host.self_tests) };
        assert_eq!(whole.findings, Findings { lines: 9, inputs: 4, faults: Default::default() });
        assert_eq!(broken.findings.faults, [fault]);
        let found = frame(broken.time);
        assert!((BROKEN..BROKEN + SOON).contains(&found), "{fault:?}: frame {found}");
        let accused: Vec<_> =
            host.maps.iter().filter(|map| map.time < broken.time && !map.taxels.is_empty()).collect();
        assert!(accused.is_empty(), "{fault:?}: {accused:?}");
        (count, latest) = (count + 1, latest.max(found - BROKEN));
    }
    println!(
        "{count} lines and inputs broke in use: each reported as itself, the last one after {latest} frames"
    );
}

/// Nothing touches the garment. Not detectable then: an input at ground of a garment that rests there.
#[test]
fn what_breaks_at_rest_is_reported_where_codes_can_show_it() {
    let garment = Garment::reference();
    for fault in pin_faults(&garment) {
        let mut script = breaking(&[fault], 2);
        script.touches.clear();
        let host = reported(&garment, &script, BROKEN + SOON);
        assert_eq!(host.self_tests.last().unwrap().findings.faults, [fault]);
        assert_eq!(host.maps.iter().map(|map| map.taxels.len()).sum::<usize>(), 0, "{fault:?}");
        if fault.fault == Fault::Grounded {
            (script.idle.base_code, script.idle.spread_counts) = (0.0, 0.0);
            let host = reported(&garment, &script, BROKEN + SOON);
            assert_eq!(host.self_tests.len(), 1);
        }
    }
}

/// Two faults in sequence: the second is reported ten seconds after the first at the latest.
#[test]
fn a_second_fault_is_reported_beside_the_first() {
    let garment = Garment::reference();
    let faults = [(2, Fault::StuckHigh), (27, Fault::Supplied)].map(|(pin, fault)| PinFault { pin, fault });
    let host = reported(&garment, &breaking(&faults, 3), BROKEN + SOON);
    assert_eq!(host.self_tests.last().unwrap().findings.faults, faults);
    assert_eq!(host.self_tests.len(), 2);
}

/// Full-scale pressure on the whole garment looks like inputs at the supply: it costs a frame, and nothing is
/// reported.
#[test]
fn pressure_everywhere_is_no_fault() {
    let garment = Garment::reference();
    let mut script = super::scripts::all_pressed(f64::from(BROKEN) * FRAME_S);
    script.touches.iter_mut().for_each(|touch| touch.force_n *= 10.0);
    let host = reported(&garment, &script, BROKEN + 4 * SOON);
    assert_eq!(host.self_tests.len(), 1);
    assert!(host.maps.iter().all(|map| map.taxels.is_empty()));
    assert!(host.overruns <= 1, "{}", host.overruns);
    // A stream of touches costs no frame.
    let host = reported(&garment, &varied(1000.0 * FRAME_S, 4), 1000);
    assert_eq!((host.self_tests.len(), host.overruns), (1, 0));
}
