//! Which taxels fold with which joints, and the table.

use super::bend::{Axis, KnotWeight, Knots};
use super::felt::{means, spreads, unexplained};
use super::near::near;
use super::sweep::FoldSweep;
use crate::error::{LearnError, Result};
use taxel_core::fold::{
    CELLS, FOLDED, FOLDS, FoldCell, FoldTable, FoldTableParts, KNOTS, MOST_UNIT, fold_table_length,
    write_fold_table,
};
use taxel_core::garment::Layout;

/// Turns back before a sleeve follows that are tried, degrees.
const PLAYS: [f32; 7] = [0.0, 2.0, 4.0, 6.0, 8.0, 11.0, 15.0];
/// Share of its frames in which a taxel must feel something to fold.
const PRESSED: f64 = 5e-4;
/// Share of what a taxel feels that differs from day to day, besides what the shift explains.
const DAY_SHARE: f32 = 0.5;
/// Share by which a taxel may feel more than on the one day that was learned from. Several days show how they
/// differ: it is divided by the square of their number.
const UNKNOWN_SHARE: f32 = 0.5;
/// Share by which a taxel may differ more within a day than on that one, likewise: where a stronger bulge comes
/// at once, between other knots, the expectation is further off.
const UNKNOWN_SPREAD: f32 = 1.5;
/// Share of the most by which the garment shifts, within which a neighbour's spread counts, too. It is not all
/// of the shift: the spread is doubt for the whole day, and would hide touches.
const SPREAD_SHARE: f32 = 0.5;
/// Most units of what a taxel feels, or differs by: a board's correction reaches as far, up or down.
const MOST_UNITS: f32 = 127.0;
/// Most knots of a joint.
const MOST_KNOTS: usize = 64;

/// Settings of learning.
#[derive(Debug, Clone)]
pub struct FoldSettings {
    /// The folds: names of one or two joints each. Empty: each joint of the sweeps is one.
    pub folds: Vec<Vec<String>>,
    /// Angle between knots, degrees; wider if the board has not enough cells.
    pub step_deg: f32,
    /// Most by which the garment shifts from day to day, mm.
    pub shift_mm: f32,
    /// Most by which the angle differs from day to day at which a fold appears, degrees.
    pub shift_deg: f32,
}

impl Default for FoldSettings {
    fn default() -> FoldSettings {
        FoldSettings { folds: Vec::new(), step_deg: 8.0, shift_mm: 30.0, shift_deg: 16.0 }
    }
}

/// A fold that was learned.
#[derive(Debug, Clone, PartialEq)]
pub struct LearnedFold {
    /// Joints of the fold.
    pub joints: Vec<String>,
    /// Taxels that were pressed, and those that a shift may bring there.
    pub taxels: [usize; 2],
    /// Knots.
    pub knots: usize,
    /// Angles between knots, degrees, of each joint.
    pub step_deg: Vec<f32>,
    /// Turn back before the sleeve follows, degrees, of each joint.
    pub play_deg: Vec<f32>,
    /// Strongest expectation, counts.
    pub strongest: f32,
    /// Share of the variance of what its taxels felt that is explained.
    pub explained: f64,
    /// Bytes of the board's flash and RAM that it takes.
    pub bytes: [usize; 2],
}

/// Result of learning.
#[derive(Debug, Clone, PartialEq)]
pub struct LearnedFolds {
    /// The table, for the board.
    pub table: Vec<u8>,
    /// Folds of the table.
    pub folds: Vec<LearnedFold>,
}

/// Pressure on a taxel at the knots of its fold.
struct TaxelCourse {
    taxel: usize,
    mean: Vec<f32>,
    /// The most that it felt on any day.
    most: Vec<f32>,
    spread: Vec<f32>,
    days: Vec<f32>,
}

/// A fold being learned.
struct Fold {
    knots: Knots,
    /// Weights of each sweep's frames; none for a sweep without its joints.
    weights: Vec<Option<Vec<[KnotWeight; 4]>>>,
    pressed: Vec<usize>,
    residual: f64,
}

/// Learns from sweeps, each of one day. Errors if they do not fit each other, nothing folds, or more than a
/// board holds.
pub fn learn(layout: &Layout, sweeps: &[FoldSweep], settings: &FoldSettings) -> Result<LearnedFolds> {
    let taxels = layout.taxels();
    require!(!sweeps.is_empty(), LearnError::Data, "there are no sweeps to learn from");
    for (number, sweep) in (1..).zip(sweeps) {
        let reported = sweep.taxels();
        require!(
            reported == taxels,
            LearnError::Data,
            "sweep {number}: {reported} taxels, the garment has {taxels}"
        );
        let frames = sweep.frames();
        require!(frames >= 50, LearnError::Data, "sweep {number}: {frames} frames are too few, 50 at least");
    }
    let groups = groups(sweeps, settings)?;
    let pressed: Vec<usize> = (0..taxels).filter(|taxel| is_pressed(sweeps, *taxel)).collect();
    require!(
        !pressed.is_empty(),
        LearnError::Data,
        "no taxel is pressed while the joints move: nothing folds"
    );
    let mut folds: Vec<Fold> =
        groups.iter().map(|joints| fold(sweeps, joints, settings.step_deg, 6.0)).collect::<Result<_>>()?;
    for taxel in pressed {
        let left = |fold: &Fold| fold.unexplained(sweeps, taxel);
        let best = (0..folds.len()).min_by(|a, b| left(&folds[*a]).total_cmp(&left(&folds[*b])));
        folds[best.unwrap_or(0)].pressed.push(taxel);
    }
    folds.retain(|fold| !fold.pressed.is_empty());
    for fold in &mut folds {
        fold.find_play(sweeps, settings.step_deg)?;
    }
    // Neighbours go with the first fold that may reach them.
    let mut taken: Vec<usize> = folds.iter().flat_map(|fold| fold.pressed.iter().copied()).collect();
    let mut all = Vec::new();
    for fold in &folds {
        let mut its = fold.pressed.clone();
        for taxel in fold.pressed.iter().flat_map(|taxel| near(layout, *taxel, settings.shift_mm)) {
            if !taken.contains(&taxel) {
                taken.push(taxel);
                its.push(taxel);
            }
        }
        its.sort_unstable();
        all.push(its);
    }
    fit_to_board(&mut folds, &all, sweeps, settings.step_deg)?;
    let courses: Vec<Vec<TaxelCourse>> =
        folds.iter().zip(&all).map(|(fold, its)| courses(layout, sweeps, fold, its, settings)).collect();
    write(layout, sweeps, &folds, &courses)
}

/// The joints of each fold.
fn groups(sweeps: &[FoldSweep], settings: &FoldSettings) -> Result<Vec<Vec<String>>> {
    let known = |joint: &String| sweeps.iter().any(|sweep| sweep.joints().contains(joint));
    let mut groups = settings.folds.clone();
    if groups.is_empty() {
        for joint in sweeps.iter().flat_map(FoldSweep::joints) {
            if !groups.iter().any(|group| group[0] == *joint) {
                groups.push(vec![joint.clone()]);
            }
        }
    }
    for group in &groups {
        let count = group.len();
        require!((1..=2).contains(&count), LearnError::Data, "a fold has one joint or two, not {count}");
        if let Some(joint) = group.iter().find(|joint| !known(joint)) {
            fail!(LearnError::Data, "joint {joint}: no sweep reports its angle");
        }
        if let Some(joint) = group.iter().find(|joint| joint.is_empty() || joint.len() > 16) {
            fail!(LearnError::Data, "joint {joint:?}: a board's names have 1 to 16 bytes");
        }
    }
    let count = groups.len();
    require!((1..=FOLDS).contains(&count), LearnError::TooLarge, "{count} folds: a board holds 1 to {FOLDS}");
    Ok(groups)
}

fn is_pressed(sweeps: &[FoldSweep], taxel: usize) -> bool {
    let all: usize = sweeps.iter().map(FoldSweep::frames).sum();
    let felt: usize = sweeps.iter().map(|sweep| sweep.felt(taxel).filter(|felt| *felt > 0).count()).sum();
    felt as f64 > PRESSED * all as f64
}

/// A fold of these joints, whose knots are `step` degrees apart.
fn fold(sweeps: &[FoldSweep], joints: &[String], step: f32, play: f32) -> Result<Fold> {
    let axes = joints.iter().map(|joint| Axis::over(sweeps, joint, step, play));
    let knots = Knots { joints: joints.to_vec(), axes: axes.collect() };
    let weights = sweeps.iter().map(|sweep| knots.weights(sweep)).collect();
    Ok(Fold { knots, weights, pressed: Vec::new(), residual: 0.0 })
}

impl Fold {
    /// Each sweep that has its joints, with the weights of its frames.
    fn swept<'a>(
        &'a self,
        sweeps: &'a [FoldSweep],
    ) -> impl Iterator<Item = (&'a FoldSweep, &'a [[KnotWeight; 4]])> {
        sweeps.iter().zip(&self.weights).filter_map(|(sweep, weights)| Some((sweep, weights.as_deref()?)))
    }

    /// Sum of squares of what it leaves unexplained of a taxel, with each day's own means; all of it on days
    /// on which the joints did not take part.
    fn unexplained(&self, sweeps: &[FoldSweep], taxel: usize) -> f64 {
        let squares = |sweep: &FoldSweep| sweep.felt(taxel).map(|felt| f64::from(felt).powi(2)).sum::<f64>();
        let of = |(sweep, weights): (&FoldSweep, &Option<Vec<[KnotWeight; 4]>>)| match weights {
            Some(weights) => {
                let means = means(weights, sweep.felt(taxel), self.knots.count());
                unexplained(weights, sweep.felt(taxel), &means)
            }
            None => squares(sweep),
        };
        sweeps.iter().zip(&self.weights).map(of).sum()
    }

    /// Chooses the play that explains the most, for each joint in turn.
    fn find_play(&mut self, sweeps: &[FoldSweep], step: f32) -> Result<()> {
        for axis in 0..self.knots.axes.len() {
            let mut best = (f64::MAX, 0.0);
            for play in PLAYS {
                let mut tried = fold(sweeps, &self.knots.joints, step, 0.0)?;
                tried.knots.axes.clone_from(&self.knots.axes);
                tried.knots.axes[axis].play = play;
                tried.weights = sweeps.iter().map(|sweep| tried.knots.weights(sweep)).collect();
                let left: f64 = self.pressed.iter().map(|taxel| tried.unexplained(sweeps, *taxel)).sum();
                if left < best.0 {
                    best = (left, play);
                }
            }
            self.knots.axes[axis] = Axis::over(sweeps, &self.knots.joints[axis], step, best.1);
            self.residual = best.0;
        }
        self.weights = sweeps.iter().map(|sweep| self.knots.weights(sweep)).collect();
        Ok(())
    }
}

/// Widens the steps until the board has room.
fn fit_to_board(folds: &mut [Fold], all: &[Vec<usize>], sweeps: &[FoldSweep], step: f32) -> Result<()> {
    let filled = |its: &Vec<usize>| its.len().next_multiple_of(4);
    let taxels: usize = all.iter().map(filled).sum();
    require!(
        taxels <= FOLDED,
        LearnError::TooLarge,
        "{taxels} taxels fold or may, a board holds {FOLDED}: state a smaller shift"
    );
    let mut step = step;
    loop {
        let cells: usize = folds.iter().zip(all).map(|(fold, its)| fold.knots.count() * filled(its)).sum();
        let knots: usize = folds.iter().map(|fold| fold.knots.count()).sum();
        let widest = folds.iter().flat_map(|fold| &fold.knots.axes).map(|axis| axis.knots).max().unwrap_or(0);
        if cells <= CELLS && knots <= KNOTS && widest <= MOST_KNOTS {
            return Ok(());
        }
        step *= 1.1;
        for fold in &mut *folds {
            let its = fold.knots.joints.iter().zip(&fold.knots.axes);
            let axes = its.map(|(joint, axis)| Axis::over(sweeps, joint, step, axis.play));
            fold.knots.axes = axes.collect();
            fold.weights = sweeps.iter().map(|sweep| fold.knots.weights(sweep)).collect();
        }
    }
}

/// Returns the pressure on each taxel of a fold.
fn courses(
    layout: &Layout,
    sweeps: &[FoldSweep],
    fold: &Fold,
    its: &[usize],
    settings: &FoldSettings,
) -> Vec<TaxelCourse> {
    let knots = fold.knots.count();
    let mut courses: Vec<TaxelCourse> = its
        .iter()
        .map(|taxel| {
            let daily: Vec<Vec<f32>> = fold
                .swept(sweeps)
                .map(|(sweep, weights)| means(weights, sweep.felt(*taxel), knots))
                .collect();
            let mean: Vec<f32> = (0..knots).map(|knot| middle(&daily, knot)).collect();
            let mut spread = vec![0.0f32; knots];
            for ((sweep, weights), means) in fold.swept(sweeps).zip(&daily) {
                for (most, off) in spread.iter_mut().zip(spreads(weights, sweep.felt(*taxel), means)) {
                    *most = most.max(off);
                }
            }
            let days = (0..knots).map(|knot| {
                let off = daily.iter().map(|means| (means[knot] - mean[knot]).abs());
                1.5 * off.filter(|off| off.is_finite()).fold(0.0f32, f32::max)
            });
            let most = (0..knots).map(|knot| {
                daily.iter().map(|means| means[knot]).filter(|mean| mean.is_finite()).fold(0.0f32, f32::max)
            });
            TaxelCourse { taxel: *taxel, most: most.collect(), days: days.collect(), mean, spread }
        })
        .collect();
    // A shift brings what the neighbours feel, at an angle or beside it, and how it differs within a day.
    let beside: Vec<Vec<usize>> =
        (0..knots).map(|knot| fold.knots.beside(knot, settings.shift_deg)).collect();
    let shift_mm = settings.shift_mm;
    let [stronger, wider] =
        [UNKNOWN_SHARE, UNKNOWN_SPREAD].map(|share| share / (sweeps.len() as f32).powi(2));
    let most = brought(layout, &courses, &beside, shift_mm, |course| &course.most);
    let spread = brought(layout, &courses, &beside, SPREAD_SHARE * shift_mm, |course| &course.spread);
    for (course, (most, spread)) in courses.iter_mut().zip(most.into_iter().zip(spread)) {
        for ((days, mean), most) in course.days.iter_mut().zip(&course.mean).zip(most) {
            *days = days.max((1.0 + DAY_SHARE + stronger) * most - mean);
        }
        course.spread = spread.into_iter().map(|spread| (1.0 + wider) * spread).collect();
    }
    courses
}

/// The greatest value of each course at each knot, among its neighbours within `shift_mm` and the knots
/// beside.
fn brought(
    layout: &Layout,
    courses: &[TaxelCourse],
    beside: &[Vec<usize>],
    shift_mm: f32,
    values: impl Fn(&TaxelCourse) -> &[f32],
) -> Vec<Vec<f32>> {
    let greatest = |all: &mut dyn Iterator<Item = f32>| all.fold(0.0f32, f32::max);
    let of = |course: &TaxelCourse| {
        let near = near(layout, course.taxel, shift_mm);
        let near: Vec<&TaxelCourse> = courses.iter().filter(|other| near.contains(&other.taxel)).collect();
        let there: Vec<f32> = (0..beside.len())
            .map(|knot| greatest(&mut near.iter().map(|other| values(other)[knot])))
            .collect();
        beside.iter().map(|beside| greatest(&mut beside.iter().map(|knot| there[*knot]))).collect()
    };
    courses.iter().map(of).collect()
}

/// Mean over the days that know a knot; where none does, that of the nearest knot before or after.
fn middle(daily: &[Vec<f32>], knot: usize) -> f32 {
    let of = |knot: usize| {
        let there: Vec<f32> = daily.iter().map(|means| means[knot]).filter(|mean| mean.is_finite()).collect();
        (!there.is_empty()).then(|| there.iter().sum::<f32>() / there.len() as f32)
    };
    let knots = daily.first().map_or(0, Vec::len);
    let nearest = (0..knots).find_map(|away| {
        knot.checked_sub(away)
            .and_then(of)
            .or_else(|| (knot + away < knots).then(|| of(knot + away)).flatten())
    });
    nearest.unwrap_or(0.0)
}

/// The table of the courses.
fn write(
    layout: &Layout,
    sweeps: &[FoldSweep],
    folds: &[Fold],
    courses: &[Vec<TaxelCourse>],
) -> Result<LearnedFolds> {
    let all = || courses.iter().flatten();
    let largest = all().flat_map(|course| course.mean.iter().chain(&course.spread).chain(&course.days));
    let unit = (largest.fold(0.0f32, |most, next| most.max(*next)) / MOST_UNITS).ceil().max(1.0);
    require!(
        unit as u32 <= u32::from(MOST_UNIT),
        LearnError::TooLarge,
        "a fold presses with up to {:.0} counts, a board holds {}: record with codes of 12 bits",
        unit * MOST_UNITS,
        MOST_UNITS * f32::from(MOST_UNIT)
    );
    let mut joints: Vec<&str> = Vec::new();
    for joint in folds.iter().flat_map(|fold| &fold.knots.joints) {
        if !joints.contains(&joint.as_str()) {
            joints.push(joint);
        }
    }
    let number = |joint: &str| joints.iter().position(|other| *other == joint).unwrap_or(0) as u8;
    let records: Vec<_> =
        folds.iter().zip(courses).map(|(fold, its)| fold.knots.record(number, its.len())).collect();
    let taxels: Vec<u16> = all().map(|course| course.taxel as u16).collect();
    let cell = |(mean, (spread, days)): (&f32, (&f32, &f32))| FoldCell {
        mean: (mean / unit).round() as u8,
        // Rounded up: a doubt may be too large.
        spread: (spread / unit).ceil() as u8,
        days: (days / unit).ceil() as u8,
    };
    let cells: Vec<FoldCell> =
        all().flat_map(|it| it.mean.iter().zip(it.spread.iter().zip(&it.days)).map(cell)).collect();
    let mut table = vec![0; fold_table_length(&records)];
    let parts = FoldTableParts {
        joints: &joints,
        folds: &records,
        taxels: &taxels,
        cells: &cells,
        unit: unit as u16,
    };
    write_fold_table(&parts, layout, &mut table).map_err(|error| LearnError::Data(error.to_string()))?;
    FoldTable::check(&table, layout).map_err(|error| LearnError::Data(error.to_string()))?;
    let folds = folds.iter().zip(courses).map(|(fold, its)| reported(sweeps, fold, its)).collect();
    Ok(LearnedFolds { table, folds })
}

/// Returns the report on a fold.
fn reported(sweeps: &[FoldSweep], fold: &Fold, its: &[TaxelCourse]) -> LearnedFold {
    let knots = fold.knots.count();
    let felt: f64 = fold.pressed.iter().map(|taxel| variation(sweeps, *taxel)).sum();
    LearnedFold {
        joints: fold.knots.joints.clone(),
        taxels: [fold.pressed.len(), its.len() - fold.pressed.len()],
        knots,
        step_deg: fold.knots.axes.iter().map(|axis| axis.step).collect(),
        play_deg: fold.knots.axes.iter().map(|axis| axis.play).collect(),
        strongest: its.iter().flat_map(|course| &course.mean).fold(0.0f32, |most, next| most.max(*next)),
        explained: 1.0 - fold.residual / felt.max(1.0),
        bytes: [20 + its.len() * (2 + 3 * knots), its.len() * (2 + knots)],
    }
}

/// Sum of the squares of a taxel's deviations from its mean.
fn variation(sweeps: &[FoldSweep], taxel: usize) -> f64 {
    let felt = || sweeps.iter().flat_map(|sweep| sweep.felt(taxel)).map(f64::from);
    let count = felt().count().max(1) as f64;
    let (sum, squares) = felt().fold((0.0, 0.0), |(sum, squares), felt| (sum + felt, squares + felt * felt));
    squares - sum * sum / count
}
