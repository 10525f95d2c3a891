//! Seams between panels of different boards.

use super::board::RobotBoard;
use super::config::{BoardEdge, BoardSeam};
use super::place::RobotText;
use crate::error::SettingError;
use crate::tell::words;
use taxel_core::garment::{Layout, Place, Side};

/// A seam, checked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RobotSeam {
    /// First edge.
    pub a: RobotEdge,
    /// Second edge.
    pub b: RobotEdge,
    /// Taxels along the seam.
    pub length: u16,
    /// True if the two run in opposite directions.
    pub reversed: bool,
}

/// An edge of a seam.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RobotEdge {
    /// Number of the board.
    pub board: usize,
    /// Number of the panel of its garment.
    pub panel: u8,
    /// Side of the panel.
    pub side: Side,
    /// First taxel along that side.
    pub start: u16,
}

impl RobotEdge {
    /// The taxels of a seam of this length, in the panel's own order.
    pub(super) fn places(self, layout: &Layout, length: u16) -> impl Iterator<Item = Place> {
        let RobotEdge { panel, side, start, .. } = self;
        let area = layout.areas().get(usize::from(panel)).map(|area| [area.rows - 1, area.columns - 1]);
        area.into_iter().flat_map(move |[bottom, right]| {
            (start..start + length).map(move |at| {
                let (row, column) = match side {
                    Side::Left => (at, 0),
                    Side::Right => (at, right),
                    Side::Top => (0, at),
                    Side::Bottom => (bottom, at),
                };
                Place { panel, row, column }
            })
        })
    }
}

/// Checks the seams of a file against the garments of its boards.
pub fn check(
    seams: &[BoardSeam],
    boards: &[RobotBoard],
    place: RobotText<'_>,
) -> Result<Vec<RobotSeam>, SettingError> {
    let mut checked: Vec<RobotSeam> = Vec::new();
    for (index, seam) in seams.iter().enumerate() {
        let key = |rest: &str| format!("seams[{index}]{rest}");
        if seam.length == 0 {
            return Err(place.error(&key(".length"), "a seam has at least one taxel"));
        }
        let edge = |which: &str, edge: &BoardEdge| {
            checked_edge(edge, seam.length, boards)
                .map_err(|(field, why)| place.error(&key(&format!(".{which}.{field}")), why))
        };
        let (a, b) = (edge("a", &seam.a)?, edge("b", &seam.b)?);
        if a.board == b.board {
            let why =
                format!("board {}: a seam within a garment belongs in the garment's file", seam.b.board);
            return Err(place.error(&key(".b.board"), why));
        }
        for (which, of) in [("a", a), ("b", b)] {
            let meets = |other: &RobotSeam| {
                let same =
                    |edge: RobotEdge| (edge.board, edge.panel, edge.side) == (of.board, of.panel, of.side);
                let overlaps = |edge: RobotEdge| {
                    edge.start < of.start + seam.length && of.start < edge.start + other.length
                };
                [other.a, other.b].into_iter().any(|edge| same(edge) && overlaps(edge))
            };
            if let Some(other) = checked.iter().position(meets) {
                let name = &boards[of.board].name;
                let why = format!("board {name}: seams[{other}] has taxels of this edge, too");
                return Err(place.error(&key(&format!(".{which}.start")), why));
            }
        }
        checked.push(RobotSeam { a, b, length: seam.length, reversed: seam.reversed });
    }
    Ok(checked)
}

/// Finds an edge, or the field that is wrong and why.
fn checked_edge(
    edge: &BoardEdge,
    length: u16,
    boards: &[RobotBoard],
) -> Result<RobotEdge, (&'static str, String)> {
    let Some(board) = boards.iter().position(|board| board.name == edge.board) else {
        let names = boards.iter().map(|board| board.name.as_str());
        return Err(("board", words::unknown("board", &edge.board, names)));
    };
    let Some(worn) = &boards[board].garment else {
        return Err(("board", format!("board {}: its `garment` must be known for a seam", edge.board)));
    };
    let areas = worn.layout.areas();
    let Some(panel) = areas.iter().position(|area| area.name == edge.panel.as_str()) else {
        let names = areas.iter().map(|area| area.name.as_str());
        let unknown = words::unknown("panel", &edge.panel, names);
        return Err(("panel", format!("board {}: {unknown}", edge.board)));
    };
    let (across, side) = match edge.side {
        Side::Left | Side::Right => (areas[panel].rows, "rows"),
        Side::Top | Side::Bottom => (areas[panel].columns, "columns"),
    };
    if u32::from(edge.start) + u32::from(length) > u32::from(across) {
        let end = u32::from(edge.start) + u32::from(length);
        return Err((
            "start",
            format!("board {}: the seam ends at taxel {end}, and the panel has {across} {side}", edge.board),
        ));
    }
    Ok(RobotEdge { board, panel: panel as u8, side: edge.side, start: edge.start })
}
