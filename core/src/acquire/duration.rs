//! Bounds of the time that one round of the board's loop takes: its longest parts are a frame and a self-test
//! of the lines.

use super::rounds::{frame_us, read_by};
use super::{Plan, SWEEP_ADDRESSES};
use crate::garment::Circuit;
use core::fmt;

/// Time without a round of the loop after which the board restarts, ms.
pub const WATCHDOG_MS: u32 = 1000;

/// Longest accepted frame or self-test of the lines, ms: half of the watchdog's time. The rest of a round (a
/// frame perceived, messages encoded) takes less than a tenth of it.
pub const LONGEST_MS: u32 = WATCHDOG_MS / 2;

/// Longest conversion that the processor starts and stores, ns.
const ASKED_NS: u64 = 4_000;
/// Longest change of the select lines by the processor, ns.
const CHANGE_NS: u64 = 10_000;
/// Longest test of one line or input, ns: two waits of 0.1 ms, and reading the levels of all lines.
const EXAMINED_NS: u64 = 300_000;

/// Longest time of one frame of a plan, us: by DMA or by the processor, whichever is longer. The processor
/// reads plans with more addresses than the DMA's tables hold, and plans that are [`super::Unfit`] for other
/// reasons.
pub fn longest_frame_us(circuit: &Circuit, plan: &Plan) -> u64 {
    let (addresses, inputs) = read_by(circuit, plan);
    let conversions = inputs as u64 * u64::from(plan.depth.scans());
    let address_ns = u64::from(circuit.settle_ns()) + CHANGE_NS + conversions * ASKED_NS;
    let processor = (addresses * address_ns).div_ceil(1000);
    if addresses > SWEEP_ADDRESSES as u64 { processor } else { processor.max(frame_us(circuit, plan)) }
}

/// Longest time of a self-test of the circuit, us: all lines and inputs, and four corners of each block,
/// twice.
pub fn longest_self_test_us(circuit: &Circuit) -> u64 {
    let corners = 8 * circuit.selects().count() as u64;
    let pins = (circuit.lines().len() + read_by(circuit, &Plan::default()).1) as u64;
    let corner_ns = u64::from(circuit.settle_ns()) + CHANGE_NS + ASKED_NS * pins;
    (pins * EXAMINED_NS + corners * corner_ns).div_ceil(1000)
}

/// Error of a garment or plan with which the loop would not feed the watchdog in time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FrameTooLong {
    /// "a frame" or "a self-test"
    pub what: &'static str,
    /// Longest time of it, ms.
    pub ms: u64,
    /// The garment's `wiring.settle_ns`.
    pub settle_ns: u32,
    /// Scans per frame, from the scene's `plan.depth`.
    pub scans: u16,
}

impl fmt::Display for FrameTooLong {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let FrameTooLong { what, ms, settle_ns, scans } = self;
        write!(f, "{what} takes {ms} ms, at most {LONGEST_MS}: lower wiring.settle_ns ({settle_ns})")?;
        if *scans > 1 {
            write!(f, " or plan.depth (mean of {scans})")?;
        }
        Ok(())
    }
}

impl core::error::Error for FrameTooLong {}

/// Error if a frame or a self-test can take longer than [`LONGEST_MS`] with this wiring and plan.
#[inline(never)] // own frame: its stack is free again on return
pub fn check_duration(circuit: &Circuit, plan: &Plan) -> Result<(), FrameTooLong> {
    let settle_ns = circuit.settle_ns();
    let frame = ("a frame", longest_frame_us(circuit, plan), plan.depth.scans());
    let test = ("a self-test", longest_self_test_us(circuit), 1);
    for (what, us, scans) in [frame, test] {
        if us > 1000 * u64::from(LONGEST_MS) {
            return Err(FrameTooLong { what, ms: us.div_ceil(1000), settle_ns, scans });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::super::Depth;
    use super::*;
    use crate::garment::{Block, Garment, Layout, Line, Pins};
    use std::string::ToString;

    fn circuit(mut garment: Garment, settle_ns: u32) -> Circuit {
        garment.wiring.settle_ns = settle_ns;
        let layout = Layout::build(&garment, 2048, 4095).unwrap();
        Circuit::build(&garment, &layout, Pins::FEATHER).unwrap()
    }

    #[test]
    fn the_longest_frame_is_that_of_the_dma_or_of_the_processor() {
        let longest =
            |settle_ns, plan: &Plan| longest_frame_us(&circuit(Garment::reference(), settle_ns), plan);
        let plan = Plan::default();
        // 512 addresses of four inputs: 5.12 ms by DMA, by the processor at most this.
        assert_eq!(longest(3_000, &plan), 512 * (3 + 10 + 4 * 4));
        assert_eq!(longest(100_000, &Plan { panels: 0, ..plan }), 0);
        // A mean of eight settles once per address by the processor, eight times by DMA.
        let mean = Plan { depth: Depth::MeanOf8, ..plan };
        let slow = circuit(Garment::reference(), 100_000);
        assert_eq!(longest(100_000, &mean), frame_us(&slow, &mean));
        assert!(longest(100_000, &mean) > 8 * 512 * 100);
    }

    #[test]
    fn what_outlasts_half_of_the_watchdog_is_refused_with_its_time_and_both_settings() {
        let check = |settle_ns, depth| {
            check_duration(&circuit(Garment::reference(), settle_ns), &Plan { depth, ..Plan::default() })
        };
        assert_eq!(LONGEST_MS, 500);
        assert_eq!(check(900_000, Depth::Twelve), Ok(()));
        let slow = check(1_000_000, Depth::Twelve).unwrap_err().to_string();
        assert_eq!(slow, "a frame takes 526 ms, at most 500: lower wiring.settle_ns (1000000)");
        assert_eq!(check(100_000, Depth::MeanOf8), Ok(()));
        let mean = check(200_000, Depth::MeanOf8).unwrap_err().to_string();
        assert_eq!(
            mean,
            "a frame takes 854 ms, at most 500: lower wiring.settle_ns (200000) or plan.depth (mean of 8)"
        );
    }

    #[test]
    fn many_small_blocks_may_take_longer_to_examine_than_to_scan() {
        let mut garment = Garment::block();
        let one = garment.blocks[0].clone();
        let line = |pin| Line { pin, inverted: false };
        garment.wiring.block.lines = [8, 18, 19, 20, 24, 25].map(line).into();
        let single = |k| Block { rows: 1, columns: 1, row: k / 16, column: k % 16, select: k, ..one.clone() };
        garment.blocks = (0..64).map(single).collect();
        let why = check_duration(&circuit(garment, 2_500_000), &Plan::default()).unwrap_err();
        assert_eq!(why.what, "a self-test");
        assert!(longest_frame_us(&circuit(Garment::block(), 2_500_000), &Plan::default()) < 330_000);
    }
}
