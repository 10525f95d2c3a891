//! Time of a frame with a converter that runs freely. One model for three users: the firmware sets up its DMA
//! chain by it, the simulated board runs by it, and the host predicts a garment's frame rate.
//!
//! The converter (RP2040 datasheet, 4.9) converts the inputs of the plan and its thermometer in turn and
//! never stops. The select lines change when the last input has been converted. The first input that counts
//! afterwards is converted one thermometer later, after 2 us. If a line needs longer, some rounds of
//! conversions are dropped; the rest of the time, less than a round, is gained by a slower pace of all
//! conversions.
//!
//! | inputs | `settle_ns` | rounds | pace | settled for | address |
//! |---|---|---|---|---|---|
//! | 4 | 3,000 | 1 | 2 us | 2 us | 10 us |
//! | 4 | 8,000 | 2 | 2 us | 12 us | 20 us |
//! | 4 | 34,000 | 4 | 2.125 us | 34.125 us | 42.5 us |
//! | 1 | 34,000 | 9 | 2 us | 34 us | 36 us |

use super::Plan;
use crate::garment::Circuit;

/// Clocks of a conversion at 48 MHz: 2 us.
pub const CONVERSION_CLOCKS: u32 = 96;
/// Time of a conversion, ns.
pub const CONVERSION_NS: u32 = ns(CONVERSION_CLOCKS as u64) as u32;

/// Number of rounds in which the inputs are converted at one address, and their pace.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rounds {
    /// Conversions per round: the inputs and the thermometer.
    conversions: u32,
    /// Rounds per address, of which the last counts: at least 1.
    pub rounds: u32,
    /// Clocks from the start of a conversion to the start of the next: 96 to 336.
    pub period_clocks: u32,
}

impl Rounds {
    /// Returns the rounds for a number of inputs (at most 255 count) and a garment's settling time, of which
    /// whole conversions count, at least one.
    pub const fn of(inputs: usize, settle_ns: u32) -> Rounds {
        let conversions = if inputs < 255 { inputs as u32 + 1 } else { 256 };
        let slots = settle_ns / CONVERSION_NS;
        let slots = if slots == 0 { 1 } else { slots };
        // One more round at the converter's own pace, or a slower pace: the faster of the two.
        let slower = Rounds::paced(conversions, (slots - 1) / conversions + 1, slots);
        let longer = Rounds::paced(conversions, slower.rounds + 1, slots);
        if longer.address_clocks() <= slower.address_clocks() { longer } else { slower }
    }

    /// Returns the fastest pace at which `rounds` rounds give time for `slots` conversions.
    const fn paced(conversions: u32, rounds: u32, slots: u32) -> Rounds {
        let until = (slots as u64 + 1) * CONVERSION_CLOCKS as u64;
        let starts = conversions as u64 * rounds.saturating_sub(1) as u64 + 2;
        let needed = until.div_ceil(starts) as u32;
        let period_clocks = if needed > CONVERSION_CLOCKS { needed } else { CONVERSION_CLOCKS };
        Rounds { conversions, rounds, period_clocks }
    }

    /// Samples of an address that are dropped before the thermometer and the inputs that count.
    pub const fn dropped(&self) -> u32 {
        self.conversions.saturating_mul(self.rounds - 1)
    }

    /// Time from the change of the select lines, at the end of the last input's conversion, to the sample of
    /// the first input that counts, ns.
    pub const fn settling_ns(&self) -> u64 {
        let starts = self.dropped() as u64 + 2;
        ns(starts * self.period_clocks as u64 - CONVERSION_CLOCKS as u64)
    }

    /// Time between samples, ns.
    pub const fn period_ns(&self) -> u64 {
        ns(self.period_clocks as u64)
    }

    /// Time between addresses, ns.
    pub const fn address_ns(&self) -> u64 {
        ns(self.address_clocks())
    }

    const fn address_clocks(&self) -> u64 {
        self.conversions as u64 * self.rounds as u64 * self.period_clocks as u64
    }
}

/// Converts clocks of 48 MHz to ns, rounded down.
const fn ns(clocks: u64) -> u64 {
    clocks * 125 / 6
}

/// Time from the start of one frame of a plan to the next, us, with a free-running converter. A mean of
/// several scans takes as many times as long. A plan that reads nothing takes 0.
///
/// The processor reads a garment whose wiring the DMA chain cannot follow (see [`super::Unfit`]). It waits
/// for the exact settling time, takes 2.2 us for a sample, and 5 us to drive the lines of an address: 8.6 ms
/// for the reference garment with a mirrored panel (emulated), where this function returns 5.12.
pub fn frame_us(circuit: &Circuit, plan: &Plan) -> u64 {
    let (addresses, inputs) = read_by(circuit, plan);
    let rounds = Rounds::of(inputs, circuit.settle_ns());
    let clocks = rounds.address_clocks() * addresses * u64::from(plan.depth.scans());
    ns(clocks) / 1000
}

/// Returns the number of addresses of a frame, and of inputs converted at each.
pub(super) fn read_by(circuit: &Circuit, plan: &Plan) -> (u64, usize) {
    let mut inputs = 0u64;
    let mut addresses = 0u64;
    for sites in circuit.selects() {
        let read = || sites.iter().filter(|site| plan.reads(site.panel, site.block));
        let most = |of: fn(&crate::garment::Site) -> u8| read().map(of).max().map_or(0, u64::from);
        addresses += most(|site| site.rows) * most(|site| site.columns);
        inputs = read().fold(inputs, |inputs, site| inputs | 1 << (site.input & 63));
    }
    (addresses, inputs.count_ones() as usize)
}

#[cfg(test)]
mod tests {
    use super::super::{Depth, Sweep};
    use super::*;
    use crate::garment::{Garment, Layout, Pins};

    #[test]
    fn an_address_is_read_as_the_table_says() {
        let row = |inputs, settle_ns| {
            let r = Rounds::of(inputs, settle_ns);
            (r.rounds, r.period_ns(), r.settling_ns(), r.address_ns())
        };
        assert_eq!(row(4, 3_000), (1, 2_000, 2_000, 10_000));
        assert_eq!(row(4, 8_000), (2, 2_000, 12_000, 20_000));
        assert_eq!(row(4, 34_000), (4, 2_125, 34_125, 42_500));
        assert_eq!(row(1, 34_000), (9, 2_000, 34_000, 36_000));
        assert_eq!(row(4, 0), row(4, 3_999));
        assert_eq!(CONVERSION_NS, 2_000);
    }

    /// Every settling time is reached, none takes longer than by a slower pace alone (except for the rounding
    /// to whole clocks), and the excess over the least time is bounded.
    #[test]
    fn every_settling_is_given_at_a_bounded_price() {
        for inputs in 1..=4 {
            let least = |slots: u64| (slots + inputs as u64) * u64::from(CONVERSION_NS);
            for settle_ns in (0..400_000).step_by(500) {
                let rounds = Rounds::of(inputs, settle_ns);
                let slots = u64::from(settle_ns / CONVERSION_NS).max(1);
                assert!(rounds.settling_ns() >= slots * u64::from(CONVERSION_NS));
                assert!((CONVERSION_CLOCKS..=336).contains(&rounds.period_clocks));
                let paced = Rounds::paced(inputs as u32 + 1, 1, slots as u32);
                assert!(rounds.address_clocks() <= paced.address_clocks() * 97 / 96);
                // At most three sevenths (four inputs that need 6 us); a tenth from ten conversions on.
                let over = rounds.address_ns() as f64 / least(slots) as f64 - 1.0;
                let most = if slots < 10 { 0.43 } else { 0.1 };
                assert!(over <= most, "{inputs} inputs, {settle_ns} ns: {over}");
            }
            let longest = Rounds::of(inputs, u32::MAX);
            assert!(longest.settling_ns() >= u64::from(u32::MAX) - 2 * u64::from(CONVERSION_NS));
            assert!(longest.address_ns() < u64::from(u32::MAX) + 20_000);
        }
        assert_eq!(Rounds::of(usize::MAX, u32::MAX).conversions, 256);
    }

    #[test]
    fn a_frame_has_the_addresses_and_inputs_of_its_sweep() {
        let mut ragged = Garment::reference();
        ragged.blocks.retain(|block| block.panel != 3 || block.select < 5);
        ragged.panels[3].rows = 20;
        for mut garment in [Garment::reference(), Garment::mat(), Garment::block(), ragged] {
            for (settle_ns, depth) in [(0, Depth::Eight), (34_000, Depth::Twelve), (5_000, Depth::MeanOf4)] {
                garment.wiring.settle_ns = settle_ns;
                let layout = Layout::build(&garment, 2048, 4095).unwrap();
                let circuit = crate::garment::Circuit::build(&garment, &layout, Pins::ANY).unwrap();
                for panels in [0xff, 0b0101, 0b1000] {
                    let plan = Plan { panels, depth, ..Plan::default() };
                    let mut sweep = Sweep::<512, 64>::new();
                    let filled = sweep.fill(&circuit, &plan);
                    let rounds = Rounds::of(sweep.inputs().len(), settle_ns);
                    let addresses = if filled.is_ok() { sweep.levels().len() as u64 } else { 0 };
                    let scans = u64::from(depth.scans());
                    assert_eq!(frame_us(&circuit, &plan), rounds.address_ns() * addresses * scans / 1000);
                }
            }
        }
    }

    #[test]
    fn rates_that_the_documents_name() {
        let rate = |mut garment: Garment, settle_ns| {
            garment.wiring.settle_ns = settle_ns;
            let layout = Layout::build(&garment, 2048, 4095).unwrap();
            let circuit = crate::garment::Circuit::build(&garment, &layout, Pins::ANY).unwrap();
            1e6 / frame_us(&circuit, &Plan::default()) as f64
        };
        assert_eq!((rate(Garment::reference(), 3_000) * 10.0).round(), 1953.0);
        assert_eq!((rate(Garment::reference(), 34_000) * 10.0).round(), 460.0);
        assert_eq!((rate(Garment::block(), 8_000) * 10.0).round(), 15625.0);
    }
}
