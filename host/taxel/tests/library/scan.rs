//! The portable scan: the exact order of pins, delays and conversions on mocked hardware, and its codes on
//! the simulated board.

use embedded_hal::delay::DelayNs;
use embedded_hal::digital::{ErrorType, OutputPin};
use embedded_hal_mock::common::Generic;
use embedded_hal_mock::eh1::MockError;
use embedded_hal_mock::eh1::digital::{Mock as PinMock, State, Transaction as PinTransaction};
use std::cell::RefCell;
use std::future::Future;
use std::pin::pin;
use std::rc::Rc;
use std::task::{Context, Poll, Waker};
use taxel::files::scripts::{garment as garment_of, load};
use taxel::sim::{FRAME_PERIOD_US, PINS, Script, SimBoard, World, frame_codes, refit};
use taxel_core::acquire::{Acquire, Adc, Clock, Lines, MuxScan, Plan, ScanError};
use taxel_core::format::Micros;
use taxel_core::garment::{Circuit, Coding, Garment, Layout, Line, Pins};

/// Runs a future that never waits.
fn block_on<F: Future>(future: F) -> F::Output {
    let mut future = pin!(future);
    loop {
        if let Poll::Ready(output) = future.as_mut().poll(&mut Context::from_waker(Waker::noop())) {
            return output;
        }
    }
}

fn circuit(garment: &Garment) -> Circuit {
    let layout = Layout::build(garment, 2048, 4095).unwrap();
    Circuit::build(garment, &layout, Pins::ANY).unwrap()
}

/// An operation on the board.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Event {
    Set(u8, bool),
    Delay(u32),
    Read(u8),
}

type Log = Rc<RefCell<Vec<Event>>>;

/// A mocked pin that also records when it was driven.
struct Probe {
    number: u8,
    mock: PinMock,
    log: Log,
}

impl ErrorType for Probe {
    type Error = MockError;
}

impl OutputPin for Probe {
    fn set_low(&mut self) -> Result<(), MockError> {
        self.log.borrow_mut().push(Event::Set(self.number, false));
        self.mock.set_low()
    }

    fn set_high(&mut self) -> Result<(), MockError> {
        self.log.borrow_mut().push(Event::Set(self.number, true));
        self.mock.set_high()
    }
}

struct Delay(Log);

impl DelayNs for Delay {
    fn delay_ns(&mut self, ns: u32) {
        self.0.borrow_mut().push(Event::Delay(ns));
    }
}

/// A mocked converter: the inputs expected to be read, and the answers.
struct Converter {
    mock: Generic<(u8, Result<u16, ()>)>,
    log: Log,
}

impl Adc for Converter {
    type Error = ();

    fn read(&mut self, input: u8) -> Result<u16, ()> {
        self.log.borrow_mut().push(Event::Read(input));
        let (expected, answer) = self.mock.next().expect("one read too many");
        assert_eq!(input, expected);
        answer
    }
}

struct Still;

impl Clock for Still {
    fn now(&self) -> Micros {
        Micros(0)
    }
}

/// A mocked board. `levels` are the pins with the levels expected to be driven, in order.
struct Bench {
    mocks: Vec<PinMock>,
    adc: Generic<(u8, Result<u16, ()>)>,
    log: Log,
    lines: Lines<Probe, PINS>,
}

impl Bench {
    fn new(pins: &[(u8, Vec<PinTransaction>)], reads: &[(u8, Result<u16, ()>)]) -> Bench {
        let log = Log::default();
        let mocks: Vec<PinMock> = pins.iter().map(|(_, expected)| PinMock::new(expected)).collect();
        let probe =
            |(number, mock): (u8, &PinMock)| (number, Probe { number, mock: mock.clone(), log: log.clone() });
        let lines = Lines::new(pins.iter().map(|(number, _)| *number).zip(&mocks).map(probe));
        Bench { mocks, adc: Generic::new(reads), log, lines }
    }

    /// Scans one or more times, checks that every expectation was met, and returns the codes and the
    /// operations.
    fn scan(mut self, garment: &Garment, times: usize) -> (Result<Vec<u16>, ScanError>, Vec<Event>) {
        let circuit = circuit(garment);
        let converter = Converter { mock: self.adc.clone(), log: self.log.clone() };
        let mut scan =
            MuxScan::<_, _, _, _, PINS, 64>::new(&mut self.lines, Delay(self.log.clone()), converter, Still);
        let mut result = Ok(Vec::new());
        for _ in 0..times {
            result = block_on(scan.scan(&circuit, &Plan::default()))
                .map(|scan| scan.codes.iter().map(|code| code.0).collect());
        }
        drop(scan);
        self.adc.done();
        self.mocks.iter_mut().for_each(PinMock::done);
        (result, self.log.take())
    }
}

/// The block of 4 x 16 with its rows behind a decoder: binary on GP7 and GP8.
fn binary_block() -> Garment {
    let mut garment = Garment::block();
    garment.wiring.row = Garment::reference().wiring.row;
    garment
}

fn set(level: bool) -> PinTransaction {
    PinTransaction::set(if level { State::High } else { State::Low })
}

#[test]
fn one_block_is_scanned_in_exactly_this_order() {
    // Rows on GP7 and GP8, columns on GP9 to GP12. Every line is driven once at the start, later only at a
    // change: column bit k changes every 2^k addresses, row bit k every 16 * 2^k.
    let mut expected = vec![];
    for address in 0..64u32 {
        for bit in [4, 5, 0, 1, 2, 3] {
            let pin = if bit < 4 { 9 + bit } else { 3 + bit } as u8;
            let level = address >> bit & 1 == 1;
            if address == 0 || level != ((address - 1) >> bit & 1 == 1) {
                expected.push(Event::Set(pin, level));
            }
        }
        expected.extend([Event::Delay(8_000), Event::Read(26)]);
    }
    let driven = |pin: u8| {
        let of_pin = |event: &Event| match event {
            Event::Set(number, level) if *number == pin => Some(set(*level)),
            _ => None,
        };
        (pin, expected.iter().filter_map(of_pin).collect::<Vec<_>>())
    };
    let pins: Vec<_> = [7, 8, 9, 10, 11, 12].map(driven).into();
    assert_eq!(pins.iter().map(|(_, t)| t.len()).collect::<Vec<_>>(), [4, 2, 64, 32, 16, 8]);
    let reads: Vec<_> = (0..64).map(|taxel| (26, Ok(taxel * 10))).collect();
    let (codes, events) = Bench::new(&pins, &reads).scan(&binary_block(), 1);
    assert_eq!(codes.unwrap(), (0..64).map(|taxel| taxel * 10).collect::<Vec<_>>());
    assert_eq!(events, expected);
    let first: Vec<String> = events.iter().take(12).map(|e| format!("{e:?}")).collect();
    assert_eq!(
        first.join(" "),
        "Set(7, false) Set(8, false) Set(9, false) Set(10, false) Set(11, false) Set(12, false) Delay(8000) Read(26) \
         Set(9, true) Delay(8000) Read(26) Set(9, false)"
    );
}

#[test]
fn a_second_scan_drives_only_what_changed() {
    let mut garment = binary_block();
    garment.panels[0].rows = 1;
    garment.panels[0].columns = 2;
    garment.blocks[0].rows = 1;
    garment.blocks[0].columns = 2;
    let pins: Vec<_> = (7..13)
        .map(|pin| {
            (
                pin,
                [false, true, false, true][..if pin == 9 { 4 } else { 1 }].iter().map(|l| set(*l)).collect(),
            )
        })
        .collect();
    let reads = [(26, Ok(1)), (26, Ok(2)), (26, Ok(3)), (26, Ok(4))];
    let (codes, events) = Bench::new(&pins, &reads).scan(&garment, 2);
    assert_eq!(codes.unwrap()[..3], [3, 4, 0]);
    assert_eq!(events.iter().filter(|e| matches!(e, Event::Set(..))).count(), 6 + 3);
}

/// Two blocks of 2 x 3 on two inputs: one-hot rows on inverted lines GP12 and GP13, a column multiplexer on
/// GP3 and GP4 whose high bit is inverted, one enable of each polarity.
fn mixed() -> Garment {
    let mut garment = binary_block();
    let wiring = &mut garment.wiring;
    wiring.row.coding = Coding::OneHot;
    wiring.row.lines = [12, 13].map(|pin| Line { pin, inverted: true }).into_iter().collect();
    wiring.column.lines =
        [(3, false), (4, true)].map(|(pin, inverted)| Line { pin, inverted }).into_iter().collect();
    wiring.enable =
        [(20, false), (21, true)].map(|(pin, inverted)| Line { pin, inverted }).into_iter().collect();
    wiring.settle_ns = 500;
    garment.panels[0].rows = 4;
    garment.panels[0].columns = 3;
    let mut block = garment.blocks[0].clone();
    block.rows = 2;
    block.columns = 3;
    garment.blocks.clear();
    for (row, input) in [(0, 26), (2, 28)] {
        block.row = row;
        block.input = input;
        garment.blocks.push(block.clone()).unwrap();
    }
    garment
}

#[test]
fn one_hot_rows_inverted_lines_and_enables() {
    let levels = |pin: u8| -> &[bool] {
        match pin {
            12 => &[false, true],
            13 => &[true, false],
            3 => &[false, true, false, true, false],
            4 => &[true, false, true, false],
            20 => &[true],
            _ => &[false],
        }
    };
    let pins: Vec<_> =
        [3, 4, 12, 13, 20, 21].map(|pin| (pin, levels(pin).iter().map(|l| set(*l)).collect())).into();
    let reads: Vec<_> = (0..12).map(|k| ([26, 28][k % 2], Ok(k as u16 / 2 + 100 * (k as u16 % 2)))).collect();
    let (codes, events) = Bench::new(&pins, &reads).scan(&mixed(), 1);
    assert_eq!(codes.unwrap()[..12], [0, 1, 2, 3, 4, 5, 100, 101, 102, 103, 104, 105]);
    use Event::{Delay, Read, Set};
    let start = [Set(12, false), Set(13, true), Set(3, false), Set(4, true), Set(20, true), Set(21, false)];
    let steps: [&[Event]; 6] = [
        &start,
        &[Set(3, true)],
        &[Set(3, false), Set(4, false)],
        &[Set(12, true), Set(13, false), Set(4, true)],
        &[Set(3, true)],
        &[Set(3, false), Set(4, false)],
    ];
    let expected: Vec<Event> =
        steps.iter().flat_map(|step| [*step, &[Delay(500), Read(26), Read(28)]].concat()).collect();
    assert_eq!(events, expected);
}

#[test]
fn errors_name_the_line_and_the_taxel() {
    let broken = MockError::Io(std::io::ErrorKind::BrokenPipe);
    let mut pins: Vec<_> = (7..13).map(|pin| (pin, vec![set(false)])).collect();
    // GP9, the lowest column bit, fails as it is to select taxel 1.
    pins[2].1.push(set(true).with_error(broken));
    let (result, events) = Bench::new(&pins, &[(26, Ok(1))]).scan(&binary_block(), 1);
    assert_eq!(result, Err(ScanError::Line { pin: 9, taxel: 1 }));
    assert_eq!(result.unwrap_err().to_string(), "select line on pin 9 cannot be driven (at taxel 1)");
    assert_eq!(events.last(), Some(&Event::Set(9, true)));

    let pins: Vec<_> = (7..13)
        .map(|pin| (pin, if pin == 9 { vec![set(false), set(true)] } else { vec![set(false)] }))
        .collect();
    let (result, _) = Bench::new(&pins, &[(26, Ok(1)), (26, Err(()))]).scan(&binary_block(), 1);
    assert_eq!(result, Err(ScanError::Converter { input: 26, taxel: 1 }));
    assert_eq!(result.unwrap_err().to_string(), "converter input on pin 26 gave no sample (at taxel 1)");

    let pins: Vec<_> = (7..12).map(|pin| (pin, vec![])).collect();
    let (result, _) = Bench::new(&pins, &[]).scan(&binary_block(), 1);
    assert_eq!(result, Err(ScanError::NoPin(12)));
}

#[test]
fn after_a_failed_line_every_line_is_driven_anew() {
    let broken = MockError::Io(std::io::ErrorKind::BrokenPipe);
    let mut garment = binary_block();
    garment.panels[0].rows = 1;
    garment.panels[0].columns = 2;
    garment.blocks[0].rows = 1;
    garment.blocks[0].columns = 2;
    let mut pins: Vec<_> = (7..13).map(|pin| (pin, vec![set(false), set(false)])).collect();
    pins[2].1 = vec![set(false), set(true).with_error(broken), set(false), set(true)];
    let (codes, _) = Bench::new(&pins, &[(26, Ok(1)), (26, Ok(2)), (26, Ok(3))]).scan(&garment, 2);
    assert_eq!(codes.unwrap()[..2], [2, 3]);
}

/// Frames of a script as the portable scan reads them from the simulated board.
fn scanned(script: &Script, garment: &Garment, frames: usize) -> Vec<u16> {
    let circuit = circuit(garment);
    let taxels = Layout::build(garment, 2048, 4095).unwrap().taxels();
    let SimBoard { mut lines, delay, adc, clock, .. } = SimBoard::new(garment, script, script.seed).unwrap();
    let mut scan = MuxScan::<_, _, _, _, PINS, 2048>::new(&mut lines, delay, adc, clock.clone());
    let mut codes = Vec::new();
    for frame in 0..frames {
        clock.advance_to(frame as u64 * FRAME_PERIOD_US);
        let scan = block_on(scan.scan(&circuit, &Plan::default())).unwrap();
        assert_eq!(scan.report.start, Micros(frame as u64 * FRAME_PERIOD_US), "the scan is too slow");
        codes.extend(scan.codes[..taxels].iter().map(|code| code.0));
    }
    codes
}

fn scene(name: &str, garment: &Garment, changes: impl FnOnce(&mut Script)) -> Script {
    let layout = Layout::build(garment, 2048, 4095).unwrap();
    let script = load(name).unwrap();
    let home = Layout::build(&garment_of(&script).unwrap(), 2048, 4095).unwrap();
    let mut script = refit(&script, &home, &layout);
    changes(&mut script);
    script
}

#[test]
fn the_scan_reads_what_the_scene_holds() {
    for garment in [Garment::reference(), Garment::mat()] {
        for name in ["pat", "five"] {
            let script = scene(name, &garment, |s| s.idle.noise_counts = 0.0);
            let codes = scanned(&script, &garment, 60);
            assert_eq!(codes, frame_codes(&script, &garment, FRAME_PERIOD_US, 60).unwrap(), "{name}");
            assert!(codes.iter().max() > Some(&150), "{name}");
        }
        let noisy = scene("five", &garment, |_| {});
        assert_eq!(
            scanned(&noisy, &garment, 20),
            frame_codes(&noisy, &garment, FRAME_PERIOD_US, 20).unwrap()
        );
    }
}

#[test]
fn a_scan_of_the_reference_garment_takes_5120_us() {
    let garment = Garment::reference();
    let script = load("idle").unwrap();
    let SimBoard { mut lines, delay, adc, clock, .. } = SimBoard::new(&garment, &script, 1).unwrap();
    let mut scan = MuxScan::<_, _, _, _, PINS, 2048>::new(&mut lines, delay, adc, clock);
    let circuit = circuit(&garment);
    assert_eq!(block_on(scan.scan(&circuit, &Plan::default())).unwrap().report.duration_us, 5_120);
    let half = Plan { panels: 0b0011, ..Plan::default() };
    assert_eq!(block_on(scan.scan(&circuit, &half)).unwrap().report.duration_us, 512 * 6);
}

/// The last of 60 frames of a hard box on the chest without noise; untouched taxels are at 90.
fn wired(effects: impl FnOnce(&mut Script)) -> Vec<u16> {
    let garment = Garment::reference();
    let script = scene("box", &garment, |s| {
        s.idle.noise_counts = 0.0;
        s.idle.spread_counts = 0.0;
        s.touches[0].start_s = 0.1;
        s.touches[0].rise_s = 0.05;
        effects(s);
    });
    let codes = scanned(&script, &garment, 60);
    assert_eq!(codes, frame_codes(&script, &garment, FRAME_PERIOD_US, 60).unwrap());
    codes[59 * 2048..].to_vec()
}

#[test]
fn a_slow_line_smears_along_the_scan() {
    let ideal = wired(|_| {});
    // 10 kOhm and 100 pF are 1 us: after 2 us of settling, 13.5 % of the difference from the previous taxel
    // is left.
    let slow = wired(|s| {
        s.wiring.source_kohm = 10.0;
        s.wiring.line_pf = 100.0;
    });
    let fast = wired(|s| {
        s.wiring.source_kohm = 1.0;
        s.wiring.line_pf = 100.0;
    });
    assert_eq!(ideal[512..], slow[512..], "the other inputs stay as they are");
    assert!(ideal[..512].iter().zip(&fast[..512]).skip(1).all(|(a, b)| a.abs_diff(*b) <= 1));
    let mut worst = 0f64;
    for taxel in 1..512 {
        let (before, here) = (f64::from(ideal[taxel - 1]), f64::from(ideal[taxel]));
        // The line continues to settle while the other inputs are read, so the residue is that of the
        // previous taxel.
        let expected = here + (before - here) * (-2f64).exp();
        worst = worst.max((f64::from(slow[taxel]) - expected).abs());
    }
    assert!(worst < 2.0, "{worst}");
    assert!((1..512).any(|t| slow[t].abs_diff(ideal[t]) > 20));
}

#[test]
fn crosstalk_makes_ghosts_on_the_rows_and_columns_of_the_block() {
    let ideal = wired(|_| {});
    let crossed = wired(|s| s.wiring.crosstalk = 0.05);
    for taxel in 0..512usize {
        let (row, column, block) = (taxel / 16, taxel % 16, taxel / 64);
        let mates =
            (0..512usize).filter(|t| *t != taxel && (t / 16 == row || t / 64 == block && t % 16 == column));
        let sum: f64 = mates.map(|t| f64::from(ideal[t]) - 90.0).sum();
        let expected = f64::from(ideal[taxel]) + 0.05 * sum;
        assert!((f64::from(crossed[taxel]) - expected).abs() < 2.0, "taxel {taxel}");
    }
    assert!((0..512).any(|t| ideal[t] == 90 && crossed[t] > 110));
}

#[test]
fn the_converter_of_the_rp2040_has_wide_codes() {
    let garment = binary_block();
    let text = "duration_s = 1\n[idle]\nbase_code = 520\nspread_counts = 0\nnoise_counts = 0\n[converter]\ndnl = true";
    let script = taxel::files::scripts::parse(text, "dnl.toml").unwrap();
    assert!(scanned(&script, &garment, 1).iter().all(|code| *code < 517));
    let at_spike = |base: f64| {
        let mut script = script.clone();
        script.idle.base_code = base;
        World::build(&script, &garment).unwrap().code(0, 0)
    };
    assert_eq!([509.0, 511.0, 513.0, 515.0].map(at_spike), [512; 4]);
}
