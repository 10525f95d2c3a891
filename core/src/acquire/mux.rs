//! Progressive scan through multiplexers, on any HAL.

use super::{Acquire, Adc, Depth, Lines, Plan, ProbePin, Scan, ScanError, ScanReport};
use crate::format::{Code, Micros};
use crate::garment::{BLOCKS, Circuit, Site};
use embedded_hal::delay::DelayNs;
use embedded_hal::digital::{OutputPin, PinState};

/// The board's clock.
pub trait Clock {
    /// Time since the board started.
    fn now(&self) -> Micros;

    /// Called after each step of a long operation (a row scanned, a line examined). A board feeds its
    /// watchdog here, so that only an operation that hangs restarts it.
    fn progressed(&self) {}
}

impl<C: Clock> Clock for &C {
    fn now(&self) -> Micros {
        (**self).now()
    }

    fn progressed(&self) {
        (**self).progressed();
    }
}

/// Selects every address, waits for the line to settle, and reads every converter input that has a block
/// there: by select code, then row, then column. Drives only lines whose level changes. The codes are stored
/// in memory of the caller; [`MuxScan`] has its own.
///
/// Cost per address: driving the changed lines, the garment's settling time, and per input as many
/// conversions as samples are averaged.
pub struct Mux<'l, P, D, A, C, const PINS: usize> {
    lines: &'l mut Lines<P, PINS>,
    delay: D,
    adc: A,
    clock: C,
    /// By bit of the circuit's word: index into `lines`, and GPIO number. Then the levels driven last.
    slots: heapless::Vec<u8, 32>,
    wired: heapless::Vec<u8, 32>,
    driven: Option<u32>,
    posed: u32,
}

/// A [`Mux`] with memory for the codes of a frame.
pub struct MuxScan<'l, P, D, A, C, const PINS: usize, const TAXELS: usize> {
    mux: Mux<'l, P, D, A, C, PINS>,
    codes: [Code; TAXELS],
}

impl<'l, P, D, A, C, const PINS: usize, const TAXELS: usize> MuxScan<'l, P, D, A, C, PINS, TAXELS>
where
    P: OutputPin,
    D: DelayNs,
    A: Adc,
    C: Clock,
{
    /// Takes the board's pins, delay, converter and clock.
    pub fn new(lines: &'l mut Lines<P, PINS>, delay: D, adc: A, clock: C) -> Self {
        MuxScan { mux: Mux::new(lines, delay, adc, clock), codes: [Code(0); TAXELS] }
    }

    /// The scan without its memory.
    pub fn mux(&mut self) -> &mut Mux<'l, P, D, A, C, PINS> {
        &mut self.mux
    }
}

impl<'l, P, D, A, C, const PINS: usize> Mux<'l, P, D, A, C, PINS>
where
    P: OutputPin,
    D: DelayNs,
    A: Adc,
    C: Clock,
{
    /// Takes the board's pins, delay, converter and clock.
    pub fn new(lines: &'l mut Lines<P, PINS>, delay: D, adc: A, clock: C) -> Self {
        Mux {
            lines,
            delay,
            adc,
            clock,
            slots: heapless::Vec::new(),
            wired: heapless::Vec::new(),
            driven: None,
            posed: 0,
        }
    }

    /// Scans a circuit by a plan into `codes`, by taxel number. Codes that are not read stay, unless the lines
    /// have changed: then they become 0.
    pub fn scan(
        &mut self,
        circuit: &Circuit,
        plan: &Plan,
        codes: &mut [Code],
    ) -> Result<ScanReport, ScanError> {
        if self.rewire(circuit)? {
            codes.fill(Code(0));
        }
        let start = self.clock.now();
        self.sweep(circuit, plan, codes)?;
        let duration_us = self.clock.now().since(start).min(u64::from(u32::MAX)) as u32;
        Ok(ScanReport { start, duration_us, overruns: 0, temperature: None })
    }

    /// Sets the level of a pin.
    pub fn drive(&mut self, pin: u8, level: bool) -> Result<(), ScanError> {
        let driven = self.lines.drive(pin, level).ok_or(ScanError::NoPin(pin))?;
        driven.map_err(|_| ScanError::Output(pin))
    }

    /// Lends lines, delay, converter and clock for other uses than a scan. The next scan drives all lines.
    pub fn parts(&mut self) -> (&mut Lines<P, PINS>, &mut D, &mut A, &C) {
        self.driven = None;
        (self.lines, &mut self.delay, &mut self.adc, &self.clock)
    }

    /// Looks up the pins of the circuit's lines if these have changed, and returns true then.
    fn rewire(&mut self, circuit: &Circuit) -> Result<bool, ScanError> {
        if self.wired.as_slice() == circuit.lines() && !self.slots.is_empty() {
            return Ok(false);
        }
        self.slots.clear();
        self.wired.clear();
        self.driven = None;
        for pin in circuit.lines() {
            let slot = self.lines.pins.iter().position(|(n, _)| n == pin).ok_or(ScanError::NoPin(*pin))?;
            let _ = self.slots.push(slot as u8);
            let _ = self.wired.push(*pin);
        }
        Ok(true)
    }

    /// Drives the lines whose levels differ from those of `word`. The error is the number of a failed pin.
    fn apply(&mut self, word: u32) -> Result<(), u8> {
        // Levels are unknown at the start and after a failure: all bits differ. There are fewer lines, so the
        // loop ends at the first bit without one.
        let mut changed = self.driven.take().map_or(u32::MAX, |driven| driven ^ word);
        while changed != 0 {
            let bit = changed.trailing_zeros();
            changed &= changed - 1;
            let Some(slot) = self.slots.get(bit as usize) else { break };
            let Some((number, pin)) = self.lines.pins.get_mut(usize::from(*slot)) else { break };
            pin.set_state(PinState::from(word >> bit & 1 == 1)).map_err(|_| *number)?;
        }
        self.driven = Some(word);
        Ok(())
    }

    /// Reads all addresses. Own frame: its stack is free again on return.
    #[inline(never)]
    fn sweep(&mut self, circuit: &Circuit, plan: &Plan, codes: &mut [Code]) -> Result<(), ScanError> {
        let columns = column_changes(circuit);
        circuit.selects().try_for_each(|sites| self.scan_select((circuit, plan), &columns, sites, codes))
    }

    /// Reads all addresses of the blocks that share one select code.
    fn scan_select(
        &mut self,
        (circuit, plan): (&Circuit, &Plan),
        columns: &Columns,
        sites: &[Site],
        codes: &mut [Code],
    ) -> Result<(), ScanError> {
        let mut cursors = Cursors::new();
        for site in sites.iter().filter(|s| plan.reads(s.panel, s.block)) {
            let _ = cursors.push(Cursor::new(site)); // a circuit has at most BLOCKS of them
        }
        let select = sites.first().map_or(0, |s| s.select);
        for row in 0..cursors.iter().map(|c| c.rows).max().unwrap_or(0) {
            cursors.iter_mut().for_each(|c| c.enter_row(row));
            let width = cursors.iter().map(|c| c.columns_here).max().unwrap_or(0);
            let word = circuit.word(select, row, 0);
            for (column, change) in (0..width).zip(columns) {
                self.apply(word ^ change).map_err(|pin| lost(pin, &cursors, column))?;
                self.delay.delay_ns(circuit.settle_ns());
                self.read(&mut cursors, column, plan.depth, codes)?;
            }
            self.clock.progressed();
        }
        Ok(())
    }

    /// Reads every block that has a taxel at the present column.
    fn read(
        &mut self,
        cursors: &mut Cursors,
        column: u8,
        depth: Depth,
        codes: &mut [Code],
    ) -> Result<(), ScanError> {
        for cursor in cursors.iter_mut().filter(|c| column < c.columns_here) {
            let Cursor { input, taxel, .. } = *cursor;
            let mut sum = 0;
            for _ in 0..depth.scans() {
                let code = self.adc.read(input);
                sum += code.map_err(|_| ScanError::Converter { input, taxel: taxel as u16 })?.min(4095);
            }
            if let Some(slot) = codes.get_mut(taxel as usize) {
                *slot = Code(depth.mean(sum));
            }
            cursor.taxel += cursor.column_step;
        }
        Ok(())
    }
}

impl<P: ProbePin, D, A, C, const PINS: usize> Mux<'_, P, D, A, C, PINS>
where
    D: DelayNs,
    A: Adc,
    C: Clock,
{
    /// Selects a taxel of some block, another one each time. No effect before the lines are known.
    pub(crate) fn pose_next(&mut self, circuit: &Circuit) {
        if self.wired.as_slice() != circuit.lines() {
            return;
        }
        self.posed = self.posed.wrapping_add(1);
        // Multiples of the golden ratio are spread evenly, and so are their bytes.
        let [_, block, row, column] = self.posed.wrapping_mul(0x9e37_79b9).to_le_bytes();
        let sites = circuit.sites();
        let index = usize::from(block).checked_rem(sites.len()).unwrap_or(0);
        let Some(site) = sites.get(index) else { return };
        let word = circuit.word(
            site.select,
            row.checked_rem(site.rows).unwrap_or(0),
            column.checked_rem(site.columns).unwrap_or(0),
        );
        // A line that fails is found by the next scan.
        let _ = self.apply(word);
    }

    /// True if a line is not at the level it was last driven to. Lines of unknown level are not read.
    pub(crate) fn shows_another(&mut self) -> bool {
        let Some(driven) = self.driven else { return false };
        self.slots.iter().enumerate().any(|(bit, slot)| {
            let pin = self.lines.pins.get_mut(usize::from(*slot));
            let level = pin.and_then(|(_, pin)| pin.level().ok());
            level.is_some_and(|level| level != (driven >> (bit & 31) & 1 == 1))
        })
    }
}

/// By column: difference (xor) of its word from that of column 0 at the same select code and row.
type Columns = heapless::Vec<u32, { u8::MAX as usize }>;

fn column_changes(circuit: &Circuit) -> Columns {
    let mut changes = Columns::new();
    for column in 0..circuit.sites().iter().map(|s| s.columns).max().unwrap_or(0) {
        let _ = changes.push(circuit.word(0, 0, column) ^ circuit.word(0, 0, 0)); // as many as fit u8
    }
    changes
}

/// A select line failed: returns the error, with the first taxel that was being selected.
#[cold]
fn lost(pin: u8, cursors: &Cursors, column: u8) -> ScanError {
    let first = cursors.iter().find(|c| column < c.columns_here);
    ScanError::Line { pin, taxel: first.map_or(0, |c| c.taxel) as u16 }
}

/// Cursors of the blocks under one select code that the plan reads.
type Cursors = heapless::Vec<Cursor, BLOCKS>;

/// Position of a block's next sample. Set up once per block and stepped from taxel to taxel, so that a sample
/// costs no division or multiplication beside the slow select lines.
struct Cursor {
    input: u8,
    rows: u8,
    columns: u8,
    /// Columns of the present row; 0 past the block's last row.
    columns_here: u8,
    taxel: i32,
    next_row: i32,
    row_step: i32,
    column_step: i32,
}

impl Cursor {
    fn new(site: &Site) -> Cursor {
        let Site { input, rows, columns, origin, row_step, column_step, .. } = *site;
        Cursor {
            input,
            rows,
            columns,
            columns_here: 0,
            taxel: origin,
            next_row: origin,
            row_step,
            column_step,
        }
    }

    fn enter_row(&mut self, row: u8) {
        self.columns_here = if row < self.rows { self.columns } else { 0 };
        self.taxel = self.next_row;
        self.next_row += self.row_step;
    }
}

impl<P, D, A, C, const PINS: usize, const TAXELS: usize> Acquire for MuxScan<'_, P, D, A, C, PINS, TAXELS>
where
    P: OutputPin,
    D: DelayNs,
    A: Adc,
    C: Clock,
{
    async fn scan(&mut self, circuit: &Circuit, plan: &Plan) -> Result<Scan<'_>, ScanError> {
        let report = self.mux.scan(circuit, plan, &mut self.codes)?;
        Ok(Scan { codes: &self.codes, report })
    }

    fn drive(&mut self, pin: u8, level: bool) -> Result<(), ScanError> {
        self.mux.drive(pin, level)
    }
}
