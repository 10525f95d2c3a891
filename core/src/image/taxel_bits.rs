//! A bit for each taxel of a garment.

use crate::capacity::TAXELS;

/// Words of a bit for each taxel, and one more, so that each of those has a next one.
const WORDS: usize = TAXELS.div_ceil(32) + 1;

/// A bit for each taxel, by number.
pub(crate) struct TaxelBits([u32; WORDS]);

impl TaxelBits {
    /// No taxel.
    pub const NONE: TaxelBits = TaxelBits([0; WORDS]);

    /// Marks taxels from `first` on, by bits, in so many rows of a panel of so many columns.
    #[inline(never)] // M0+: own registers
    pub fn mark(&mut self, mut first: usize, bits: u32, (rows, columns): (u16, usize)) {
        for _ in 0..rows {
            let (word, bit) = (first / 32, first % 32);
            if let Some([word, next]) = self.0.get_mut(word..).and_then(|words| words.first_chunk_mut()) {
                *word |= bits << bit;
                // In two steps: by 32 nothing can be shifted.
                *next |= bits >> 1 >> (31 - bit);
            }
            first += columns;
        }
    }

    /// The bits of 32 taxels from `first` on.
    #[inline(always)]
    pub fn from(&self, first: usize) -> u32 {
        let (word, bit) = (first / 32, first % 32);
        let Some([word, next]) = self.0.get(word..).and_then(|words| words.first_chunk()) else {
            return 0;
        };
        // In two steps: by 32 nothing can be shifted.
        word >> bit | next << 1 << (31 - bit)
    }

    /// True if a taxel is one of them.
    #[inline(always)]
    pub fn has(&self, taxel: usize) -> bool {
        self.0.get(taxel / 32).is_some_and(|word| word >> (taxel % 32) & 1 == 1)
    }
}
