//! Self-test of the select lines: each is driven alone, and the levels of all are read.

use super::{Fault, Findings};
use crate::acquire::{Clock, Lines, ProbePin, Pull, ScanError};
use crate::garment::{CIRCUIT_LINES, Circuit};
use embedded_hal::delay::DelayNs;
use heapless::Vec;

/// Time in which a line of 400 pF follows a resistor of 80 kOhm to within 5 %.
pub(super) const PULLED_NS: u32 = 100_000;

/// Levels of all lines while one of them is driven, as words of the circuit.
struct ShownLevels {
    /// Driven high, all others pulled down.
    high: u32,
    /// Driven low, all others pulled up.
    low: u32,
}

/// Examines the lines. Afterwards none is driven or pulled.
pub(super) fn examine<P: ProbePin, const PINS: usize>(
    lines: &mut Lines<P, PINS>,
    delay: &mut impl DelayNs,
    clock: &impl Clock,
    circuit: &Circuit,
    findings: &mut Findings,
) -> Result<(), ScanError> {
    let shown = try_all(lines, delay, clock, circuit);
    release(lines, circuit, Pull::None)?;
    findings.lines = circuit.lines().len() as u8;
    judge(circuit, &shown?, findings);
    Ok(())
}

/// Drives each line to both levels.
fn try_all<P: ProbePin, const PINS: usize>(
    lines: &mut Lines<P, PINS>,
    delay: &mut impl DelayNs,
    clock: &impl Clock,
    circuit: &Circuit,
) -> Result<Vec<ShownLevels, CIRCUIT_LINES>, ScanError> {
    let mut all = Vec::new();
    for pin in circuit.lines() {
        let mut show = |level: bool| {
            release(lines, circuit, if level { Pull::Down } else { Pull::Up })?;
            let driven = lines.drive(*pin, level).ok_or(ScanError::NoPin(*pin))?;
            driven.map_err(|_| ScanError::Output(*pin))?;
            delay.delay_ns(PULLED_NS);
            look(lines, circuit)
        };
        let _ = all.push(ShownLevels { high: show(true)?, low: show(false)? }); // as many as a circuit has
        clock.progressed();
    }
    Ok(all)
}

fn release<P: ProbePin, const PINS: usize>(
    lines: &mut Lines<P, PINS>,
    circuit: &Circuit,
    pull: Pull,
) -> Result<(), ScanError> {
    circuit.lines().iter().try_for_each(|pin| {
        let released = lines.release(*pin, pull).ok_or(ScanError::NoPin(*pin))?;
        released.map_err(|_| ScanError::Output(*pin))
    })
}

/// Levels of all lines, bit `i` for line `i` of the circuit.
fn look<P: ProbePin, const PINS: usize>(
    lines: &mut Lines<P, PINS>,
    circuit: &Circuit,
) -> Result<u32, ScanError> {
    circuit.lines().iter().rev().try_fold(0, |word, pin| {
        let level = lines.level(*pin).ok_or(ScanError::NoPin(*pin))?;
        Ok(word << 1 | u32::from(level.map_err(|_| ScanError::Output(*pin))?))
    })
}

fn judge(circuit: &Circuit, shown: &[ShownLevels], findings: &mut Findings) {
    let is_high = |word: u32, line: usize| word >> line & 1 == 1;
    for (line, (pin, own)) in circuit.lines().iter().zip(shown).enumerate() {
        if !is_high(own.high, line) {
            findings.add(*pin, Fault::StuckLow);
        } else if is_high(own.low, line) {
            findings.add(*pin, Fault::StuckHigh);
        }
        // Each pair once. A diode between the lines lets only one of them follow the other.
        let later = circuit.lines().iter().zip(shown).enumerate().skip(line + 1);
        for (other, (other_pin, driven)) in later {
            let follows = is_high(own.high, other) && !is_high(own.low, other);
            if follows || (is_high(driven.high, line) && !is_high(driven.low, line)) {
                findings.add(*pin, Fault::Bridged(*other_pin));
            }
        }
    }
}
