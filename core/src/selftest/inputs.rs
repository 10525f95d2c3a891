//! Self-test of the converter inputs: each is pulled both ways and read at the corners of its blocks.

use super::lines::PULLED_NS;
use super::{Fault, Findings};
use crate::acquire::{Clock, Lines, ProbePin, Pull, PulledAdc, ScanError};
use crate::format::Extremes;
use crate::garment::{BLOCKS, Circuit, Site};
use embedded_hal::delay::DelayNs;
use heapless::Vec;

/// Largest code of a converter.
const FULL: u16 = 4095;
/// Largest distance from an end of the range at which an input counts as shorted to that end: offset and
/// noise of the converter.
const RAIL: u16 = 32;
/// Largest distance from an end at which an input has followed its pull resistor there.
const FOLLOWED: u16 = FULL / 8;

/// An input and its codes under each pull.
struct PulledInput {
    pin: u8,
    up: Extremes,
    down: Extremes,
}

/// Examines the inputs. Afterwards none is pulled; the lines stay driven.
pub(super) fn examine<P: ProbePin, A: PulledAdc, const PINS: usize>(
    lines: &mut Lines<P, PINS>,
    delay: &mut impl DelayNs,
    adc: &mut A,
    clock: &impl Clock,
    circuit: &Circuit,
    findings: &mut Findings,
) -> Result<(), ScanError> {
    let mut inputs = Vec::<PulledInput, BLOCKS>::new();
    for site in circuit.sites() {
        if !inputs.iter().any(|input| input.pin == site.input) {
            // Always room: a circuit has at most BLOCKS blocks, and each has one input.
            let _ = inputs.push(PulledInput { pin: site.input, up: Extremes::NONE, down: Extremes::NONE });
        }
    }
    let read = [Pull::Up, Pull::Down].into_iter().try_for_each(|pull| {
        pull_all(adc, &inputs, pull)?;
        delay.delay_ns(PULLED_NS);
        circuit.selects().try_for_each(|sites| {
            clock.progressed();
            read(lines, delay, adc, (circuit, sites, pull), &mut inputs)
        })
    });
    pull_all(adc, &inputs, Pull::None)?;
    read?;
    findings.inputs = inputs.len() as u8;
    for input in &inputs {
        if let Some(fault) = input.fault() {
            findings.add(input.pin, fault);
        }
    }
    Ok(())
}

impl PulledInput {
    fn fault(&self) -> Option<Fault> {
        let PulledInput { up, down, .. } = self;
        if up.low >= FULL - FOLLOWED && down.high <= FOLLOWED {
            Some(Fault::Open)
        } else if up.high <= RAIL {
            Some(Fault::Grounded)
        } else if down.low >= FULL - RAIL {
            Some(Fault::Supplied)
        } else {
            None
        }
    }
}

fn pull_all<A: PulledAdc>(adc: &mut A, inputs: &[PulledInput], pull: Pull) -> Result<(), ScanError> {
    inputs.iter().try_for_each(|i| adc.pull(i.pin, pull).map_err(|_| ScanError::Output(i.pin)))
}

/// Reads the corners of the blocks that share a select code.
fn read<P: ProbePin, A: PulledAdc, const PINS: usize>(
    lines: &mut Lines<P, PINS>,
    delay: &mut impl DelayNs,
    adc: &mut A,
    (circuit, sites, pull): (&Circuit, &[Site], Pull),
    inputs: &mut [PulledInput],
) -> Result<(), ScanError> {
    let select = sites.first().map_or(0, |site| site.select);
    let last_row = sites.iter().map(|site| site.rows).max().unwrap_or(1).saturating_sub(1);
    let last_column = sites.iter().map(|site| site.columns).max().unwrap_or(1).saturating_sub(1);
    for (row, column) in [(0, 0), (0, last_column), (last_row, 0), (last_row, last_column)] {
        apply(lines, circuit, circuit.word(select, row, column))?;
        delay.delay_ns(circuit.settle_ns());
        for site in sites.iter().filter(|site| row < site.rows && column < site.columns) {
            let Some(input) = inputs.iter_mut().find(|input| input.pin == site.input) else { continue };
            let taxel = site.taxel(row, column) as u16;
            let code = adc.read(site.input).map_err(|_| ScanError::Converter { input: site.input, taxel })?;
            if pull == Pull::Up { &mut input.up } else { &mut input.down }.take(code);
        }
    }
    Ok(())
}

fn apply<P: ProbePin, const PINS: usize>(
    lines: &mut Lines<P, PINS>,
    circuit: &Circuit,
    word: u32,
) -> Result<(), ScanError> {
    circuit.lines().iter().enumerate().try_for_each(|(bit, pin)| {
        let driven = lines.drive(*pin, word >> (bit & 31) & 1 == 1).ok_or(ScanError::NoPin(*pin))?;
        driven.map_err(|_| ScanError::Output(*pin))
    })
}
