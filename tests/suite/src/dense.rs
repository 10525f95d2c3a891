//! The plain chain: every taxel is calibrated, filtered, labelled and summed by definition, touched or not.
//! Without seams, shapes and tracks, it does less than the core.

use crate::chain::TAXELS;
use crate::pattern::TouchPattern;
use taxel_core::format::Code;

const COLUMNS: usize = 16;
const ROWS: usize = 32;
/// Values of the shipped scene.
const FLOOR: u16 = 14;
const LOW: u16 = 16;
/// Greatest number of contacts that are summed.
const CONTACTS: usize = 32;

/// State of the chain.
pub struct Dense {
    rest: [Code; TAXELS],
    values: [u16; TAXELS],
    filtered: [u16; TAXELS],
    labels: [u16; TAXELS],
    sums: [Sums; CONTACTS],
}

/// Sums of a contact.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct Sums {
    /// Label of the contact, from 1.
    label: u16,
    /// sum f
    pub m: u64,
    /// sum x f, sum y f
    pub first: [u64; 2],
    /// sum x^2 f, sum y^2 f, sum x y f
    pub second: [u64; 3],
}

impl Default for Dense {
    fn default() -> Dense {
        Dense::new()
    }
}

impl Dense {
    /// A chain with the first frame of noise as its baseline.
    pub fn new() -> Dense {
        let mut rest = [Code(0); TAXELS];
        TouchPattern::Empty.codes(0, &mut rest);
        let [values, filtered, labels] = [[0; TAXELS]; 3];
        Dense { rest, values, filtered, labels, sums: [Sums::default(); CONTACTS] }
    }

    /// Returns the contacts of a frame in the order of their first taxels.
    #[inline(never)]
    pub fn process(&mut self, codes: &[Code; TAXELS]) -> &[Sums] {
        for ((value, code), rest) in self.values.iter_mut().zip(codes).zip(&self.rest) {
            let pressure = code.0.saturating_sub(rest.0);
            *value = if pressure < FLOOR { 0 } else { pressure };
        }
        for taxel in 0..TAXELS {
            self.filter(taxel);
        }
        self.label();
        self.sum()
    }

    /// Clamps a taxel to the smallest and the largest of its neighbours.
    fn filter(&mut self, taxel: usize) {
        let (mut low, mut high) = (u16::MAX, 0);
        for neighbour in neighbours(taxel) {
            let value = self.values.get(neighbour).copied().unwrap_or(0);
            (low, high) = (low.min(value), high.max(value));
        }
        let value = self.values.get(taxel).copied().unwrap_or(0);
        if let Some(out) = self.filtered.get_mut(taxel) {
            *out = value.max(low).min(high);
        }
    }

    /// Gives each taxel the smallest label around it, until nothing changes.
    fn label(&mut self) {
        for (taxel, (label, value)) in (1u16..).zip(self.labels.iter_mut().zip(&self.filtered)) {
            *label = if *value < LOW { 0 } else { taxel };
        }
        loop {
            let mut changed = false;
            for taxel in (0..TAXELS).chain((0..TAXELS).rev()) {
                let own = self.at(taxel);
                if own == 0 {
                    continue;
                }
                let around = neighbours(taxel).map(|n| self.at(n)).filter(|label| *label > 0);
                let least = around.fold(own, u16::min);
                if let Some(label) = self.labels.get_mut(taxel).filter(|label| **label != least) {
                    *label = least;
                    changed = true;
                }
            }
            if !changed {
                return;
            }
        }
    }

    fn at(&self, taxel: usize) -> u16 {
        self.labels.get(taxel).copied().unwrap_or(0)
    }

    fn sum(&mut self) -> &[Sums] {
        let mut count = 0;
        for (taxel, (label, value)) in self.labels.iter().zip(&self.filtered).enumerate() {
            if *label == 0 {
                continue;
            }
            let known = self.sums.iter().take(count).position(|sums| sums.label == *label);
            let index = known.unwrap_or(count);
            let Some(sums) = self.sums.get_mut(index) else { continue };
            if known.is_none() {
                *sums = Sums { label: *label, ..Sums::default() };
                count += 1;
            }
            let (x, y) = ((taxel % COLUMNS) as u64, (taxel / COLUMNS % ROWS) as u64);
            let f = u64::from(*value);
            sums.m += f;
            sums.first = [sums.first[0] + x * f, sums.first[1] + y * f];
            let [xx, yy, xy] = sums.second;
            sums.second = [xx + x * x * f, yy + y * y * f, xy + x * y * f];
        }
        self.sums.get(..count).unwrap_or(&[])
    }
}

/// Neighbours of a taxel in its panel.
fn neighbours(taxel: usize) -> impl Iterator<Item = usize> {
    let (row, column) = (taxel / COLUMNS % ROWS, taxel % COLUMNS);
    let rows = row.saturating_sub(1)..=(row + 1).min(ROWS - 1);
    let first = taxel - row * COLUMNS - column;
    rows.flat_map(move |y| {
        let columns = column.saturating_sub(1)..=(column + 1).min(COLUMNS - 1);
        columns.map(move |x| first + y * COLUMNS + x)
    })
    .filter(move |neighbour| *neighbour != taxel)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::TouchPattern;

    #[test]
    fn it_finds_the_contacts_of_a_scene() {
        let mut codes = [Code(0); TAXELS];
        for (pattern, count) in [(TouchPattern::Empty, 0), (TouchPattern::One, 1), (TouchPattern::Texture, 4)]
        {
            pattern.codes(0, &mut codes);
            assert_eq!(Dense::new().process(&codes).len(), count, "{}", pattern.name());
        }
    }
}
