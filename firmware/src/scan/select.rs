//! The PIO program that drives the select lines. It puts a word from the chain on the pins, and answers it if
//! its flag marks the start of a stretch.

use embassy_rp::pio::program::{InstructionOperands, JmpCondition, OutDestination};
use rp_pac::{IO_BANK0, PIO0, SIO, io::vals::Oeover};

/// Number of the state machine.
const MACHINE: usize = 0;
/// Function numbers of a pin.
const FUNCTION_PIO0: u8 = 6;
const FUNCTION_SIO: u8 = 5;

/// The select lines, within the range of pins from the lowest to the highest one. PIO writes the whole range,
/// but only pins that are connected to it follow: the pins between the lines are not affected.
#[derive(Debug, Clone, Copy, Default)]
pub struct Select {
    lines: u32,
}

impl Select {
    /// Connects the lines of these GPIO numbers to the program, and starts it.
    pub fn take(numbers: &[u8]) -> Select {
        let select = Select { lines: numbers.iter().fold(0, |lines, number| lines | 1 << (number & 31)) };
        PIO0.ctrl().write(|w| w.set_sm_enable(0));
        let out = |destination, bit_count| InstructionOperands::OUT { destination, bit_count }.encode();
        let program = [
            InstructionOperands::PULL { if_empty: false, block: true }.encode(),
            out(OutDestination::PINS, select.count()),
            out(OutDestination::X, 1),
            InstructionOperands::JMP { condition: JmpCondition::XIsZero, address: 0 }.encode(),
            InstructionOperands::PUSH { if_full: false, block: false }.encode(),
        ];
        for (address, instruction) in program.iter().enumerate() {
            PIO0.instr_mem(address).write(|w| w.set_instr_mem(*instruction));
        }
        let machine = PIO0.sm(MACHINE);
        machine.clkdiv().write(|w| w.set_int(1));
        machine.execctrl().write(|w| w.set_wrap_top(program.len() as u8 - 1));
        machine.pinctrl().write(|w| {
            w.set_out_base(select.first());
            w.set_out_count(select.count());
        });
        // A change of the joins in this register empties the queues.
        machine.shiftctrl().write(|w| w.set_fjoin_tx(true));
        machine.shiftctrl().write(|w| w.set_out_shiftdir(true));
        machine.instr().write(|w| {
            w.set_instr(InstructionOperands::JMP { condition: JmpCondition::Always, address: 0 }.encode())
        });
        PIO0.ctrl().write(|w| {
            w.set_sm_restart(1 << MACHINE);
            w.set_sm_enable(1 << MACHINE);
        });
        select.connect(FUNCTION_PIO0, Oeover::ENABLE);
        select
    }

    /// Stops the program and returns the lines to the processor.
    pub fn release(&mut self) {
        PIO0.irqs(0).inte().write(|_| {});
        PIO0.ctrl().write(|w| w.set_sm_enable(0));
        self.connect(FUNCTION_SIO, Oeover::NORMAL);
        self.lines = 0;
    }

    fn connect(self, function: u8, drive: Oeover) {
        for number in (0..32).filter(|number| self.lines >> number & 1 == 1) {
            IO_BANK0.gpio(number).ctrl().write(|w| {
                w.set_funcsel(function);
                w.set_oeover(drive);
            });
        }
    }

    fn first(self) -> u8 {
        (self.lines.trailing_zeros() & 31) as u8
    }

    fn count(self) -> u8 {
        32 - self.lines.leading_zeros() as u8 - self.first()
    }

    /// Address of the register for the program's words.
    pub fn words() -> u32 {
        PIO0.txf(MACHINE).as_ptr() as u32
    }

    /// Address of the register with its answers.
    pub fn answers() -> u32 {
        PIO0.rxf(MACHINE).as_ptr() as u32
    }

    /// Address of the register that raises flags.
    pub fn flags() -> u32 {
        PIO0.irq_force().as_ptr() as u32
    }

    /// Enables the interrupt of the flags.
    pub fn listen() {
        PIO0.irqs(0).inte().write(|w| {
            w.set_sm0(true);
            w.set_sm1(true);
            w.set_sm2(true);
            w.set_sm3(true);
        });
    }

    /// Returns the raised flags and clears them.
    pub fn take_flags() -> u8 {
        let flags = PIO0.irq().read().irq();
        PIO0.irq().write(|w| w.set_irq(flags));
        flags
    }

    /// True if the lines have the levels of this word of the program.
    pub fn shows(self, word: u32) -> bool {
        let levels = SIO.gpio_in(0).read();
        (levels ^ word << self.first()) & self.lines == 0
    }

    /// The program's word for these levels (bit `n` for GPIO `n`); `begins` marks the start of a stretch.
    pub fn word(self, levels: u32, begins: bool) -> u32 {
        levels >> self.first() | u32::from(begins) << self.count()
    }
}
