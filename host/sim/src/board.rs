//! The simulated board and its converter.

use super::decode::{Address, Decoder};
use super::error::ScriptError;
use super::hand::SimHand;
use super::hardware::{Bus, PINS, SimClock, SimDelay, SimPin, Timing};
use super::pads;
use super::script::Script;
use super::signal::World;
use super::wiring::Line;
use std::fmt;
use std::rc::Rc;
use taxel_core::acquire::{Adc, Lines, Pull, PulledAdc};
use taxel_core::garment::Garment;

/// The converter: samples the taxel that the select lines connect to an input.
#[derive(Debug)]
pub struct SimAdc {
    bus: Rc<Bus>,
    world: World,
    decoder: Decoder,
    levels: u64,
    address: Option<Address>,
    /// One line per input of the decoder.
    lines: Vec<Line>,
    /// Index of each GPIO's input.
    inputs: [Option<u8>; PINS],
    conversion_ns: u64,
    source_kohm: f64,
    /// Last sampled code.
    held: u16,
}

/// A GPIO without a block of the garment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NoSuchInput(
    /// GPIO number
    pub u8,
);

impl fmt::Display for NoSuchInput {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "no block of the garment is connected to pin {}", self.0)
    }
}

impl std::error::Error for NoSuchInput {}

impl Adc for SimAdc {
    type Error = NoSuchInput;

    fn read(&mut self, input: u8) -> Result<u16, NoSuchInput> {
        let index = self.inputs.get(usize::from(input)).copied().flatten().ok_or(NoSuchInput(input))?;
        let levels = self.bus.levels.get();
        if levels != self.levels {
            self.levels = levels;
            self.address = self.decoder.address(levels);
        }
        let taxel = self.address.and_then(|address| self.decoder.taxel(address, usize::from(index)));
        let now = self.bus.now_ns.get();
        if !self.bus.acts.borrow().is_empty() {
            self.bus.acts.take().into_iter().for_each(|act| self.world.act(act, now));
        }
        self.bus.pass(self.conversion_ns);
        let line = self.lines.get_mut(usize::from(index)).ok_or(NoSuchInput(input))?;
        let settled = self.world.sample(line, taxel, self.bus.changed_ns.get(), now);
        let drive = self.bus.drive.get();
        self.held = self
            .bus
            .with_faults(|faults| pads::code(input, drive, faults, self.source_kohm, settled, self.held));
        Ok(self.held)
    }
}

impl PulledAdc for SimAdc {
    fn pull(&mut self, input: u8, pull: Pull) -> Result<(), NoSuchInput> {
        self.inputs.get(usize::from(input)).copied().flatten().ok_or(NoSuchInput(input))?;
        self.bus.act(|drive| drive.pull(1 << input, pull));
        Ok(())
    }
}

/// The simulated board: the parts of a `MuxScan`.
pub struct SimBoard {
    /// Output pins: all GPIOs that are not converter inputs.
    pub lines: Lines<SimPin, PINS>,
    /// Delay.
    pub delay: SimDelay,
    /// Converter.
    pub adc: SimAdc,
    /// Clock.
    pub clock: SimClock,
    /// Hand that touches the garment meanwhile.
    pub hand: SimHand,
}

impl SimBoard {
    /// A board at time 0 on a garment, playing a script with this seed instead of the script's.
    pub fn new(garment: &Garment, script: &Script, seed: u64) -> Result<SimBoard, ScriptError> {
        SimBoard::with_timing(garment, script, seed, Timing::REFERENCE)
    }

    /// A board with another timing.
    pub fn with_timing(
        garment: &Garment,
        script: &Script,
        seed: u64,
        timing: Timing,
    ) -> Result<SimBoard, ScriptError> {
        let bus = Rc::new(Bus::default());
        let from_ns = (script.faults.from_s * 1e9) as u64;
        bus.faults.replace((from_ns, script.faults.pins.clone()));
        let world = World::build(&Script { seed, ..script.clone() }, garment)?;
        let decoder = Decoder::build(garment);
        let mut inputs = [None; PINS];
        for (index, pin) in decoder.inputs().iter().enumerate() {
            if let Some(slot) = inputs.get_mut(usize::from(*pin)) {
                *slot = Some(index as u8);
            }
        }
        let free = (0..PINS as u8).filter(|pin| inputs.get(usize::from(*pin)).is_some_and(Option::is_none));
        let lines = Lines::new(free.map(|pin| (pin, SimPin { bus: bus.clone(), mask: 1 << pin })));
        let adc = SimAdc {
            bus: bus.clone(),
            world,
            levels: 0,
            address: decoder.address(0),
            lines: vec![Line::default(); decoder.inputs().len()],
            decoder,
            inputs,
            conversion_ns: u64::from(timing.conversion_ns),
            source_kohm: script.wiring.source_kohm,
            held: 0,
        };
        let (delay, hand) = (SimDelay { bus: bus.clone(), timing }, SimHand { bus: bus.clone() });
        Ok(SimBoard { lines, delay, adc, clock: SimClock { bus }, hand })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use embedded_hal::delay::DelayNs;
    use taxel_core::acquire::Clock;
    use taxel_core::format::Micros;

    #[test]
    fn the_parts_share_lines_and_time() {
        let script = "duration_s = 1\n[idle]\nnoise_counts = 0".parse::<Script>().unwrap();
        let garment = Garment::reference();
        let mut board = SimBoard::new(&garment, &script, 5).unwrap();
        let world = World::build(&Script { seed: 5, ..script }, &garment).unwrap();
        board.delay.delay_ns(3_000);
        assert_eq!(board.clock.now_ns(), 2_000, "settling takes one slot");
        board.delay.delay_ns(500_000);
        assert_eq!(board.clock.now(), Micros(502));
        // Column 5, row 2, block 1 of the left arm.
        for pin in [2, 8, 9, 11] {
            board.lines.drive(pin, true).unwrap().unwrap();
        }
        assert_eq!(board.clock.levels(), 1 << 2 | 1 << 8 | 1 << 9 | 1 << 11);
        assert_eq!(board.adc.read(28), Ok(world.code(1024 + (4 + 2) * 16 + 5, 502_000)));
        assert_eq!(board.clock.now_ns(), 504_000);
        assert_eq!(
            board.adc.read(25).unwrap_err().to_string(),
            "no block of the garment is connected to pin 25"
        );
        board.clock.advance_to(900);
        board.clock.advance_to(600);
        assert_eq!(board.clock.now(), Micros(900));
        assert_eq!(board.lines.mask(), !(0xf << 26));
    }
}
