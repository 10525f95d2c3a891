//! Effects of wiring and converter on a signal: settling of the lines, sneak paths of a passive matrix,
//! unequal code widths of a converter.

use super::decode::Decoder;
use libm::exp;
use taxel_core::garment::Garment;

/// Line to one converter input: a capacitance charged through the taxel at the present address.
#[derive(Debug, Clone, Default)]
pub(super) struct Line {
    /// Signal at the last sample, and its final value, counts.
    held: f32,
    target: f32,
    sampled_ns: u64,
    /// Signal at the last change of a select line, counts.
    before: f32,
    changed_ns: Option<u64>,
}

impl Line {
    /// Signal at `t_ns` if the address changed at `changed_ns` to a taxel whose settled signal is `target`.
    pub fn settle(&mut self, target: f32, changed_ns: u64, t_ns: u64, tau_ns: f64) -> f32 {
        if self.changed_ns != Some(changed_ns) {
            self.changed_ns = Some(changed_ns);
            self.before =
                approach(self.held, self.target, changed_ns.saturating_sub(self.sampled_ns), tau_ns);
        }
        self.held = approach(self.before, target, t_ns.saturating_sub(changed_ns), tau_ns);
        self.target = target;
        self.sampled_ns = t_ns;
        self.held
    }
}

/// Exponential approach.
fn approach(from: f32, to: f32, since_ns: u64, tau_ns: f64) -> f32 {
    to + (from - to) * exp(-(since_ns as f64) / tau_ns) as f32
}

/// Returns for each taxel the other taxels on its wired row and column within the block.
pub(super) fn mates(garment: &Garment, decoder: &Decoder, taxels: usize) -> Vec<Vec<u16>> {
    let mut mates = vec![Vec::new(); taxels];
    for block in &garment.blocks {
        let at = |row, column| decoder.taxel_of(block, row, column);
        for (row, column) in (0..block.rows).flat_map(|r| (0..block.columns).map(move |c| (r, c))) {
            let same_row = (0..block.columns).filter(|c| *c != column).map(|c| at(row, c));
            let same_column = (0..block.rows).filter(|r| *r != row).map(|r| at(r, column));
            if let Some(list) = mates.get_mut(at(row, column)) {
                *list = same_row.chain(same_column).filter_map(|taxel| u16::try_from(taxel).ok()).collect();
            }
        }
    }
    mates
}

/// Codes of the RP2040's converter that are nine codes wide (erratum RP2040-E11).
const WIDE: [f32; 4] = [512.0, 1536.0, 2560.0, 3584.0];
/// Additional width of those codes, counts.
const EXTRA: f32 = 8.0;

/// Transfer curve of the converter, from and to 0 ..= 4095 counts.
pub(super) fn uneven(signal: f32) -> f32 {
    // All codes together span the same range of voltages, so the others are a little narrower.
    let stretched = signal * ((4096.0 + EXTRA * WIDE.len() as f32) / 4096.0);
    let mut passed = 0.0;
    for wide in WIDE {
        let above = stretched - passed - wide;
        if above < 0.0 {
            break;
        }
        if above < EXTRA {
            return wide;
        }
        passed += EXTRA;
    }
    stretched - passed
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_approaches_the_taxel_under_the_new_address() {
        let mut line = Line::default();
        let settled = line.settle(1000.0, 0, 100_000, 1000.0);
        assert!((settled - 1000.0).abs() < 1e-3);
        let early = line.settle(0.0, 200_000, 201_000, 1000.0);
        assert!((early - 1000.0 / std::f32::consts::E).abs() < 0.01, "{early}");
        // A second sample at the same address is later on the same curve.
        let later = line.settle(0.0, 200_000, 202_000, 1000.0);
        assert!((later - early / std::f32::consts::E).abs() < 0.01, "{later}");
    }

    #[test]
    fn four_codes_are_nine_wide_and_the_ends_stay() {
        let mut widths = vec![0u32; 4097];
        for step in 0..409_600 {
            widths[uneven(step as f32 / 100.0).floor() as usize] += 1;
        }
        for code in [512, 1536, 2560, 3584] {
            assert!((widths[code] as i32 - 893).abs() < 5, "{code} is {} wide", widths[code]);
        }
        assert!((widths[1000] as i32 - 99).abs() <= 2);
        assert_eq!(uneven(0.0), 0.0);
        assert!((uneven(4095.0) - 4095.0).abs() < 0.1);
    }
}
