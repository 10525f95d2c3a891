//! Baseline, gain and limit of each taxel: an inactive taxel is only compared with its limit.

use super::levels::LevelLimits;
use super::scale::{UNITY, scale};
use super::terms::LimitTerms;
use crate::fold::LevelPairs;
use crate::format::Code;
use crate::garment::Layout;
use crate::image::slices::row_mut;

/// Baseline, gain and limit of every taxel.
///
/// Aligned to words, the arrays first: the limits are compared two at a time.
#[derive(Debug, Clone)]
#[repr(C, align(4))]
pub(crate) struct TaxelCalibration<const TAXELS: usize> {
    /// Baseline codes. During a tare: the low halves of the sums.
    pub baseline: [u16; TAXELS],
    /// Q4.12; 0 for absent taxels.
    pub gain: [u16; TAXELS],
    /// Last inactive code of each taxel.
    pub limit: [u16; TAXELS],
    /// Terms of the limits; none if the limits are not valid.
    pub limits_for: Option<LimitTerms>,
    /// True if every gain is 1, or 0, with which no taxel exceeds its limit.
    unity: bool,
    /// True if every gain of the garment is 1.
    ones: bool,
}

impl<const TAXELS: usize> TaxelCalibration<TAXELS> {
    /// No garment: every gain is 0.
    pub const fn new() -> Self {
        TaxelCalibration {
            baseline: [0; TAXELS],
            gain: [0; TAXELS],
            limit: [0; TAXELS],
            limits_for: None,
            unity: false,
            ones: false,
        }
    }

    /// Every baseline becomes `rest`, every gain 1.0, or 0 for absent taxels.
    pub fn reset(&mut self, layout: &Layout, rest: Code) {
        self.baseline.fill(rest.0);
        self.gain.fill(0);
        for (panel, area) in layout.areas().iter().enumerate() {
            for row in 0..area.rows {
                for (column, gain) in (0..area.columns).zip(row_mut(&mut self.gain, area, row)) {
                    *gain = if layout.is_absent(panel as u8, row, column) { 0 } else { UNITY };
                }
            }
        }
        self.limits_for = None;
    }

    /// Largest inactive difference of a code from its baseline, if every gain is 1.
    pub fn margin_of_unity(&self) -> Option<u16> {
        self.limits_for.filter(|_| self.unity).map(|terms| terms.margin_of_unity())
    }

    /// Recomputes the limits if they are for other terms, or for another calibration; true if they were.
    pub fn set_limits(&mut self, terms: LimitTerms) -> bool {
        if self.limits_for == Some(terms) {
            return false;
        }
        self.limits_for = Some(terms);
        self.unity = self.gain.iter().all(is_unity);
        self.ones = self.gain.iter().all(|gain| *gain == UNITY);
        // Neighbours often have the same gain.
        let (mut last, mut margin) = (0, u16::MAX);
        for ((limit, rest), gain) in self.limit.iter_mut().zip(&self.baseline).zip(&self.gain) {
            if *gain != last {
                (last, margin) = (*gain, terms.margin(*gain));
            }
            *limit = terms.limit(*rest, margin);
        }
        true
    }

    /// Moves the baseline of a taxel that was taken under a pressure, counts, to where it is without.
    pub fn relieve(&mut self, taxel: usize, pressure: u16, falling: bool) {
        let Some((rest, gain)) = self.baseline.get_mut(taxel).zip(self.gain.get(taxel)) else { return };
        let codes = (u32::from(pressure) << 12).checked_div((*gain).into()).unwrap_or(0).min(0xffff) as u16;
        *rest = if falling { rest.saturating_add(codes) } else { rest.saturating_sub(codes) };
    }

    /// Sets the limits of taxels on which so many counts press that are no touch; other numbers than those of
    /// taxels are left out.
    pub fn set_levels(&mut self, taxels: &[[u16; 4]], levels: &[LevelPairs], terms: LimitTerms) {
        let TaxelCalibration { baseline: rest, gain, limit, ones: are_ones, .. } = self;
        LevelLimits { rest, gain, limit, are_ones: *are_ones }.set(taxels, levels, terms);
    }

    /// Recomputes the limit of one taxel, whose calibration has changed, and on which so many counts press that
    /// are no touch.
    pub fn set_limit(&mut self, taxel: usize, level: u16) {
        let (Some(terms), Some(gain)) = (self.limits_for, self.gain.get(taxel)) else { return };
        self.unity &= is_unity(gain);
        self.ones &= *gain == UNITY;
        self.set_levels(&[[taxel as u16, u16::MAX, u16::MAX, u16::MAX]], &[[level.into(), 0]], terms);
    }

    /// Last code of a taxel with less than `level` counts of pressure; the end of the range for a silenced
    /// taxel.
    pub fn inactive_code(&self, taxel: usize, level: u16, falling: bool) -> u16 {
        let terms = LimitTerms::new(level, falling);
        let calibration = self.baseline.get(taxel).zip(self.gain.get(taxel));
        calibration.map_or(terms.silent(), |(rest, gain)| {
            let margin = if *gain == UNITY { terms.margin_of_unity() } else { terms.margin(*gain) };
            terms.limit(*rest, margin)
        })
    }

    /// Pressures of four taxels that follow each other, counts; none if one of them has another gain than 1.
    #[inline(always)] // M0+: called for taxels that fold
    pub fn pressures(&self, first: usize, codes: &[Code], falling: bool) -> Option<[u16; 4]> {
        let codes: &[Code; 4] = codes.get(first..)?.first_chunk()?;
        let rest: &[u16; 4] = self.baseline.get(first..)?.first_chunk()?;
        let gain: &[u16; 4] = self.gain.get(first..)?.first_chunk()?;
        if gain.iter().any(|gain| *gain != UNITY) {
            return None;
        }
        let mut pressures = [0; 4];
        for ((pressure, code), rest) in pressures.iter_mut().zip(codes).zip(rest) {
            let (more, less) = if falling { (*rest, code.0) } else { (code.0, *rest) };
            *pressure = more.saturating_sub(less);
        }
        Some(pressures)
    }

    /// Pressure of a taxel at a code, counts.
    #[inline(always)] // M0+: called for taxels that fold
    pub fn pressure(&self, taxel: usize, code: Code, falling: bool) -> u16 {
        match self.baseline.get(taxel).zip(self.gain.get(taxel)) {
            Some((rest, &UNITY)) if falling => rest.saturating_sub(code.0),
            Some((rest, &UNITY)) => code.0.saturating_sub(*rest),
            Some((rest, gain)) => scaled(code, *rest, *gain, falling),
            None => 0,
        }
    }
}

/// Pressure of a taxel with any gain, counts.
#[inline(never)] // M0+: out of line
fn scaled(code: Code, rest: u16, gain: u16, falling: bool) -> u16 {
    let scale = if falling { scale::<1, true> } else { scale::<1, false> };
    let mut value = [0];
    scale(&[code], &[rest], &[rest], &[gain], &mut value);
    let [value] = value;
    value
}

fn is_unity(gain: &u16) -> bool {
    matches!(*gain, 0 | UNITY)
}
