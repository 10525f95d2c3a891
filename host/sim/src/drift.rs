//! A garment that drifts: its codes wander, all together and in patches.
//!
//! | quantity | unit |
//! |---|---|
//! | drift | counts towards pressure |
//! | rate | counts per second of a taxel whose factor is 1; each taxel has one from 0.5 to 1.5 |
//! | patch | share of the patch's rate, 1 inside, falling to 0 over its edge |

use super::signal::{FULL_SCALE, World};
use fastrand::Rng;
use libm::hypot;
use taxel_core::garment::Layout;

/// Time within which a rate rises from 0, because causes of drift take time, s.
const TURNING_S: f64 = 2.0;

/// A drift rate that reverses after a distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Course {
    /// Counts per second.
    pub rate: f64,
    /// Counts between two reversals.
    pub way: f64,
}

impl Course {
    /// Counts at a time (s): 0 at the start, up to `way` and back. At each end the rate rises from 0 within 2
    /// s, or half of the time to the other end.
    pub fn at(&self, t_s: f64) -> f64 {
        let rate = self.rate.abs();
        if rate == 0.0 {
            return 0.0;
        }
        let turning = TURNING_S.min(self.way / rate);
        let leg = self.way / rate + turning;
        let t_s = t_s % (2.0 * leg);
        let t_s = t_s.min(2.0 * leg - t_s);
        let from_end = t_s.min(leg - t_s);
        let way = if from_end < turning {
            rate * from_end * from_end / (2.0 * turning)
        } else {
            rate * (from_end - turning / 2.0)
        };
        let way = if t_s < leg / 2.0 { way } else { self.way - way };
        way.copysign(self.rate)
    }
}

/// A part of a panel with a drift of its own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Patch {
    /// Index of the panel.
    pub panel: usize,
    /// First column and row with the full rate.
    pub at: [f64; 2],
    /// Columns and rows with the full rate.
    pub size: [f64; 2],
    /// Taxels around it over which the rate falls to 0.
    pub edge: f64,
    /// Drift of the patch.
    pub course: Course,
}

impl Patch {
    /// Share of the rate at a column and a row.
    fn share(&self, column: f64, row: f64) -> f64 {
        let beyond = |at: f64, first: f64, size: f64| (first - at).max(at - first - size + 1.0).max(0.0);
        let beyond = hypot(beyond(column, self.at[0], self.size[0]), beyond(row, self.at[1], self.size[1]));
        if beyond < self.edge { 1.0 - beyond / self.edge } else { f64::from(beyond == 0.0) }
    }
}

/// A scene on a drifting garment.
#[derive(Debug, Clone)]
pub struct Drifting {
    world: World,
    common: Course,
    factors: Vec<f64>,
    patches: Vec<(Course, Vec<f64>)>,
}

impl Drifting {
    /// Drifts with factors from this seed.
    pub fn new(world: World, layout: &Layout, common: Course, patches: &[Patch], seed: u64) -> Drifting {
        let mut rng = Rng::with_seed(seed);
        let share = |patch: &Patch, taxel| {
            let place = layout.place(taxel).filter(|place| usize::from(place.panel) == patch.panel);
            place.map_or(0.0, |place| patch.share(place.column.into(), place.row.into()))
        };
        let patch =
            |patch: &Patch| (patch.course, (0..layout.taxels()).map(|taxel| share(patch, taxel)).collect());
        Drifting {
            common,
            factors: (0..world.taxels()).map(|_| 0.5 + rng.f64()).collect(),
            patches: patches.iter().map(patch).collect(),
            world,
        }
    }

    /// The scene without drift.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// Drift of a taxel at a time (s), counts.
    pub fn counts(&self, taxel: usize, t_s: f64) -> f64 {
        let own = |of: &[f64]| of.get(taxel).copied().unwrap_or(0.0);
        let patches = self.patches.iter().map(|(course, shares)| own(shares) * course.at(t_s));
        own(&self.factors) * self.common.at(t_s) + patches.sum::<f64>()
    }

    /// Codes of a frame whose scan starts at this time, us.
    pub fn frame(&self, start_us: u64, codes: &mut [u16]) {
        let t_s = start_us as f64 / 1e6;
        let common = self.common.at(t_s);
        let patches: Vec<f64> = self.patches.iter().map(|(course, _)| course.at(t_s)).collect();
        for (taxel, (code, factor)) in codes.iter_mut().zip(&self.factors).enumerate() {
            let mut drift = factor * common;
            for ((_, shares), moved) in self.patches.iter().zip(&patches) {
                drift += shares.get(taxel).map_or(0.0, |share| share * moved);
            }
            let steady = f64::from(self.world.code(taxel, start_us * 1000));
            *code = (steady + drift).round().clamp(0.0, f64::from(FULL_SCALE)) as u16;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Script;
    use super::*;
    use taxel_core::garment::Garment;

    #[test]
    fn a_course_turns_and_a_patch_has_an_edge() {
        let course = Course { rate: -4.0, way: 10.0 };
        let at = [0.0, 1.0, 2.25, 3.5, 4.5, 9.0].map(|t| course.at(t));
        assert_eq!(at, [-0.0, -1.0, -5.0, -9.0, -10.0, -0.0]);
        let long = Course { rate: 4.0, way: 400.0 };
        assert_eq!([2.0, 52.0, 100.0, 102.0].map(|t| long.at(t)), [4.0, 204.0, 396.0, 400.0]);
        let patch = Patch { panel: 0, at: [6.0, 6.0], size: [8.0, 8.0], edge: 4.0, course };
        let row = [1.0, 2.0, 3.0, 4.0, 6.0, 13.0, 14.0, 16.0, 17.0].map(|column| patch.share(column, 9.0));
        assert_eq!(row, [0.0, 0.0, 0.25, 0.5, 1.0, 1.0, 0.75, 0.25, 0.0]);
    }

    #[test]
    fn each_taxel_drifts_by_its_factor() {
        let garment = Garment::recorded(20, 27);
        let layout = Layout::build(&garment, 2048, FULL_SCALE).unwrap();
        let script =
            "duration_s = 1\n[idle]\nbase_code = 1000\nspread_counts = 0\nnoise_counts = 0".parse::<Script>();
        let world = World::build(&script.unwrap(), &garment).unwrap();
        let drifting = Drifting::new(world, &layout, Course { rate: 10.0, way: 500.0 }, &[], 3);
        let mut codes = vec![0; layout.taxels()];
        drifting.frame(21_000_000, &mut codes);
        assert!(codes.iter().all(|code| (1100..=1300).contains(code)));
        assert!(codes.iter().any(|code| *code < 1110) && codes.iter().any(|code| *code > 1290));
        assert!((0..540).all(|taxel| (drifting.counts(taxel, 21.0) + 1000.0).round() as u16 == codes[taxel]));
    }
}
