//! Percentiles by a histogram, without keeping the values.

/// Number of bins of a histogram.
const BINS: usize = 64;

/// Counts of values in bins of `1 << SHIFT`; greater values fall into the last bin.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Histogram<const SHIFT: u32> {
    bins: [u16; BINS],
}

impl<const SHIFT: u32> Default for Histogram<SHIFT> {
    fn default() -> Self {
        Histogram::new()
    }
}

impl<const SHIFT: u32> Histogram<SHIFT> {
    /// Empty histogram.
    pub const fn new() -> Histogram<SHIFT> {
        Histogram { bins: [0; BINS] }
    }

    /// Counts a value; a bin holds 65,535 at most.
    pub fn add(&mut self, value: u16) {
        if let Some(bin) = self.bins.get_mut(usize::from(value >> SHIFT).min(BINS - 1)) {
            *bin = bin.saturating_add(1);
        }
    }

    /// Returns the percentiles of `count` values at `shares`, in 256ths and ascending. Values of a bin count
    /// as evenly spread in it.
    pub fn percentiles<const N: usize>(&self, shares: &[u16; N], count: u32) -> [u16; N] {
        let mut bins = self.bins.iter().enumerate();
        let (mut below, mut bin, mut held) = (0u32, 0u32, 0u32);
        shares.map(|share| {
            let rank = (u32::from(share) * count) >> 8;
            while below + held <= rank {
                let Some((index, next)) = bins.next() else { break };
                below += held;
                (bin, held) = (index as u32, (*next).into());
            }
            let within = (rank.saturating_sub(below) << SHIFT) + ((1 << SHIFT) >> 1);
            ((bin << SHIFT) + within / held.max(1)) as u16
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_of_an_even_spread() {
        let mut histogram = Histogram::<6>::default();
        (0..4096).for_each(|value| histogram.add(value));
        let have = histogram.percentiles(&[0, 26, 64, 128, 192, 255], 4096);
        for (have, want) in have.into_iter().zip([0, 416, 1024, 2048, 3072, 4080]) {
            assert!(u16::abs_diff(have, want) <= 1, "{have} of {want}");
        }
    }

    #[test]
    fn one_value_is_every_percentile() {
        let mut histogram = Histogram::<4>::default();
        (0..9).for_each(|_| histogram.add(500));
        for percentile in histogram.percentiles(&[13, 128, 243], 9) {
            assert!(percentile >> 4 == 500 >> 4);
        }
    }
}
