//! Reads the garment on the RP2040: by DMA and PIO, at the converter's own speed and without the processor,
//! if the garment's wiring allows it; else by the processor.
//!
//! | file | what |
//! |---|---|
//! | `chain.rs` | DMA channels that trigger each other |
//! | `tables.rs` | their tables: levels of the select lines, destinations of codes |
//! | `select.rs` | PIO program that drives the select lines |
//! | `frames.rs` | frames in memory, and who may access them |
//! | `reflex.rs` | check of a sub-field, and the pins that it asserts |
//! | `lent.rs` | reports to the emulator which frame is read |
//!
//! Per address, a channel for each input takes one sample and stores it in the place of its taxel. Then the
//! next levels go out, and while the select lines settle the converter measures its own temperature. The
//! inputs and the thermometer are converted in turn without a pause: 512 addresses of four inputs take 5.12
//! ms. For lines that settle slowly, some rounds of conversions are discarded, see
//! [`Rounds`](taxel_core::acquire::Rounds).
//!
//! Codes of 8 bits are read in 12 bits, and shortened when the frame is lent. Storing bytes instead would not
//! make frames faster: a conversion takes 96 clocks for any number of bits (RP2040 datasheet, 4.9.2). It
//! would save 8 KB of the ring. But either widening the 2,048 bytes of each frame would cost as much as
//! shortening the codes does (some 18,000 cycles), or all code that reads them (conditioning, tare, health,
//! raw frames) would be needed twice.

mod chain;
mod frames;
mod lent;
mod reflex;
mod select;
mod tables;

pub use chain::DmaChain;
pub use frames::FrameBegin;

use crate::limits::{INPUTS, LINES};
use crate::{adc, pins, platform};
use core::pin::pin;
use embassy_futures::select::{Either, select};
use embassy_time::Timer;
use frames::Frames;
use taxel_core::acquire::{Acquire, Depth, Mux, Plan, Scan, ScanError, ScanReport, longest_frame_us};
use taxel_core::garment::Circuit;
use taxel_core::reflex::{Early, Reflexes};
use taxel_core::selftest::{Examine, Findings};

/// The scanner that works by the processor, in the memory of the chain, which stands still meanwhile.
pub type Processor =
    Mux<'static, pins::LinePin, platform::Settle, adc::Converter<INPUTS>, platform::Timer, LINES>;

/// Margin on the longest duration of a frame, us.
const SPARE_US: u64 = 5_000;

/// Active scanner.
enum By {
    Nobody,
    Chain,
    Processor,
}

/// Reads the garment, by the chain or by the processor.
pub struct Scanner {
    processor: Processor,
    chain: DmaChain,
    frames: Frames,
    by: By,
    /// Circuit that is being scanned.
    circuit: Option<Circuit>,
    plan: Plan,
    /// Greatest time to wait for a frame, us.
    patience_us: u64,
    /// True if a select line showed another level than it was driven to.
    misled: bool,
    looks: u32,
}

impl Scanner {
    /// Builds on the processor's scan, whose pins and converter the chain uses.
    pub fn new(processor: Processor, chain: DmaChain) -> Scanner {
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

    /// Starts to scan a circuit by a plan.
    #[inline(never)] // out of line: a copy of the circuit is on the stack only during the call
    fn begin(&mut self, circuit: &Circuit, plan: &Plan) {
        self.chain.stop();
        self.frames.reset(self.circuit.as_ref() == Some(circuit));
        self.by = match self.chain.start(circuit, plan, &mut self.frames) {
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

    /// Waits for the latest frame of the chain that was not read yet. During every fourth one it checks the
    /// select lines, each time at another moment.
    async fn next(&mut self) -> Result<Scan<'_>, ScanError> {
        let depth = self.plan.depth;
        self.looks = self.looks.wrapping_add(1);
        let mut next = pin!(self.frames.next(depth.scans()));
        let mut frame = None;
        if self.looks & 3 == 0 {
            // Multiples of the golden ratio are spread evenly, over 4 of a frame's 5 ms.
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
            By::Processor => {
                let codes = self.frames.still();
                let report = self.processor.scan(circuit, plan, codes)?;
                Ok(Scan { codes, report })
            }
            By::Chain | By::Nobody => self.next().await,
        }?;
        lent::mark(scan.codes);
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
        reflex::take_early()
    }

    fn rest(&mut self) {
        self.chain.stop();
        self.by = By::Nobody;
    }
}

impl Examine for Scanner {
    /// Examines by the processor, after stopping the chain.
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
