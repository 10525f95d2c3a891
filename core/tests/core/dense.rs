//! Conditioning by its definition: every taxel of every frame, nothing left out and nothing carried from
//! image to image.

#![allow(dead_code)]

use taxel_core::condition::{ConditionConfig, Filter, MARGIN, POINTS, Pressed, Sampled};
use taxel_core::format::Code;
use taxel_core::garment::{Area, Layout};

/// Calibration, and what drift needs.
pub struct DenseCondition {
    pub config: ConditionConfig,
    pub falling: bool,
    pub rest: Vec<u16>,
    pub gain: Vec<u16>,
    pub tared: bool,
    /// Whose turn it is to follow drift: panel after panel its witnesses, then its rows; and when, us.
    slot: u16,
    due: u64,
    /// The points of the frame before: taxels that stood out of their neighbours, and what they had.
    points: Vec<(usize, u16)>,
    /// What each panel drifted in the half of a turn before and drifts in this one, and where its witnesses
    /// would be, had they drifted as it has.
    common: Vec<([i32; 2], Option<Vec<i32>>)>,
    /// How fast each panel drifts of late.
    pace: Vec<DensePace>,
    /// What its witnesses miss.
    missed: Vec<DenseMissed>,
}

/// Mean drift of a panel in a turn, and its greatest size of late, sixteenths of a count.
#[derive(Clone, Copy, Default)]
struct DensePace {
    mean: i32,
    greatest: i32,
}

/// Steps of untouched taxels beyond those of the witnesses: their sum and number in this turn, their mean in
/// the last one (whole counts, and 256ths left over), and sums of it in the way of the drift and of the
/// drift, which fade.
#[derive(Clone, Copy, Default)]
struct DenseMissed {
    now: (i32, i32),
    step: i32,
    left: i32,
    lost: i32,
    way: i32,
}

impl DenseCondition {
    /// Gains of 1 but for absent taxels.
    pub fn new(layout: &Layout, config: ConditionConfig, falling: bool, rest: u16) -> DenseCondition {
        let mut gain = Vec::new();
        for (panel, area) in layout.areas().iter().enumerate() {
            for (row, column) in (0..area.rows).flat_map(|row| (0..area.columns).map(move |c| (row, c))) {
                gain.push(if layout.is_absent(panel as u8, row, column) { 0 } else { 4096 });
            }
        }
        let rest = vec![rest; layout.taxels()];
        let common = vec![([0; 2], None); layout.areas().len()];
        DenseCondition {
            config,
            falling,
            rest,
            gain,
            tared: false,
            slot: 0,
            due: 0,
            points: Vec::new(),
            pace: vec![DensePace::default(); common.len()],
            missed: vec![DenseMissed::default(); common.len()],
            common,
        }
    }

    /// No drift is known, as after a baseline was set.
    pub fn forget(&mut self) {
        self.common.fill(([0; 2], None));
        self.pace.fill(DensePace::default());
        self.missed.fill(DenseMissed::default());
    }

    /// The image of a frame; then the baseline follows drift.
    pub fn process(&mut self, layout: &Layout, sampled: &Sampled<'_>, held: &[Pressed]) -> Vec<u16> {
        let Sampled { codes, panels, .. } = *sampled;
        let before: Vec<u16> =
            (0..layout.taxels()).map(|taxel| self.value(layout, codes, panels, taxel)).collect();
        let mut after = filtered(layout, self.config.filter, &before);
        let points = std::mem::take(&mut self.points);
        if self.config.filter == Filter::Persistent {
            self.persist(&before, &mut after, &points);
        }
        if self.config.track_baseline && self.tared {
            let shown: Vec<u16> = before.iter().zip(&after).map(|(a, b)| *a.max(b)).collect();
            self.follow(layout, sampled, held, &shown);
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

    /// What a panel drifts in a whole turn.
    fn in_turn(&self, panel: usize) -> i32 {
        self.common[panel].0.iter().sum()
    }

    /// Every row once in 0.7 s, or in 0.35 s while a panel drifts fast, and before either half of a panel's
    /// rows its witnesses.
    fn follow(&mut self, layout: &Layout, sampled: &Sampled<'_>, held: &[Pressed], shown: &[u16]) {
        let slots: u16 = layout.areas().iter().map(|area| area.rows + 2).sum();
        while self.due <= sampled.now.0 {
            let mut slot = self.slot;
            self.slot = (self.slot + 1) % slots;
            let fast = (0..layout.areas().len()).any(|panel| self.in_turn(panel).abs() > 4);
            let row_us = 700_000 / u64::from(slots) / if fast { 2 } else { 1 };
            self.due = self.due.max(sampled.now.0.saturating_sub(700_000)) + row_us;
            for (panel, area) in layout.areas().iter().enumerate() {
                if slot < area.rows + 2 {
                    let first = area.rows / 2;
                    if sampled.panels >> panel & 1 == 0 {
                    } else if slot == 0 || slot == first + 1 {
                        self.vote(panel, area, sampled.codes, held, shown, slot == 0);
                    } else {
                        let row = if slot <= first { slot - 1 } else { slot - 2 };
                        self.follow_row(panel, area, row, sampled.codes, held, shown);
                    }
                    break;
                }
                slot -= area.rows + 2;
            }
        }
    }

    fn follow_row(
        &mut self,
        panel: usize,
        area: &Area,
        row: u16,
        codes: &[Code],
        held: &[Pressed],
        shown: &[u16],
    ) {
        let told = self.in_turn(panel);
        let touched = held.iter().any(|Pressed { rect, .. }| {
            usize::from(rect.panel) == panel && row + 1 >= rect.top && row <= rect.bottom + 1
        });
        let common = told + if touched { self.missed[panel].step } else { 0 };
        for column in 0..area.columns {
            let taxel = usize::from(area.base + row * area.columns + column);
            let Some(code) = codes.get(taxel) else { continue };
            // Half of what is common, if something holds it, and if not that and a quarter, and a count where
            // nothing shows.
            let own = match (self.is_held(panel, row, column, shown[taxel], held), shown[taxel]) {
                (true, 0) => 1.max((common.abs() + 1) / 2),
                (true, _) => 0,
                (false, shown) => (f64::from(told.abs()) * 1.25).floor() as i32 + i32::from(shown == 0),
            };
            let off = i32::from(code.0) - i32::from(self.rest[taxel]);
            let step = off.clamp(common - own, common + own);
            let now = (i32::from(self.rest[taxel]) + step).clamp(0, 65535);
            if !touched && self.gain[taxel] != 0 {
                let missed = &mut self.missed[panel].now;
                *missed = (missed.0 + now - i32::from(self.rest[taxel]) - common, missed.1 + 1);
            }
            self.rest[taxel] = now as u16;
        }
    }

    /// True if a contact holds a taxel that shows this much. While its panel drifts fast, that is a sixteenth
    /// of the peak of a contact that rose faster.
    fn is_held(&self, panel: usize, row: u16, column: u16, shown: u16, held: &[Pressed]) -> bool {
        let fast = self.pace[panel].greatest > 64;
        held.iter().any(|held| {
            held.rect.holds(panel as u8, row, column, 1) && (!fast || !held.slow && shown >= held.peak / 16)
        })
    }

    /// Ends a turn in which the witnesses of a panel told its drift.
    fn miss(&mut self, panel: usize) {
        let common = self.in_turn(panel);
        let DenseMissed { now: (sum, count), left, lost, way, .. } = &mut self.missed[panel];
        let mean = *sum * 256 / (*count).max(1);
        *lost += mean * self.pace[panel].mean.signum() - lost.div_euclid(128);
        *way += 256 * common.abs() - way.div_euclid(128);
        let all = *left + if 5 * lost.abs() <= *way { mean } else { 0 };
        *left = all.rem_euclid(256);
        (self.missed[panel].step, self.missed[panel].now) = (all.div_euclid(256), (0, 0));
    }

    /// Sixteen witnesses, an odd distance apart. If seven eighths of those that nothing holds are beyond what
    /// is known, the same way and by a quarter of their median at least, the panel moves by that; if only
    /// most of them are, by one, where a turn begins.
    fn vote(
        &mut self,
        panel: usize,
        area: &Area,
        codes: &[Code],
        held: &[Pressed],
        shown: &[u16],
        whole: bool,
    ) {
        let taxels = usize::from(area.rows * area.columns);
        let places: Vec<usize> = (0..16).map(|witness| witness * ((taxels / 16) | 1) % taxels).collect();
        let rest = |at: &usize| i32::from(self.rest[usize::from(area.base) + at]);
        let mut known = self.common[panel].1.take().unwrap_or_else(|| places.iter().map(rest).collect());
        let beyond = |(at, known): (&usize, &i32), noise: u32| {
            let taxel = usize::from(area.base) + at;
            let (row, column) = (*at as u16 / area.columns, *at as u16 % area.columns);
            let near = self.is_held(panel, row, column, shown[taxel], held);
            let code = codes.get(taxel).filter(|_| self.gain[taxel] != 0)?;
            let (code, rest) = (i32::from(code.0), rest(at));
            if near && code.abs_diff(rest) > 4 {
                return None;
            }
            Some(if code.abs_diff(rest) > noise { code - known } else { rest - known })
        };
        let reported = |noise: u32| -> (Vec<Option<i32>>, Vec<i32>, i32) {
            let all: Vec<Option<i32>> = places.iter().zip(&known).map(|of| beyond(of, noise)).collect();
            let mut sorted: Vec<i32> = all.iter().flatten().copied().collect();
            sorted.sort_unstable();
            let middle = sorted.get(sorted.len() / 2).copied().unwrap_or(0);
            (all, sorted, middle)
        };
        let quiet = reported(4);
        let (beyond, sorted, middle) = if quiet.2.abs() > 5 { reported(0) } else { quiet };
        let far = |one: &&i32| **one * middle.signum() * 4 >= middle.abs() && one.signum() == middle.signum();
        let on = |way: i32| sorted.iter().filter(|one| one.signum() == way).count() * 2 > sorted.len();
        let [_, before] = self.common[panel].0;
        let eighths = if before.abs() > 2 && before.signum() == middle.signum() { 5 } else { 7 };
        let step = match sorted.len() {
            ..4 => 0,
            count if middle.abs() <= 56 && sorted.iter().filter(far).count() * 8 >= count * eighths => {
                middle.clamp(-14, 14)
            }
            _ if whole => i32::from(on(1)) - i32::from(on(-1)),
            _ => 0,
        };
        for (known, beyond) in known.iter_mut().zip(beyond) {
            let apart = beyond.unwrap_or(middle) - middle;
            let forgotten = match step.abs() {
                3.. => apart,
                _ if whole => i32::from(apart > 8) - i32::from(apart < -8),
                _ => 0,
            };
            *known += step + forgotten;
            *known = (*known).clamp(0, 65535);
        }
        self.common[panel] = ([before, step], Some(known));
        if whole {
            self.miss(panel);
        }
        let in_turn = self.in_turn(panel);
        let DensePace { mean, greatest } = &mut self.pace[panel];
        *mean += (16 * in_turn - *mean).div_euclid(8);
        *greatest = mean.abs().max((*greatest - *greatest / 64 - 1).max(0));
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
