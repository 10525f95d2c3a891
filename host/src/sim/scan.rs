//! The simulated board's scan, as the reference board's: by a chain that never waits wherever the garment's wiring allows
//! that, else by the processor.

use super::board::SimAdc;
use super::hardware::{PINS, SimDelay, SimPin};
use taxel_core::acquire::{
    Acquire, Adc, Clock, Lines, MuxScan, Plan, Rounds, SWEEP_ADDRESSES, SWEEP_STRETCHES, Scan, ScanError,
    ScanReport, Sweep,
};
use taxel_core::format::Code;
use taxel_core::garment::Circuit;
use taxel_core::selftest::{Examine, Findings};

/// Taxels of the largest garment.
const TAXELS: usize = 2048;

/// Reads the simulated garment. A frame takes as long as [`taxel_core::acquire::frame_us`] says where a chain can read it.
pub struct SimScan<'l, C> {
    processor: MuxScan<'l, SimPin, SimDelay, SimAdc, C, PINS, TAXELS>,
    delay: SimDelay,
    clock: C,
    /// What is being scanned; none: anew.
    of: Option<(Circuit, Plan)>,
    sweep: Box<Sweep<SWEEP_ADDRESSES, SWEEP_STRETCHES>>,
    /// The taxel of each input at each address; empty where no chain can read them.
    taxels: Vec<Option<u16>>,
    codes: Vec<Code>,
    scans: usize,
    /// A select line showed another level than it was driven to.
    misled: bool,
}

impl<'l, C: Clock + Clone> SimScan<'l, C> {
    /// Over the parts of a [`super::SimBoard`].
    pub fn new(lines: &'l mut Lines<SimPin, PINS>, delay: SimDelay, adc: SimAdc, clock: C) -> SimScan<'l, C> {
        SimScan {
            processor: MuxScan::new(lines, delay.clone(), adc, clock.clone()),
            delay,
            clock,
            of: None,
            sweep: Box::new(Sweep::new()),
            taxels: Vec::new(),
            codes: vec![Code(0); TAXELS],
            scans: 0,
            misled: false,
        }
    }

    /// Begins to scan something else, if it is.
    fn begin(&mut self, circuit: &Circuit, plan: &Plan) {
        if self.of.as_ref().is_some_and(|(worn, read)| worn == circuit && read == plan) {
            return;
        }
        if self.of.as_ref().is_none_or(|(worn, _)| worn != circuit) {
            self.codes.fill(Code(0));
        }
        self.of = Some((circuit.clone(), *plan));
        self.taxels.clear();
        if self.sweep.fill(circuit, plan).is_err() {
            return;
        }
        let (addresses, inputs) = (self.sweep.levels().len(), self.sweep.inputs().len());
        let mut ends = self.sweep.stretches().iter().skip(1).map(|next| usize::from(next.first));
        for stretch in self.sweep.stretches() {
            let first = usize::from(stretch.first);
            for step in 0..(ends.next().unwrap_or(addresses) - first) {
                let taxels = stretch.taxels.iter().take(inputs);
                self.taxels.extend(taxels.map(|taxel| taxel.map(|taxel| taxel + step as u16)));
            }
        }
    }

    /// One scan after the other, as many as the depth asks for: their sums.
    fn run(&mut self, circuit: &Circuit, plan: &Plan) -> Result<(), ScanError> {
        let rounds = Rounds::of(self.sweep.inputs().len(), circuit.settle_ns());
        let lines = circuit.lines().iter().fold(0u64, |lines, pin| lines | 1 << (pin & 63));
        let bus = &self.delay.bus;
        let (_, _, adc) = self.processor.parts();
        self.taxels.iter().flatten().filter_map(|t| self.codes.get_mut(usize::from(*t))).for_each(|c| c.0 = 0);
        // The golden ratio's multiples are spread evenly: each scan looks at the lines at another address.
        self.scans = self.scans.wrapping_add(1);
        let look = self.scans.wrapping_mul(317) % self.sweep.levels().len().max(1);
        for _ in 0..plan.depth.scans() {
            let addresses = self.sweep.levels().iter().zip(self.taxels.chunks(self.sweep.inputs().len().max(1)));
            for (address, (levels, taxels)) in addresses.enumerate() {
                let levels = u64::from(*levels);
                bus.act(|drive| {
                    drive.on |= lines;
                    drive.high = drive.high & !lines | levels;
                });
                self.misled |= address == look && (bus.levels.get() ^ levels) & lines != 0;
                let changed = bus.now_ns.get();
                for (turn, (input, taxel)) in self.sweep.inputs().iter().zip(taxels).enumerate() {
                    bus.now_ns.set(changed + rounds.settling_ns() + turn as u64 * rounds.period_ns());
                    let code = adc.read(*input);
                    let Some(taxel) = *taxel else { continue };
                    let code = code.map_err(|_| ScanError::Converter { input: *input, taxel })?;
                    if let Some(sum) = self.codes.get_mut(usize::from(taxel)) {
                        sum.0 += code.min(4095);
                    }
                }
                bus.now_ns.set(changed + rounds.address_ns());
            }
        }
        let taxels = self.taxels.iter().flatten();
        taxels.filter_map(|t| self.codes.get_mut(usize::from(*t))).for_each(|c| c.0 = plan.depth.mean(c.0));
        Ok(())
    }
}

impl<C: Clock + Clone> Acquire for SimScan<'_, C> {
    async fn scan(&mut self, circuit: &Circuit, plan: &Plan) -> Result<Scan<'_>, ScanError> {
        self.begin(circuit, plan);
        if self.taxels.is_empty() {
            return self.processor.scan(circuit, plan).await;
        }
        let start = self.clock.now();
        self.run(circuit, plan)?;
        let duration_us = self.clock.now().since(start).min(u64::from(u32::MAX)) as u32;
        let report = ScanReport { start, duration_us, ..ScanReport::default() };
        Ok(Scan { codes: &self.codes, report })
    }

    fn drive(&mut self, pin: u8, level: bool) -> Result<(), ScanError> {
        self.processor.drive(pin, level)
    }
}

impl<C: Clock + Clone> Examine for SimScan<'_, C> {
    fn examine(&mut self, circuit: &Circuit) -> Result<Findings, ScanError> {
        self.processor.examine(circuit)
    }

    fn pose(&mut self, circuit: &Circuit) {
        if self.taxels.is_empty() {
            self.processor.pose(circuit);
        }
    }

    fn is_misled(&mut self) -> bool {
        std::mem::take(&mut self.misled) || self.taxels.is_empty() && self.processor.is_misled()
    }
}
