//! Conditioning by its definition: every taxel of every frame, nothing left out and nothing carried from image to image.

#![allow(dead_code)]

use taxel_core::condition::{ConditionConfig, Filter, MARGIN, POINTS};
use taxel_core::format::Code;
use taxel_core::garment::{Layout, Rect};

/// Calibration, and what drift needs.
pub struct Dense {
    pub config: ConditionConfig,
    pub falling: bool,
    pub rest: Vec<u16>,
    pub gain: Vec<u16>,
    pub tared: bool,
    turn: u16,
    /// The points of the frame before: taxels that stood out of their neighbours, and what they had.
    points: Vec<(usize, u16)>,
    /// For each panel: the baselines of its witnesses when they were first asked, its drift since, the last step of it.
    panels: Vec<Option<(Vec<u16>, i32, i32)>>,
}

impl Dense {
    /// Gains of 1 but for absent taxels.
    pub fn new(layout: &Layout, config: ConditionConfig, falling: bool, rest: u16) -> Dense {
        let mut gain = Vec::new();
        for (panel, area) in layout.areas().iter().enumerate() {
            for (row, column) in (0..area.rows).flat_map(|row| (0..area.columns).map(move |c| (row, c))) {
                gain.push(if layout.is_absent(panel as u8, row, column) { 0 } else { 4096 });
            }
        }
        let rest = vec![rest; layout.taxels()];
        let panels = vec![None; layout.areas().len()];
        Dense { config, falling, rest, gain, tared: false, turn: 0, points: Vec::new(), panels }
    }

    /// The witnesses are asked anew, as after a baseline was set.
    pub fn forget(&mut self) {
        self.panels.fill(None);
    }

    /// The image of a frame; then the baseline follows drift.
    pub fn process(&mut self, layout: &Layout, codes: &[Code], panels: u8, held: &[Rect]) -> Vec<u16> {
        let before: Vec<u16> =
            (0..layout.taxels()).map(|taxel| self.value(layout, codes, panels, taxel)).collect();
        let mut after = filtered(layout, self.config.filter, &before);
        let points = std::mem::take(&mut self.points);
        if self.config.filter == Filter::Persistent {
            self.persist(&before, &mut after, &points);
        }
        if self.config.track_baseline && self.tared {
            self.follow(layout, codes, panels, held, |taxel| before[taxel] != 0 || after[taxel] != 0);
        }
        after
    }

    /// Gives back to the points of a frame the lesser of what they have and had.
    fn persist(&mut self, values: &[u16], after: &mut [u16], points: &[(usize, u16)]) {
        for (taxel, (value, after)) in values.iter().zip(after).enumerate() {
            if u32::from(*value) <= u32::from(*after) + u32::from(*after / 16) + u32::from(MARGIN) {
                continue;
            }
            if self.points.len() < POINTS {
                self.points.push((taxel, *value));
            }
            if let Some((_, had)) = points.iter().find(|(other, _)| *other == taxel) {
                *after = (*value).min(*had).max(*after);
            }
        }
    }

    fn value(&self, layout: &Layout, codes: &[Code], panels: u8, taxel: usize) -> u16 {
        let panel = layout.areas().iter().rposition(|area| usize::from(area.base) <= taxel).unwrap();
        let Some(code) = codes.get(taxel).filter(|_| panels >> panel & 1 == 1) else { return 0 };
        let (code, rest) = (i64::from(code.0), i64::from(self.rest[taxel]));
        let difference = if self.falling { rest - code } else { code - rest }.max(0);
        let value = ((difference * i64::from(self.gain[taxel]) + 2048) >> 12).min(65535) as u16;
        if value < self.config.floor { 0 } else { value }
    }

    fn follow(
        &mut self,
        layout: &Layout,
        codes: &[Code],
        panels: u8,
        held: &[Rect],
        shows: impl Fn(usize) -> bool,
    ) {
        let turn = self.turn;
        let last = layout.areas().last().map_or(0, |area| area.first_row + area.rows);
        self.turn = if turn >= last { 0 } else { turn + 1 };
        let here = layout.areas().iter().rposition(|area| area.first_row <= turn && turn < last);
        let Some(panel) = here.filter(|panel| panels >> panel & 1 == 1) else { return };
        let area = &layout.areas()[panel];
        if turn == area.first_row {
            self.vote(panel, area.base.into(), usize::from(area.rows * area.columns));
        }
        let step = self.panels[panel].as_ref().map_or(0, |(_, _, step)| *step);
        let row = turn - area.first_row;
        for column in 0..area.columns {
            let taxel = usize::from(area.base + row * area.columns + column);
            let Some(code) = codes.get(taxel) else { continue };
            let near = held.iter().any(|rect| rect.holds(panel as u8, row, column, 1));
            let own = (i32::from(code.0) - i32::from(self.rest[taxel])).signum();
            let step = if near || shows(taxel) { step } else { own };
            self.rest[taxel] = (i32::from(self.rest[taxel]) + step).clamp(0, 65535) as u16;
        }
    }

    /// Sixteen witnesses, an odd distance apart: the sign of the median of what they have drifted further than the panel.
    fn vote(&mut self, panel: usize, base: usize, taxels: usize) {
        let place = |witness: usize| base + witness * ((taxels / 16) | 1) % taxels;
        let now: Vec<u16> = (0..16).map(|witness| self.rest[place(witness)]).collect();
        let (first, drift, step) = self.panels[panel].get_or_insert_with(|| (now.clone(), 0, 0));
        let asked = (0..16).filter(|witness| self.gain[place(*witness)] != 0);
        let mut further: Vec<i32> =
            asked.map(|witness| i32::from(now[witness]) - i32::from(first[witness]) - *drift).collect();
        further.sort_unstable();
        // With an even number of them, both in the middle.
        let middle = |index: usize| further.get(index).map_or(0, |drift| drift.signum());
        let (low, high) = (middle(further.len().saturating_sub(1) / 2), middle(further.len() / 2));
        *step = if low == high { low } else { 0 };
        *drift += *step;
    }
}

/// All nine of the neighbourhood with the border replicated, or the eight that exist.
fn filtered(layout: &Layout, filter: Filter, values: &[u16]) -> Vec<u16> {
    let mut out = Vec::new();
    for area in layout.areas() {
        let (rows, columns) = (i32::from(area.rows), i32::from(area.columns));
        let at = |y: i32, x: i32| values[usize::from(area.base) + (y * columns + x) as usize];
        for (y, x) in (0..rows).flat_map(|y| (0..columns).map(move |x| (y, x))) {
            let nine = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (y + dy, x + dx)));
            let inside = |(y, x): &(i32, i32)| (0..rows).contains(y) && (0..columns).contains(x);
            out.push(match filter {
                Filter::Off => at(y, x),
                Filter::Median => {
                    let mut nine: Vec<u16> =
                        nine.map(|(y, x)| at(y.clamp(0, rows - 1), x.clamp(0, columns - 1))).collect();
                    nine.sort_unstable();
                    nine[4]
                }
                Filter::Square => {
                    let there = |y: i32, x: i32| if inside(&(y, x)) { u32::from(at(y, x)) } else { 0 };
                    let corners = [(y - 1, x - 1), (y - 1, x), (y, x - 1), (y, x)];
                    let sum = |(y, x)| there(y, x) + there(y, x + 1) + there(y + 1, x) + there(y + 1, x + 1);
                    let best = corners.map(sum).into_iter().max().unwrap_or(0);
                    at(y, x).min(((best + 2) / 4) as u16)
                }
                Filter::Conservative | Filter::Persistent => {
                    let eight = nine.filter(|place| *place != (y, x)).filter(inside);
                    let eight: Vec<u16> = eight.map(|(y, x)| at(y, x)).collect();
                    match (eight.iter().min(), eight.iter().max()) {
                        (Some(low), Some(high)) => at(y, x).clamp(*low, *high),
                        _ => at(y, x),
                    }
                }
            });
        }
    }
    out
}
