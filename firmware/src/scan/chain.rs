//! The DMA channels that read the garment and trigger each other. They run until they are stopped.
//!
//! | channel | waits for | does | then |
//! |---|---|---|---|
//! | 0 - 3 | a sample | stores the code of input 0 - 3 | the next input's channel, after the last `Word` |
//! | `Word` | | sends the next levels to the select lines | `Drop`, or `Settle` if nothing is dropped |
//! | `Drop` | a sample, for each one to drop | discards it: slow lines (see [`Rounds`]) | `Settle` |
//! | `Settle` | a sample | stores the thermometer's code | the first input's channel |
//! | `Answer` | the answer to a word that begins a stretch | discards it | `List` |
//! | `List` | | loads the address of the values for that stretch | `Target` |
//! | `Target` | | gives `Value` the next register; at the end, nothing | |
//! | `Value` | | writes the next value to that register | `Target` |
//!
//! The registers of a stretch are written during the conversion of the thermometer, when no channel stores a
//! code.

use super::frames::{FrameBegin, Frames};
use super::select::Select;
use super::{reflex, tables};
use crate::adc;
use embassy_rp::Peri;
use embassy_rp::interrupt::typelevel::{Binding, PIO0_IRQ_0};
use embassy_rp::peripherals::{
    DMA_CH0, DMA_CH1, DMA_CH2, DMA_CH3, DMA_CH4, DMA_CH5, DMA_CH6, DMA_CH7, DMA_CH8, DMA_CH9, DMA_CH10, PIO0,
};
use rp_pac::dma::regs::CtrlTrig;
use rp_pac::dma::vals::{DataSize, TreqSel};
use rp_pac::{ADC, DMA};
use taxel_core::acquire::{Depth, Fields, Plan, Rounds, SWEEP_INPUTS, Sweep, Unfit};
use taxel_core::garment::Circuit;

/// The chain's own channels, and the PIO block for the select lines.
pub type ChainParts = (
    Peri<'static, PIO0>,
    (
        Peri<'static, DMA_CH0>,
        Peri<'static, DMA_CH1>,
        Peri<'static, DMA_CH2>,
        Peri<'static, DMA_CH3>,
        Peri<'static, DMA_CH4>,
        Peri<'static, DMA_CH5>,
        Peri<'static, DMA_CH6>,
        Peri<'static, DMA_CH7>,
        Peri<'static, DMA_CH8>,
        Peri<'static, DMA_CH9>,
        Peri<'static, DMA_CH10>,
    ),
);

/// Numbers of the channels after those of the inputs.
const WORD: usize = SWEEP_INPUTS;
const SETTLE: usize = WORD + 1;
const ANSWER: usize = WORD + 2;
const LIST: usize = WORD + 3;
const TARGET: usize = WORD + 4;
const VALUE: usize = WORD + 5;
const DROP: usize = WORD + 6;
/// Clocks in which a select line reaches its level: 1 us.
const SETTLES: u32 = 125;
const CHANNELS: u16 = (1 << (DROP + 1)) - 1;

/// The chain of DMA channels.
pub struct DmaChain {
    _parts: ChainParts,
    /// Converter inputs that are read in turn, bit `n` for GPIO `n`.
    inputs: u32,
    select: Option<Select>,
}

/// Registers of a channel: its work each time it is triggered.
struct Step {
    read: u32,
    write: u32,
    /// Number of transfers.
    count: u32,
    control: CtrlTrig,
}

impl Step {
    /// A step of one transfer.
    fn new(size: DataSize, read: u32, write: u32, when: TreqSel, then: usize) -> Step {
        let mut control = CtrlTrig::default();
        control.set_en(true);
        control.set_data_size(size);
        control.set_treq_sel(when);
        control.set_chain_to(then as u8);
        control.set_irq_quiet(true);
        Step { read, write, count: 1, control }
    }

    fn set_up(self, channel: usize) {
        let channel = DMA.ch(channel);
        channel.read_addr().write_value(self.read);
        channel.write_addr().write_value(self.write);
        channel.trans_count().write_value(self.count);
        // This alias of the register does not start the channel.
        channel.al1_ctrl().write_value(self.control.0);
    }
}

impl DmaChain {
    /// A chain at rest.
    pub fn new(parts: ChainParts, _frame_begun: impl Binding<PIO0_IRQ_0, FrameBegin>) -> DmaChain {
        DmaChain { _parts: parts, inputs: 0, select: None }
    }

    /// Starts to read a plan in a loop. Error if the chain cannot read it.
    pub fn start(&mut self, circuit: &Circuit, plan: &Plan, frames: &mut Frames) -> Result<(), Unfit> {
        self.stop();
        let fields = if plan.depth == Depth::Interlaced {
            self.interlace(circuit, plan, frames)?
        } else {
            self.sweep(circuit, plan, frames)?
        };
        let rounds = Rounds::of(self.inputs.count_ones() as usize, circuit.settle_ns());
        self.set_up(rounds);
        trigger(1 << ANSWER);
        trigger(1 << WORD);
        frames.begin(fields);
        adc::run(self.channels(), rounds);
        Ok(())
    }

    /// Fills the tables of a progressive scan, which has no sub-fields.
    #[inline(never)] // out of line: the sweep is on the stack only during the call
    fn sweep(&mut self, circuit: &Circuit, plan: &Plan, frames: &Frames) -> Result<usize, Unfit> {
        let mut sweep = Sweep::<{ tables::ADDRESSES }, { tables::STRETCHES }>::new();
        sweep.fill(circuit, plan)?;
        self.inputs = mask(sweep.inputs());
        let select = Select::take(circuit.lines());
        self.select = Some(select);
        let code = |place, taxel| frames.address(place, taxel);
        tables::fill(&sweep, select, code, registers());
        Ok(0)
    }

    /// Fills the tables of an interlaced scan; returns the number of its sub-fields.
    #[inline(never)]
    fn interlace(&mut self, circuit: &Circuit, plan: &Plan, frames: &Frames) -> Result<usize, Unfit> {
        let fields = Fields::of(circuit, plan)?;
        self.inputs = mask(fields.inputs());
        let select = Select::take(circuit.lines());
        self.select = Some(select);
        reflex::begin(&fields, circuit.falling());
        let mut index = 0;
        fields.each(circuit, plan, |field, levels, taxels| {
            let within = index - fields.before(field);
            tables::set_word(index, select.word(levels, within == 0));
            reflex::order(field, within, taxels);
            index += 1;
        });
        tables::fill_fields(&fields, |index| frames.scanned(index), registers());
        Ok(fields.count())
    }

    /// Converter channels of the inputs, in turn.
    fn channels(&self) -> impl Iterator<Item = usize> {
        let inputs = self.inputs;
        (0..32).filter(move |input| inputs >> input & 1 == 1).map(adc::channel)
    }

    fn set_up(&self, rounds: Rounds) {
        use DataSize::{SIZE_HALFWORD as CODE, SIZE_WORD};
        use TreqSel::{ADC as SAMPLE, PERMANENT, PIO0_RX0};
        let samples = ADC.fifo().as_ptr() as u32;
        for (index, channel) in self.channels().enumerate() {
            let then = self.channels().nth(index + 1).unwrap_or(WORD);
            let mut step = Step::new(CODE, samples, tables::nowhere(), SAMPLE, then);
            step.control.set_incr_write(true);
            step.set_up(channel);
        }
        let dropped = rounds.dropped();
        let settles = if dropped == 0 { SETTLE } else { DROP };
        let mut word = Step::new(SIZE_WORD, tables::words(), Select::words(), PERMANENT, settles);
        word.control.set_incr_read(true);
        word.set_up(WORD);
        let mut drop = Step::new(CODE, samples, tables::nowhere(), SAMPLE, SETTLE);
        drop.count = dropped;
        drop.set_up(DROP);
        let first = self.channels().next().unwrap_or(0);
        Step::new(CODE, samples, tables::warmth(), SAMPLE, first).set_up(SETTLE);
        Step::new(SIZE_WORD, Select::answers(), tables::answer(), PIO0_RX0, LIST).set_up(ANSWER);
        let values = DMA.ch(VALUE);
        let (from, to) = (values.read_addr().as_ptr() as u32, values.al2_write_addr_trig().as_ptr() as u32);
        Step::new(SIZE_WORD, tables::ahead(), from, PERMANENT, TARGET).set_up(LIST);
        // `Answer` is ready again while its answer is followed.
        let mut target = Step::new(SIZE_WORD, tables::targets(), to, PERMANENT, ANSWER);
        target.control.set_incr_read(true);
        target.control.set_ring_size((tables::TARGETS * size_of::<u32>()).trailing_zeros() as u8);
        target.set_up(TARGET);
        let mut value = Step::new(SIZE_WORD, 0, 0, PERMANENT, TARGET);
        value.control.set_incr_read(true);
        value.set_up(VALUE);
    }

    /// True if a select line shows another level than it is driven to.
    pub fn misleads(&self) -> bool {
        let Some(select) = self.select else { return false };
        let read = || DMA.ch(WORD).read_addr().read();
        let at = read();
        let is_other = || tables::word_before(at).is_some_and(|word| !select.shows(word)) && read() == at;
        // The levels may have changed just now, so look twice.
        let settles = || cortex_m::asm::delay(SETTLES);
        is_other() && {
            settles();
            is_other()
        }
    }

    /// Stops the chain; the select lines and the converter are the processor's again.
    pub fn stop(&mut self) {
        let Some(mut select) = self.select.take() else { return };
        adc::halt();
        // Switched off first, so that a channel that still ends triggers nothing.
        (0..=DROP).for_each(|channel| DMA.ch(channel).al1_ctrl().write_value(0));
        DMA.chan_abort().write(|w| w.set_chan_abort(CHANNELS));
        while DMA.chan_abort().read().chan_abort() != 0 {}
        select.release();
    }
}

fn mask(inputs: &[u8]) -> u32 {
    inputs.iter().fold(0, |mask, input| mask | 1 << (input & 31))
}

/// Registers that the chain writes at the start of a stretch.
fn registers() -> tables::Registers {
    tables::Registers {
        destinations: core::array::from_fn(|input| DMA.ch(input).write_addr().as_ptr() as u32),
        word: DMA.ch(WORD).read_addr().as_ptr() as u32,
        flag: Select::flags(),
    }
}

fn trigger(channels: u16) {
    // Makes sure that tables and frames are in memory before the first channel reads them.
    cortex_m::asm::dmb();
    DMA.multi_chan_trigger().write(|w| w.set_multi_chan_trigger(channels));
}
