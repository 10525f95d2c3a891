//! Residue of the previous taxel in a taxel's code: the slope of quick scans against slow ones.

use taxel_core::garment::Circuit;

/// Steps of the image at one converter input in scan order.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Steps {
    /// GPIO number of the input.
    pub input: u8,
    /// Taxels read one after the other: earlier, later.
    pairs: Vec<(usize, usize)>,
}

/// Share of a step that is left at the sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Residue {
    /// 0: none; 1: all.
    pub part: f64,
    /// Standard error of the share; infinite if the image has no steps.
    pub error: f64,
}

/// Steps of each input, in the order of the inputs: the first has the least time to settle.
pub fn steps(circuit: &Circuit) -> Vec<Steps> {
    let mut inputs: Vec<u8> = circuit.sites().iter().map(|site| site.input).collect();
    inputs.sort_unstable();
    inputs.dedup();
    inputs.into_iter().map(|input| Steps { input, pairs: pairs(circuit, input) }).collect()
}

/// Neighbours in time, unless another address lies between, which the line has seen.
fn pairs(circuit: &Circuit, input: u8) -> Vec<(usize, usize)> {
    let mut pairs = Vec::new();
    let mut before = None;
    for sites in circuit.selects() {
        let rows = sites.iter().map(|site| site.rows).max().unwrap_or(0);
        for row in 0..rows {
            let here = || sites.iter().filter(|site| row < site.rows);
            for column in 0..here().map(|site| site.columns).max().unwrap_or(0) {
                let site = here().find(|site| site.input == input && column < site.columns);
                let taxel = site.map(|site| site.taxel(row, column));
                pairs.extend(before.zip(taxel));
                before = taxel;
            }
        }
    }
    pairs
}

impl Steps {
    /// Residue in quick codes of the steps in slow codes, both means by taxel.
    ///
    /// Least squares over two causes: the step from the previous taxel, and the taxel's own height above the
    /// median, so that a press that changed between the scans does not count as a residue.
    pub fn residue(&self, slow: &[f64], quick: &[f64]) -> Residue {
        let value = |codes: &[f64], taxel: usize| codes.get(taxel).copied().unwrap_or(0.0);
        let mut heights: Vec<f64> = self.pairs.iter().map(|(_, taxel)| value(slow, *taxel)).collect();
        heights.sort_by(f64::total_cmp);
        let rest = heights.get(heights.len() / 2).copied().unwrap_or(0.0);
        let rows: Vec<[f64; 3]> = self
            .pairs
            .iter()
            .map(|(before, taxel)| {
                let at = value(slow, *taxel);
                [value(slow, *before) - at, at - rest, value(quick, *taxel) - at]
            })
            .collect();
        let sum = |a: usize, b: usize| rows.iter().map(|row| row[a] * row[b]).sum::<f64>();
        let (ss, sh, hh, sr, hr) = (sum(0, 0), sum(0, 1), sum(1, 1), sum(0, 2), sum(1, 2));
        let determinant = ss * hh - sh * sh;
        if rows.len() < 3 || determinant <= 1e-9 * ss * hh || determinant <= 0.0 {
            return Residue { part: 0.0, error: f64::INFINITY };
        }
        let part = (sr * hh - hr * sh) / determinant;
        let change = (hr * ss - sr * sh) / determinant;
        let left: f64 =
            rows.iter().map(|[step, height, off]| (off - part * step - change * height).powi(2)).sum();
        let variance = left / (rows.len() - 2) as f64;
        Residue { part, error: (variance * hh / determinant).sqrt() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use taxel_core::garment::{Garment, Layout, Pins};

    fn circuit(garment: &Garment) -> Circuit {
        let layout = Layout::build(garment, 2048, 4095).unwrap();
        Circuit::build(garment, &layout, Pins::ANY).unwrap()
    }

    #[test]
    fn a_residue_is_found_beside_a_press_that_grows() {
        let steps = steps(&circuit(&Garment::reference()));
        assert_eq!(
            steps.iter().map(|s| (s.input, s.pairs.len())).collect::<Vec<_>>(),
            [26, 27, 28, 29].map(|i| (i, 511))
        );
        let slow: Vec<f64> = (0..2048)
            .map(|taxel| if taxel % 512 / 16 > 20 && taxel % 7 < 3 { 1500.0 } else { 90.0 })
            .collect();
        let mut quick = slow.clone();
        for (before, taxel) in &steps[1].pairs {
            quick[*taxel] += 0.01 * (slow[*before] - slow[*taxel]) + 0.03 * (slow[*taxel] - 90.0);
        }
        let residue = steps[1].residue(&slow, &quick);
        assert!((residue.part - 0.01).abs() < 1e-9 && residue.error < 1e-9, "{residue:?}");
        assert!(steps[0].residue(&slow, &quick).part.abs() < 1e-12);
        assert_eq!(steps[0].residue(&[90.0; 2048], &quick).error, f64::INFINITY);
    }
}
