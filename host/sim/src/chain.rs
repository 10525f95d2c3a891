//! From a taxel's signal to its code, without a scene: settling lines, and a converter with noise and uneven
//! codes.

use super::noise::{UNIT_NOISE_RMS, unit_noise};
use super::script::{Converter, WiringEffects};
use super::signal::FULL_SCALE;
use super::wiring::{Line, uneven};
use taxel_core::acquire::{Depth, Rounds};

/// Scan of a garment with several converter inputs: each address is applied, waited for, and read on every
/// input in turn, so that the first input has the least time to settle. Dropped conversions take time as
/// well.
#[derive(Debug, Clone)]
pub struct Chain {
    /// Effects of the wiring.
    pub wiring: WiringEffects,
    /// Effects of the converter; its noise stands for all noise of a sample.
    pub converter: Converter,
    /// Timing of the conversions.
    pub rounds: Rounds,
    /// Number of converter inputs.
    pub inputs: usize,
    /// Bits kept of a sample.
    pub depth: Depth,
}

impl Chain {
    /// Duration of a scan over this many addresses, ns.
    pub fn scan_ns(&self, addresses: usize) -> u64 {
        self.rounds.address_ns() * addresses as u64
    }

    /// Scans signals (counts, by address, then by input) `scans` times, and passes on the codes of each scan.
    pub fn scan(&self, signals: &[f32], scans: usize, mut codes: impl FnMut(&[u16])) {
        let mut lines = vec![Line::default(); self.inputs];
        let noise = self.converter.noise_counts as f32 / UNIT_NOISE_RMS;
        let mut frame = vec![0; signals.len()];
        let mut now = 0;
        for _ in 0..scans {
            for (address, (signals, frame)) in
                signals.chunks(self.inputs).zip(frame.chunks_mut(self.inputs)).enumerate()
            {
                let changed = now;
                now += self.rounds.settling_ns();
                for (input, ((signal, code), line)) in signals.iter().zip(frame).zip(&mut lines).enumerate() {
                    let settled = self.settled(line, *signal, changed, now);
                    let key = (address * self.inputs + input) as u64;
                    let noisy =
                        settled + noise * unit_noise(key.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1, now);
                    *code = self.depth.keep(self.code(noisy));
                    now += self.rounds.period_ns();
                }
                now = changed + self.rounds.address_ns();
            }
            codes(&frame);
        }
    }

    fn settled(&self, line: &mut Line, signal: f32, changed_ns: u64, now_ns: u64) -> f32 {
        let tau_ns = self.wiring.settling_ns();
        if tau_ns > 0.0 { line.settle(signal, changed_ns, now_ns, tau_ns) } else { signal }
    }

    fn code(&self, signal: f32) -> u16 {
        let curved = if self.converter.dnl { uneven(signal) } else { signal };
        ((curved + 0.5) as u16).min(FULL_SCALE)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const IDEAL: Chain = Chain {
        rounds: Rounds::of(4, 2_000),
        wiring: WiringEffects { source_kohm: 0.0, line_pf: 0.0, crosstalk: 0.0, passive: false },
        converter: Converter { dnl: false, noise_counts: 0.0 },
        inputs: 4,
        depth: Depth::Twelve,
    };

    fn codes(chain: &Chain, signals: &[f32]) -> Vec<u16> {
        let mut all = Vec::new();
        chain.scan(signals, 2, |codes| all.extend_from_slice(codes));
        all
    }

    #[test]
    fn an_ideal_chain_rounds() {
        let signals: Vec<f32> = (0..4096).map(|code| code as f32 + 0.4).collect();
        let want: Vec<u16> = (0..4096).collect();
        let have = codes(&IDEAL, &signals);
        assert_eq!(have[..4096], want);
        assert_eq!(have[4096..], want);
        let eight = codes(&Chain { depth: Depth::Eight, ..IDEAL }, &signals);
        assert_eq!((eight[0], eight[0x123], eight[4095]), (0, 0x121, 4095));
        assert_eq!(IDEAL.scan_ns(512), 5_120_000);
    }

    #[test]
    fn a_later_input_has_settled_further() {
        let wiring = WiringEffects { source_kohm: 10.0, line_pf: 100.0, ..WiringEffects::default() };
        let slow = Chain { wiring, ..IDEAL };
        // Both addresses from the first scan on: the steps are from 4000 to 0.
        let have = codes(&slow, &[4000.0, 4000.0, 4000.0, 4000.0, 0.0, 0.0, 0.0, 0.0]);
        let residue = &have[12..16];
        // Time constant of 1 us: after 2, 4, 6 and 8 us. The line had 10 us to reach 4000.
        let want = [2.0f64, 4.0, 6.0, 8.0].map(|t: f64| (4000.0 * libm::exp(-t)).round() as u16);
        assert_eq!(residue, want);
    }
}
