//! Faults: reasons for which nothing may be commanded.

use super::config::FaultConfig;
use super::input::{MotionBoard, MotionInput};

/// Time by which a stamp may be ahead of the cycle, us: clocks of two machines that are kept together.
const AHEAD_US: u64 = 10_000;

/// A reason for which nothing is commanded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MotionFault {
    /// The newest posture is too old, or there is none.
    StalePosture,
    /// A position, a place, a normal or a force is not a number, or there are too few positions.
    NotANumber,
    /// The time of a cycle, of a posture or of a scan has gone back, is ahead, or stands still while joints move.
    TimeJumps,
    /// Too much time has passed since the last cycle.
    LateCycle,
    /// A board is not there.
    LostBoard,
    /// A board has begun anew, perhaps with another garment.
    OtherBoard,
    /// The newest scan of a board is too old.
    LateFrame,
    /// A board knows no newtons.
    Uncalibrated,
}

impl MotionFault {
    /// All of them; [`MotionState::count`](super::MotionState::count) counts each.
    pub const ALL: [MotionFault; 8] = [
        MotionFault::StalePosture,
        MotionFault::NotANumber,
        MotionFault::TimeJumps,
        MotionFault::LateCycle,
        MotionFault::LostBoard,
        MotionFault::OtherBoard,
        MotionFault::LateFrame,
        MotionFault::Uncalibrated,
    ];

    /// Its name, as JSON has it.
    pub fn as_str(self) -> &'static str {
        match self {
            MotionFault::StalePosture => "stale_posture",
            MotionFault::NotANumber => "not_a_number",
            MotionFault::TimeJumps => "time_jumps",
            MotionFault::LateCycle => "late_cycle",
            MotionFault::LostBoard => "lost_board",
            MotionFault::OtherBoard => "other_board",
            MotionFault::LateFrame => "late_frame",
            MotionFault::Uncalibrated => "uncalibrated",
        }
    }
}

/// Observations of the last cycle.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct SeenCycle {
    /// Time of the cycle, us.
    pub now_us: u64,
    posture_us: u64,
    boards: Vec<MotionBoard>,
}

impl SeenCycle {
    /// Observations of a cycle.
    pub fn of(input: &MotionInput<'_>) -> SeenCycle {
        let posture_us = input.posture.map_or(0, |posture| posture.at_us);
        SeenCycle { now_us: input.now_us, posture_us, boards: input.boards.to_vec() }
    }
}

/// The fault of a cycle, if it has one; `before` is what the last cycle has seen, and whether it has moved a joint; none
/// at the first.
pub(super) fn fault(
    config: &FaultConfig,
    joints: usize,
    before: Option<(&SeenCycle, bool)>,
    input: &MotionInput<'_>,
) -> Option<MotionFault> {
    let now_us = input.now_us;
    let is_ahead = |us: u64| us > now_us.saturating_add(AHEAD_US);
    let is_older = |us: u64, than_ms: f64| now_us.saturating_sub(us) as f64 > 1000.0 * than_ms;
    let Some(posture) = input.posture else { return Some(MotionFault::StalePosture) };
    let is_posture = posture.positions.len() == joints && posture.positions.iter().all(|it| it.is_finite());
    let is_touch = |touch: &super::MotionTouch| {
        touch.newtons.is_finite() && touch.at.is_finite() && (touch.normal.length() - 1.0).abs() < 0.01
    };
    if !(is_posture && input.touches.iter().all(is_touch)) {
        return Some(MotionFault::NotANumber);
    }
    let scans = || input.boards.iter().filter_map(|board| board.scanned_us);
    if is_ahead(posture.at_us) || scans().any(is_ahead) {
        return Some(MotionFault::TimeJumps);
    }
    if let Some((before, moves)) = before {
        let boards = || input.boards.iter().zip(&before.boards);
        let goes_back = |(board, before): (&MotionBoard, &MotionBoard)| {
            board.begun == before.begun && board.scanned_us.is_some() && board.scanned_us < before.scanned_us
        };
        let stands = now_us == before.now_us && moves;
        if now_us < before.now_us || stands || posture.at_us < before.posture_us || boards().any(goes_back) {
            return Some(MotionFault::TimeJumps);
        }
        if is_older(before.now_us, config.cycle_ms) {
            return Some(MotionFault::LateCycle);
        }
        let is_other = |(board, before): (&MotionBoard, &MotionBoard)| board.begun != before.begun;
        if input.boards.len() != before.boards.len() || boards().any(is_other) {
            return Some(MotionFault::OtherBoard);
        }
    }
    if is_older(posture.at_us, config.posture_ms) {
        return Some(MotionFault::StalePosture);
    }
    if input.boards.iter().any(|board| board.scanned_us.is_none()) {
        return Some(MotionFault::LostBoard);
    }
    if input.boards.iter().any(|board| !board.is_calibrated) {
        return Some(MotionFault::Uncalibrated);
    }
    let is_late = |board: &MotionBoard| {
        let longest_ms = config.frame_ms.max(3.0 * f64::from(board.period_us) / 1000.0);
        board.scanned_us.is_some_and(|us| is_older(us, longest_ms))
    };
    input.boards.iter().any(is_late).then_some(MotionFault::LateFrame)
}
