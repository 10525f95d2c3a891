//! Reactions: what the garment does without a host.
//!
//! | | |
//! |---|---|
//! | input | region states, meaning of the touch, state of the board itself |
//! | output | changes of named reactions, in the frame that shows their cause |
//! | latency | none |
//! | RAM | [`ReactState`]: 624 bytes |
//!
//! | file | what |
//! |---|---|
//! | `config.rs` | table of reactions in a scene |
//! | `levels.rs` | initial levels of the outputs |

mod config;
mod levels;

pub use config::{Cause, REACTIONS, ReactionConfig};
pub use levels::Levels;

use crate::format::{Invalid, InvalidRow, Micros, Name, Q15};
use crate::garment::{Layout, Line};
use crate::intent::{Leading, Map, Meaning};
use crate::reflex::{Agree, ReflexRow, Reflexes};
use crate::symbol::RegionState;
use heapless::Vec;
use serde::{Deserialize, Serialize};

/// A reaction that began or ended.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Reaction {
    /// Row of the scene's table.
    pub index: u8,
    /// Name of the reaction.
    pub name: Name,
    /// True if it began, false if it ended.
    pub active: bool,
    /// Value at that moment, in the unit of the cause.
    pub value: i32,
}

/// A cause, resolved against the layout and the map.
#[derive(Debug, Clone, PartialEq, Eq)]
enum ResolvedCause {
    Region(Cause, Option<u8>),
    Concept(usize),
    Leading(Leading),
    /// Judged by the board, by [`Reactions::judge`].
    Board(Cause, Option<u8>),
}

/// The checked stage.
#[derive(Debug, Default, Clone, PartialEq, Eq)]
pub struct Reactions {
    rows: Vec<(ReactionConfig, ResolvedCause), REACTIONS>,
    reflexes: Reflexes,
}

/// State of the stage.
#[derive(Debug, Default, Clone)]
pub struct ReactState {
    /// Time at which the value of each active row last reached the level.
    active: [Option<Micros>; REACTIONS],
    activations: Vec<Q15, { crate::intent::CONCEPTS }>,
    leading: Leading,
    changes: Vec<Reaction, REACTIONS>,
}

impl ReactState {
    /// Reactions that began or ended in the last frame.
    pub fn changes(&self) -> &[Reaction] {
        &self.changes
    }

    /// Time at which the value of each active row last reached its level.
    pub(crate) fn since(&self) -> &[Option<Micros>; REACTIONS] {
        &self.active
    }

    /// Marks a row as active, for a reaction that began before it was in this table.
    pub(crate) fn go_on(&mut self, row: usize, since: Micros) {
        if let Some(active) = self.active.get_mut(row) {
            *active = Some(since);
        }
    }

    /// Active rows, one bit each.
    pub fn active(&self) -> u8 {
        (0..).zip(&self.active).fold(0, |mask, (index, since)| mask | u8::from(since.is_some()) << index)
    }
}

impl Reactions {
    /// Checks the table against the regions of a garment and the concepts of a map. Error if a row is
    /// invalid.
    pub fn build(
        rows: &[ReactionConfig],
        layout: &Layout,
        map: Option<&Map>,
    ) -> Result<Reactions, InvalidRow> {
        let mut reactions = Reactions { rows: Vec::new(), reflexes: Reflexes::of(layout) };
        for (index, row) in rows.iter().enumerate() {
            let at = |invalid| InvalidRow { list: "react", index, invalid };
            if rows.iter().take(index).any(|other| other.name == row.name) {
                return Err(at(Invalid { parameter: "name", must: "must not be given twice" }));
            }
            let watch = watch(row, layout, map).map_err(at)?;
            if let (Cause::Reflex(agree), ResolvedCause::Region(_, region)) = (&row.cause, &watch) {
                reactions.add_reflex(index as u8, row, *agree, *region, layout).map_err(at)?;
            }
            let full = Invalid { parameter: "name", must: "must be one of 8 rows at most" };
            reactions.rows.push((row.clone(), watch)).map_err(|_| at(full))?;
        }
        Ok(reactions)
    }

    fn add_reflex(
        &mut self,
        index: u8,
        row: &ReactionConfig,
        agree: Agree,
        region: Option<u8>,
        layout: &Layout,
    ) -> Result<(), Invalid> {
        let Some(level) = u16::try_from(row.level).ok().filter(|level| *level > 0) else {
            return Err(Invalid { parameter: "level", must: "must be 1 to 65535 counts for a reflex" });
        };
        let reflex = ReflexRow { index, agree, level, output: row.output, region };
        if self.reflexes.add(reflex, layout) {
            return Ok(());
        }
        Err(Invalid { parameter: "region", must: "must not be that of another reflex" })
    }

    /// Takes one frame: the state of the regions, and the meaning if there is a new one.
    pub fn process(
        &self,
        state: &mut ReactState,
        regions: &[RegionState],
        meaning: Option<&Meaning>,
        now: Micros,
    ) {
        let ReactState { active, activations, leading, changes } = state;
        changes.clear();
        if let Some(meaning) = meaning {
            *leading = meaning.leading;
            activations.clear();
            // Both have the capacity of the map.
            let _ = activations.extend_from_slice(&meaning.activations);
        }
        for (index, ((row, watch), since)) in (0..).zip(self.rows.iter().zip(active)) {
            let value = match watch {
                ResolvedCause::Region(cause, region) => of_regions(cause, *region, regions),
                ResolvedCause::Concept(concept) => activations.get(*concept).map_or(0, |a| a.0),
                ResolvedCause::Leading(wanted) => i32::from(wanted == leading),
                ResolvedCause::Board(..) => continue,
            };
            // Always room: as many places as rows.
            follow(index, row, since, value, now).into_iter().for_each(|change| _ = changes.push(change));
        }
    }

    /// Rows with a cause in the board itself: index, cause, region.
    pub fn alarms(&self) -> impl Iterator<Item = (u8, &Cause, Option<u8>)> {
        (0..).zip(&self.rows).filter_map(|(index, (_, watch))| match watch {
            ResolvedCause::Board(cause, region) => Some((index, cause, *region)),
            _ => None,
        })
    }

    /// Takes the present value of a row with a cause in the board itself. Returns the reaction if it began or
    /// ended.
    pub fn judge(&self, state: &mut ReactState, index: u8, value: i32, now: Micros) -> Option<Reaction> {
        let (row, _) = self.rows.get(usize::from(index))?;
        follow(index, row, state.active.get_mut(usize::from(index))?, value, now)
    }

    /// Begins a row by reflex, at pressure `value` (counts). None if it is active already or is no reflex.
    pub fn begin(&self, state: &mut ReactState, index: u8, value: u16, now: Micros) -> Option<Reaction> {
        let (row, _) = self.rows.get(usize::from(index))?;
        let since = state.active.get_mut(usize::from(index))?;
        if !matches!(row.cause, Cause::Reflex(_)) || since.is_some() {
            return None;
        }
        *since = Some(now);
        Some(Reaction { index, name: row.name.clone(), active: true, value: value.into() })
    }

    /// Rows that begin by reflex.
    pub fn reflexes(&self) -> &Reflexes {
        &self.reflexes
    }

    /// Pin of a row.
    pub fn output(&self, index: u8) -> Option<Line> {
        self.rows.get(usize::from(index))?.0.output
    }

    /// Pins of all rows.
    pub fn outputs(&self) -> impl Iterator<Item = Line> + '_ {
        self.rows.iter().filter_map(|(row, _)| row.output)
    }

    /// Pin of a row and its level: asserted while any row with this pin is active.
    pub fn pin(&self, state: &ReactState, index: u8) -> Option<(u8, bool)> {
        let line = self.output(index)?;
        let lasts = |((row, _), since): (&(ReactionConfig, ResolvedCause), &Option<Micros>)| {
            since.is_some() && row.output == Some(line)
        };
        let asserted = self.rows.iter().zip(&state.active).any(lasts);
        Some((line.pin, asserted != line.inverted))
    }

    /// Pins that show that frames are perceived, each with its level after that many frames.
    pub fn watching(&self, frames: u32) -> impl Iterator<Item = (u8, bool)> + '_ {
        self.rows.iter().filter_map(move |(row, watch)| {
            let ResolvedCause::Board(Cause::Watching, _) = watch else { return None };
            let changes = frames.checked_div(row.level.unsigned_abs())?;
            row.output.map(|line| (line.pin, (changes & 1 == 1) != line.inverted))
        })
    }
}

/// Updates a row with its present value.
#[inline]
fn follow(
    index: u8,
    row: &ReactionConfig,
    since: &mut Option<Micros>,
    value: i32,
    now: Micros,
) -> Option<Reaction> {
    let was = since.is_some();
    if value >= row.level || (was && value >= row.level - row.hysteresis) {
        *since = Some(now);
    } else if since.is_some_and(|last| now.since(last) >= 1000 * u64::from(row.hold_ms)) {
        *since = None;
    }
    (since.is_some() != was).then(|| Reaction { index, name: row.name.clone(), active: !was, value })
}

/// Checks a row and resolves its cause.
fn watch(row: &ReactionConfig, layout: &Layout, map: Option<&Map>) -> Result<ResolvedCause, Invalid> {
    let refuse = |parameter, must| Err(Invalid { parameter, must });
    if row.hysteresis < 0 || row.hysteresis > row.level.max(0) {
        return refuse("hysteresis", "must be 0 to level");
    }
    let region = match layout.regions().iter().position(|r| *r == row.region) {
        Some(region) => Some(region as u8),
        None if row.region.is_empty() => None,
        None => return refuse("region", "must be a region of the garment, or empty"),
    };
    Ok(match &row.cause {
        Cause::Concept(name) => match map.and_then(|map| map.find(name)) {
            Some(concept) => ResolvedCause::Concept(concept),
            None => return refuse("cause.concept", "must be a concept of the map"),
        },
        Cause::Leading(_) if map.is_none() => {
            return refuse("cause.leading", "needs a map, and the scene has none");
        }
        Cause::Leading(leading) => ResolvedCause::Leading(*leading),
        cause if cause.is_of_board() => {
            row.check_of_board()?;
            ResolvedCause::Board(cause.clone(), region)
        }
        cause => ResolvedCause::Region(cause.clone(), region),
    })
}

fn of_regions(cause: &Cause, region: Option<u8>, regions: &[RegionState]) -> i32 {
    let wanted = regions.iter().filter(|state| region.is_none_or(|r| r == state.region));
    let value = wanted
        .map(|state| match cause {
            Cause::Pressure | Cause::Reflex(_) => u32::from(state.peak),
            Cause::Force => state.total,
            Cause::Contacts => u32::from(state.contacts),
            Cause::Moving => u32::from(state.moving),
            _ => 0,
        })
        .max();
    i32::try_from(value.unwrap_or(0)).unwrap_or(i32::MAX)
}
