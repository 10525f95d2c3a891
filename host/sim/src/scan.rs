//! Scan of the simulated board, as by the reference board: by a DMA chain if the garment's wiring allows it,
//! else by the processor. An interlaced scan is checked after each sub-field, and may move pins then.

use super::board::SimAdc;
use super::hardware::{PINS, SimDelay, SimPin};
use super::signal::FULL_SCALE;
use taxel_core::acquire::{
    Acquire, Adc, Clock, Depth, Fields, Lines, MuxScan, Plan, Reflex, Rounds, SWEEP_ADDRESSES,
    SWEEP_STRETCHES, Scan, ScanError, ScanReport, Sweep,
};
use taxel_core::capacity::TAXELS;
use taxel_core::format::Code;
use taxel_core::garment::Circuit;
use taxel_core::reflex::{Early, Reflexes};
use taxel_core::selftest::{Examine, Findings};

/// Reads the simulated garment. If a chain can read it, a frame takes [`taxel_core::acquire::frame_us`].
pub struct SimScan<'l, C> {
    processor: MuxScan<'l, SimPin, SimDelay, SimAdc, C, PINS, TAXELS>,
    delay: SimDelay,
    clock: C,
    /// Circuit and plan of the scan; none before the first.
    of: Option<(Circuit, Plan)>,
    /// GPIO numbers of the inputs read at each address.
    inputs: Vec<u8>,
    /// Levels of the select lines by address; empty if no chain can drive them.
    levels: Vec<u32>,
    /// Taxel of each input at each address.
    taxels: Vec<Option<u16>>,
    codes: Box<[Code; TAXELS]>,
    /// Codes of an interlaced scan, in its order.
    scanned: Vec<Code>,
    reflex: Box<Reflex<TAXELS>>,
    scans: u32,
    /// A select line had another level than it was driven to.
    misled: bool,
}

impl<'l, C: Clock + Clone> SimScan<'l, C> {
    /// A scan with the parts of a [`super::SimBoard`].
    pub fn new(lines: &'l mut Lines<SimPin, PINS>, delay: SimDelay, adc: SimAdc, clock: C) -> SimScan<'l, C> {
        SimScan {
            processor: MuxScan::new(lines, delay.clone(), adc, clock.clone()),
            delay,
            clock,
            of: None,
            inputs: Vec::new(),
            levels: Vec::new(),
            taxels: Vec::new(),
            codes: Box::new([Code(0); TAXELS]),
            scanned: vec![Code(0); TAXELS],
            reflex: Box::default(),
            scans: 0,
            misled: false,
        }
    }

    /// Prepares a scan of another circuit or plan.
    fn begin(&mut self, circuit: &Circuit, plan: &Plan) {
        if self.of.as_ref().is_some_and(|(known, read)| known == circuit && read == plan) {
            return;
        }
        if self.of.as_ref().is_none_or(|(known, _)| known != circuit) {
            self.codes.fill(Code(0));
        }
        self.of = Some((circuit.clone(), *plan));
        self.levels.clear();
        self.taxels.clear();
        if plan.depth == Depth::Interlaced {
            self.interlace(circuit, plan);
        } else {
            self.sweep(circuit, plan);
        }
    }

    /// Addresses of a progressive scan, if a chain can read them.
    fn sweep(&mut self, circuit: &Circuit, plan: &Plan) {
        let mut sweep = Box::new(Sweep::<SWEEP_ADDRESSES, SWEEP_STRETCHES>::new());
        if sweep.fill(circuit, plan).is_err() {
            return;
        }
        self.inputs = sweep.inputs().into();
        self.levels = sweep.levels().into();
        let mut ends = sweep.stretches().iter().skip(1).map(|next| usize::from(next.first));
        for stretch in sweep.stretches() {
            let first = usize::from(stretch.first);
            for step in 0..(ends.next().unwrap_or(self.levels.len()) - first) {
                let taxels = stretch.taxels.iter().take(self.inputs.len());
                self.taxels.extend(taxels.map(|taxel| taxel.map(|taxel| taxel + step as u16)));
            }
        }
    }

    /// Addresses of an interlaced scan.
    fn interlace(&mut self, circuit: &Circuit, plan: &Plan) {
        let Ok(fields) = Fields::of(circuit, plan) else { return };
        self.inputs = fields.inputs().into();
        self.reflex.begin(fields.clone(), circuit.falling());
        fields.each(circuit, plan, |field, levels, taxels| {
            self.reflex.order(field, self.levels.len() - fields.before(field), taxels);
            self.levels.push(levels);
            self.taxels.extend(taxels.into_iter().take(self.inputs.len()));
        });
    }

    /// Runs as many scans as the depth requires, and takes their mean.
    fn run(&mut self, circuit: &Circuit, plan: &Plan) -> Result<(), ScanError> {
        let rounds = Rounds::of(self.inputs.len(), circuit.settle_ns());
        let lines = circuit.lines().iter().fold(0, |lines, pin| lines | 1 << (pin & 63));
        // Multiples of this number are evenly spread, and so are their digits: each scan checks the lines at
        // another address.
        self.scans = self.scans.wrapping_add(1);
        let spread = self.scans.wrapping_mul(0xb529_7a4d);
        let look = ((u64::from(spread) * self.levels.len() as u64) >> 32) as usize;
        if plan.depth == Depth::Interlaced {
            return self.run_fields(lines, rounds, look);
        }
        self.each_read(|code| code.0 = 0);
        for _ in 0..plan.depth.scans() {
            for address in 0..self.levels.len() {
                for (taxel, code) in self.read(address, lines, rounds, address == look)? {
                    let sum = taxel.and_then(|taxel| self.codes.get_mut(usize::from(taxel)));
                    sum.into_iter().for_each(|sum| sum.0 += code);
                }
            }
        }
        self.each_read(|code| code.0 = plan.depth.mean(code.0));
        Ok(())
    }

    /// Runs one sub-field after the other, each with a check at its end.
    fn run_fields(&mut self, lines: u64, rounds: Rounds, look: usize) -> Result<(), ScanError> {
        let fields = self.reflex.fields().clone();
        for field in 0..fields.count() {
            let (span, addresses) = (fields.span(field), fields.addresses(field));
            for within in 0..addresses {
                let address = fields.before(field) + within;
                let read = self.read(address, lines, rounds, address == look)?;
                for (turn, (_, code)) in read.into_iter().enumerate() {
                    let slot = self.scanned.get_mut(span.start + turn * addresses + within);
                    slot.into_iter().for_each(|slot| slot.0 = code);
                }
            }
            let codes = self.scanned.get(span).unwrap_or(&[]);
            let begun = self.reflex.check(field, codes, self.codes.as_mut_slice(), self.clock.now());
            for (pin, level) in self.reflex.pins(begun) {
                self.processor.drive(pin, level)?;
            }
        }
        Ok(())
    }

    /// Reads every input at an address: taxel and code, 0 for unread ones.
    fn read(
        &mut self,
        address: usize,
        lines: u64,
        rounds: Rounds,
        look: bool,
    ) -> Result<Vec<(Option<u16>, u16)>, ScanError> {
        let levels = self.levels.get(address).map_or(0, |levels| u64::from(*levels));
        let taxels = self.taxels.iter().skip(address * self.inputs.len());
        let bus = &self.delay.bus;
        bus.act(|drive| {
            drive.on |= lines;
            drive.high = drive.high & !lines | levels;
        });
        self.misled |= look && (bus.levels.get() ^ levels) & lines != 0;
        let (_, _, adc, _) = self.processor.mux().parts();
        let begun = bus.now_ns.get();
        let mut read = Vec::with_capacity(self.inputs.len());
        for (turn, (input, taxel)) in (0..).zip(self.inputs.iter().zip(taxels)) {
            bus.now_ns.set(begun + rounds.settling_ns() + turn * rounds.period_ns());
            let code = match (adc.read(*input), taxel) {
                (Ok(code), Some(_)) => code.min(FULL_SCALE),
                (Err(_), Some(taxel)) => return Err(ScanError::Converter { input: *input, taxel: *taxel }),
                (_, None) => 0,
            };
            read.push((*taxel, code));
        }
        bus.now_ns.set(begun + rounds.address_ns());
        Ok(read)
    }

    /// Changes the code of every taxel that is read.
    fn each_read(&mut self, change: impl Fn(&mut Code)) {
        for taxel in self.taxels.iter().flatten() {
            if let Some(code) = self.codes.get_mut(usize::from(*taxel)) {
                change(code);
            }
        }
    }
}

impl<C: Clock + Clone> Acquire for SimScan<'_, C> {
    async fn scan(&mut self, circuit: &Circuit, plan: &Plan) -> Result<Scan<'_>, ScanError> {
        self.begin(circuit, plan);
        if self.levels.is_empty() {
            return self.processor.scan(circuit, plan).await;
        }
        let start = self.clock.now();
        self.run(circuit, plan)?;
        let duration_us = self.clock.now().since(start).min(u64::from(u32::MAX)) as u32;
        let report = ScanReport { start, duration_us, ..ScanReport::default() };
        Ok(Scan { codes: self.codes.as_slice(), report })
    }

    fn drive(&mut self, pin: u8, level: bool) -> Result<(), ScanError> {
        let driven = self.processor.drive(pin, level);
        self.reflex.driven(pin, level);
        driven
    }

    fn watch(&mut self, reflexes: Option<&Reflexes>, active: u8, limit: impl Fn(u16) -> Option<u16>) {
        self.reflex.watch(reflexes, active, limit);
    }

    fn reflex(&mut self) -> Option<Early> {
        self.reflex.take_early()
    }
}

impl<C: Clock + Clone> Examine for SimScan<'_, C> {
    fn examine(&mut self, circuit: &Circuit) -> Result<Findings, ScanError> {
        self.processor.examine(circuit)
    }

    fn pose(&mut self, circuit: &Circuit) {
        if self.levels.is_empty() {
            self.processor.pose(circuit);
        }
    }

    fn is_misled(&mut self) -> bool {
        std::mem::take(&mut self.misled) || self.levels.is_empty() && self.processor.is_misled()
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Player, Script, SimBoard};
    use super::*;
    use taxel_core::acquire::frame_us;
    use taxel_core::garment::{Garment, Layout, Pins};
    use taxel_core::reflex::Agree;
    use taxel_core::run::block_on;
    use taxel_core::scene::Scene;

    fn circuit(garment: &Garment) -> Circuit {
        let layout = Layout::build(garment, TAXELS, FULL_SCALE).unwrap();
        Circuit::build(garment, &layout, Pins::ANY).unwrap()
    }

    fn script(text: &str) -> Script {
        format!("duration_s = 9\n{text}").parse::<Script>().unwrap()
    }

    /// Durations (us) and codes of some frames of a plan.
    fn scan(garment: &Garment, script: &Script, plan: &Plan, frames: usize) -> Vec<(u32, Vec<u16>)> {
        let SimBoard { mut lines, delay, adc, clock, .. } =
            SimBoard::new(garment, script, script.seed).unwrap();
        let mut scan = SimScan::new(&mut lines, delay, adc, &clock);
        let mut frame = || {
            let scan = block_on(scan.scan(&circuit(garment), plan)).unwrap();
            (scan.report.duration_us, scan.codes.iter().map(|code| code.0).collect())
        };
        (0..frames).map(|_| frame()).collect()
    }

    #[test]
    fn a_frame_takes_what_the_model_says() {
        let script = script("");
        for mut garment in [Garment::reference(), Garment::mat(), Garment::block()] {
            for settle_ns in [0, 3_000, 4_000, 8_000, 15_000, 34_000, 100_000] {
                garment.wiring.settle_ns = settle_ns;
                for depth in [Depth::Eight, Depth::Twelve, Depth::MeanOf2, Depth::MeanOf8, Depth::Interlaced]
                {
                    for panels in [0b1111, 0b0101] {
                        let plan = Plan { depth, panels, ..Plan::default() };
                        let want = frame_us(&circuit(&garment), &plan) as f64;
                        let have = f64::from(scan(&garment, &script, &plan, 1)[0].0);
                        let name = &garment.name;
                        assert!(
                            (have / want - 1.0).abs() < 0.005,
                            "{name}, {settle_ns} ns: {have}, not {want}"
                        );
                    }
                }
            }
        }
    }

    /// Frames of a script without pins equal those of the board, also on lines that do not settle.
    #[test]
    fn the_player_reads_what_the_board_reads() {
        let ball = "[[touch]]\npanel = \"chest\"\nshape = \"ball\"\nat = [8, 16]\nforce_n = 60\nstart_s = 0\n\
                    rise_s = 0\nhold_s = 5\n[idle]\nnoise_counts = 0\n[wiring]\nsource_kohm = 30\nline_pf = 80\n";
        let script = script(ball);
        for settle_ns in [3_000, 15_000] {
            let mut garment = Garment::reference();
            garment.wiring.settle_ns = settle_ns;
            let mut player = Player::new(&script, &garment).unwrap();
            let mut now = 0;
            for (duration_us, codes) in scan(&garment, &script, &Plan::default(), 3) {
                let mut played = vec![0; TAXELS];
                player.frame(now, &mut played);
                let differ = codes.iter().zip(&played).filter(|(a, b)| a.abs_diff(**b) > 1).count();
                assert_eq!(differ, 0, "{settle_ns} ns");
                assert!(codes.iter().max() > Some(&1000));
                now += u64::from(duration_us);
            }
        }
    }

    /// A still scene is equal in both orders on settled lines; a reflex moves its pin within the frame.
    #[test]
    fn an_interlaced_scan_reads_the_same_and_moves_a_pin_at_once() {
        let script = script(
            "[[touch]]\npanel = \"chest\"\nshape = \"ball\"\nat = [8, 16]\nforce_n = 60\nstart_s = 0.3\nrise_s = 0\nhold_s = 5\n\
             [idle]\nnoise_counts = 0\nspread_counts = 0\nbase_code = 100\n",
        );
        let garment = Garment::reference();
        let circuit = circuit(&garment);
        let SimBoard { mut lines, delay, adc, clock, .. } = SimBoard::new(&garment, &script, 1).unwrap();
        let mut scan = SimScan::new(&mut lines, delay.clone(), adc, &clock);
        let scene = Scene::shipped().interlaced(Agree::Two);
        let layout = Layout::build(&garment, TAXELS, FULL_SCALE).unwrap();
        let pipeline = taxel_core::pipeline::Pipeline::build(&scene, &layout).unwrap();
        scan.drive(18, false).unwrap();
        let high = || delay.bus.drive.get().high >> 18 & 1 == 1;
        let early = loop {
            let reflexes = pipeline.reactions().reflexes();
            scan.watch(Some(reflexes), 0, |_| Some(1_100));
            assert!(!high());
            let interlaced = block_on(scan.scan(&circuit, &scene.plan)).unwrap();
            let (start, codes) = (interlaced.report.start, interlaced.codes.to_vec());
            if let Some(early) = scan.reflex() {
                break early;
            }
            assert!(start.0 < 310_000);
            assert!(codes.iter().all(|code| *code == Code(100)) || start.0 > 290_000);
        };
        assert!(high());
        assert_eq!((early.index, early.other.is_some()), (0, true));
        assert!((300_000..302_600).contains(&early.time.0), "{:?}", early.time);
        let mut still = |plan: &Plan| block_on(scan.scan(&circuit, plan)).unwrap().codes.to_vec();
        assert_eq!(still(&scene.plan), still(&Plan::default()));
    }

    /// Taxels left out by a plan keep their codes; what no chain can read is read by the processor.
    #[test]
    fn the_rest_of_the_garment() {
        let mut garment = Garment::reference();
        let script = script("[idle]\nbase_code = 100\nspread_counts = 0\nnoise_counts = 0\n");
        let plan = Plan { panels: 0b0010, ..Plan::default() };
        let codes = &scan(&garment, &script, &plan, 2)[1].1;
        assert!(
            codes.iter().enumerate().all(|(taxel, code)| *code == if taxel / 512 == 1 { 100 } else { 0 })
        );
        garment.blocks.iter_mut().filter(|b| b.panel == 3).for_each(|b| b.orientation.mirror_x = true);
        let codes = &scan(&garment, &script, &Plan::default(), 1)[0].1;
        assert!(codes.iter().all(|code| *code == 100));
    }

    /// A line that sticks during operation is detected within some scans; a good one never is.
    #[test]
    fn a_stuck_line_is_seen() {
        let garment = Garment::reference();
        for (fault, seen) in [("", false), ("[faults]\npins = [{ pin = 8, fault = \"stuck-high\" }]\n", true)]
        {
            let script = script(fault);
            let SimBoard { mut lines, delay, adc, clock, .. } = SimBoard::new(&garment, &script, 1).unwrap();
            let mut scan = SimScan::new(&mut lines, delay, adc, &clock);
            let misled = (0..8).any(|_| {
                block_on(scan.scan(&circuit(&garment), &Plan::default())).unwrap();
                scan.is_misled()
            });
            assert_eq!(misled, seen);
        }
    }
}
