//! Reading the garment on the RP2040: by DMA and PIO, at the converter's own speed and without the processor,
//! wherever the garment's wiring allows that; else by the processor.
//!
//! | file | what |
//! |---|---|
//! | `chain.rs` | the DMA channels that trigger each other |
//! | `tables.rs` | what they read: levels of the select lines, and where codes go |
//! | `select.rs` | the PIO program that puts levels on the select lines |
//! | `frames.rs` | where the codes end up, and who may read which frame |
//! | `reflex.rs` | the check of a sub-field, and the pins that it asserts |
//! | `lent.rs` | tells the emulator which frame is read |
//!
//! Per address: a channel for each input takes one sample and stores it where its taxel's code belongs, then
//! the next levels go out, and while the select lines settle the converter measures its own temperature. The
//! inputs and the thermometer are converted in turn without a pause: 512 addresses of four inputs take 5.12
//! ms. Lines that settle slowly are converted in vain for some rounds, as
//! [`Rounds`](taxel_core::acquire::Rounds) says.
//!
//! Codes of 8 bits come the same way, and are shortened when the frame is lent. To store bytes instead would
//! not give a frame more: a conversion takes 96 clocks whatever is kept of it (RP2040 datasheet, 4.9.2). It
//! would save 8 KB of the ring, and either cost as much to widen the 2,048 bytes of each frame as shortening
//! the codes does (some 18,000 cycles), or everything that reads codes would have to exist twice:
//! conditioning, tare, health, raw frames.

mod chain;
mod frames;
mod lent;
mod reflex;
mod select;
mod tables;

pub use chain::Chain;
pub use frames::Begun;

use crate::{adc, board, pins, platform};
use core::pin::pin;
use embassy_futures::select::{Either, select};
use embassy_time::Timer;
use frames::Frames;
use taxel_core::acquire::{Acquire, Depth, MuxScan, Plan, Scan, ScanError, ScanReport, longest_frame_us};
use taxel_core::garment::Circuit;
use taxel_core::reflex::{Early, Reflexes};
use taxel_core::selftest::{Examine, Findings};

/// The scan by the processor.
pub type Processor = MuxScan<
    'static,
    pins::Line,
    platform::Settle,
    adc::Converter<{ board::INPUTS }>,
    platform::Timer,
    { board::LINES },
    { crate::TAXELS },
>;

/// What a frame may take longer than it can, us.
const SPARE_US: u64 = 5_000;

/// Who scans.
enum By {
    Nobody,
    Chain,
    Processor,
}

/// Reads the garment.
pub struct Scanner {
    processor: Processor,
    chain: Chain,
    frames: Frames,
    by: By,
    /// What is being scanned.
    circuit: Option<Circuit>,
    plan: Plan,
    /// Time in which a frame must come, us.
    patience_us: u64,
    /// A select line showed another level than it was driven to.
    misled: bool,
    looks: u32,
}

impl Scanner {
    /// Over the processor's scan, of whose pins and converter the chain makes use.
    pub fn new(processor: Processor, chain: Chain) -> Scanner {
        Scanner {
            processor,
            chain,
            frames: Frames::take(),
            by: By::Nobody,
            circuit: None,
            plan: Plan::default(),
            patience_us: 0,
            misled: false,
            looks: 0,
        }
    }

    /// Begins to scan something else, or the same anew.
    #[inline(never)] // a copy of the circuit is on the stack only meanwhile
    fn begin(&mut self, circuit: &Circuit, plan: &Plan) {
        self.chain.stop();
        self.frames.reset(self.circuit.as_ref() == Some(circuit));
        self.by = match self.chain.start(circuit, plan, &self.frames) {
            Ok(()) => By::Chain,
            Err(why) => {
                defmt::info!("the processor scans this garment: {}", defmt::Display2Format(&why));
                By::Processor
            }
        };
        self.circuit = Some(circuit.clone());
        self.plan = *plan;
        self.patience_us = longest_frame_us(circuit, plan) + SPARE_US;
    }

    /// The latest frame of the chain that was not read yet. In every fourth one, at another time of each, the
    /// select lines are looked at.
    async fn next(&mut self) -> Result<Scan<'_>, ScanError> {
        let depth = self.plan.depth;
        self.looks = self.looks.wrapping_add(1);
        let mut next = pin!(self.frames.next(depth.scans()));
        let mut frame = None;
        if self.looks & 3 == 0 {
            // Multiples of the golden ratio are spread evenly: over 4 of a frame's 5 ms.
            let look = Timer::after_micros(u64::from(self.looks.wrapping_mul(0x9e37_79b9) >> 20));
            match select(next.as_mut(), look).await {
                Either::First(early) => frame = Some(early),
                Either::Second(()) => self.misled |= self.chain.misleads(),
            }
        }
        let frame = match frame {
            Some(frame) => frame,
            None => match select(next, Timer::after_micros(self.patience_us)).await {
                Either::First(frame) => frame,
                Either::Second(()) => Err(ScanError::Stalled),
            },
        };
        let (codes, lent) = frame.inspect_err(|_| self.by = By::Nobody)?;
        if !matches!(depth, Depth::Twelve | Depth::Interlaced) {
            codes.iter_mut().for_each(|code| code.0 = depth.mean(code.0));
        }
        let report = ScanReport {
            start: lent.start,
            duration_us: lent.duration_us,
            overruns: lent.missed,
            temperature: Some(adc::celsius(tables::thermometer())),
        };
        Ok(Scan { codes, report })
    }
}

impl Acquire for Scanner {
    async fn scan(&mut self, circuit: &Circuit, plan: &Plan) -> Result<Scan<'_>, ScanError> {
        if self.plan != *plan || matches!(self.by, By::Nobody) {
            self.begin(circuit, plan);
        }
        let scan = match self.by {
            By::Processor => self.processor.scan(circuit, plan).await,
            By::Chain | By::Nobody => self.next().await,
        }?;
        lent::tell(scan.codes);
        Ok(scan)
    }

    fn drive(&mut self, pin: u8, level: bool) -> Result<(), ScanError> {
        let driven = self.processor.drive(pin, level);
        reflex::driven(pin, level);
        driven
    }

    fn watch(&mut self, reflexes: Option<&Reflexes>, active: u8, limit: impl Fn(u16) -> Option<u16>) {
        reflex::watch(reflexes, active, limit);
    }

    fn reflex(&mut self) -> Option<Early> {
        reflex::told()
    }

    fn rest(&mut self) {
        self.chain.stop();
        self.by = By::Nobody;
    }
}

impl Examine for Scanner {
    /// By the processor; the chain stands still.
    fn examine(&mut self, circuit: &Circuit) -> Result<Findings, ScanError> {
        self.rest();
        self.processor.examine(circuit)
    }

    fn pose(&mut self, circuit: &Circuit) {
        if matches!(self.by, By::Processor) {
            self.processor.pose(circuit);
        }
    }

    fn is_misled(&mut self) -> bool {
        core::mem::take(&mut self.misled) || matches!(self.by, By::Processor) && self.processor.is_misled()
    }
}
