//! What a robot senses now: the newest of each board, of its joints and of what others tell, each with its age.

use super::felt::{BoardSense, FeltContact, WornMind};
use super::place::BodyPlace;
use super::speeds::LinkSpeeds;
use crate::fcm::robot_source::{RobotInput, RobotSource};
use std::collections::BTreeMap;
use taxel_core::format::Q15;
use taxel_core::intent::Leading;
use taxel_core::wire::IntentReport;

/// A value for an input of the robot's map.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SensedValue {
    /// The value, in the unit of its source.
    pub value: i32,
    /// Its age, ms; none if it is the default that the map states.
    pub age_ms: Option<u32>,
}

/// One of the things of which a value consists.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SenseCause {
    /// Number of the board; none if it is no board's.
    pub board: Option<usize>,
    /// Id of the board's contact, and where it lies; none if it is no contact.
    pub contact: Option<(u32, BodyPlace)>,
    /// What it adds, in the unit of the source.
    pub value: i32,
    /// Its age, ms.
    pub age_ms: u32,
}

/// A present contact.
#[derive(Debug, Clone)]
struct PresentTouch {
    felt: FeltContact,
    /// Host time at which it was first told, us.
    since_us: u64,
}

/// What a board has said.
#[derive(Debug, Clone, Default)]
struct SensedBoard {
    /// Host time of what it said last, us; none while it is not there.
    heard_us: Option<u64>,
    worn: Option<WornMind>,
    contacts: Vec<PresentTouch>,
    report: Option<Box<IntentReport>>,
}

impl SensedBoard {
    /// Age of what it has said, ms, unless it is not there or silent for too long.
    fn age_ms(&self, lasts_ms: Option<u32>, now_us: u64) -> Option<u32> {
        let age_ms = u32::try_from(now_us.saturating_sub(self.heard_us?) / 1000).unwrap_or(u32::MAX);
        lasts_ms.is_none_or(|lasts_ms| age_ms < lasts_ms).then_some(age_ms)
    }

    /// True if its garment covers some of this part.
    fn covers(&self, part: &[String]) -> bool {
        self.worn.iter().flat_map(|worn| &worn.places).any(|place| place.is_of(part))
    }

    /// Contacts on a part.
    fn touches<'a>(&'a self, part: &'a [String]) -> impl Iterator<Item = &'a PresentTouch> {
        self.contacts.iter().filter(|touch| touch.felt.place.is_of(part))
    }

    /// Activation of the intention that it announces; none if it announces another.
    fn announces(&self, leading: Leading) -> Option<Q15> {
        let report = self.report.as_ref().filter(|report| report.leading == leading)?;
        let concepts = &self.worn.as_ref()?.map.as_ref()?.concept;
        let at = concepts.iter().position(|concept| concept.name == leading.as_str())?;
        report.concepts.get(at).copied()
    }
}

/// All that a robot senses.
#[derive(Debug, Clone)]
pub struct Senses {
    boards: Vec<SensedBoard>,
    speeds: Option<LinkSpeeds>,
    /// Values by name, with the host's time from which they are, us.
    told: BTreeMap<String, (Q15, u64)>,
}

impl Senses {
    /// Of so many boards, of which nothing is known; without a description of the robot nothing is known of its
    /// motion.
    pub fn new(boards: usize, speeds: Option<LinkSpeeds>) -> Senses {
        Senses { boards: vec![SensedBoard::default(); boards], speeds, told: BTreeMap::new() }
    }

    /// Takes what a board says of a time of the host, us.
    pub fn board(&mut self, board: usize, sense: &BoardSense, host_us: u64) {
        let Some(sensed) = self.boards.get_mut(board) else { return };
        match sense {
            BoardSense::Begins(worn) => {
                *sensed = SensedBoard { worn: Some(worn.clone()), ..SensedBoard::default() };
            }
            BoardSense::Contacts(contacts) => {
                let since = |felt: &FeltContact| {
                    let before = sensed.contacts.iter().find(|touch| touch.felt.contact == felt.contact);
                    before.map_or(host_us, |touch| touch.since_us)
                };
                let touch = |felt: &FeltContact| PresentTouch { felt: felt.clone(), since_us: since(felt) };
                sensed.contacts = contacts.iter().map(touch).collect();
            }
            BoardSense::Intent(report) => sensed.report = Some(report.clone()),
            BoardSense::Alive => {}
        }
        sensed.heard_us = Some(sensed.heard_us.map_or(host_us, |heard| heard.max(host_us)));
    }

    /// A board is lost: nothing that it said counts any longer.
    pub fn forget(&mut self, board: usize) {
        if let Some(sensed) = self.boards.get_mut(board) {
            *sensed = SensedBoard { worn: sensed.worn.take(), ..SensedBoard::default() };
        }
    }

    /// Takes what somebody tells by a name, of a time of the host, us.
    pub fn tell(&mut self, name: &str, value: Q15, host_us: u64) {
        self.told.insert(name.into(), (value, host_us));
    }

    /// The robot's own links, if it has a description.
    pub fn speeds(&mut self) -> Option<&mut LinkSpeeds> {
        self.speeds.as_mut()
    }

    /// The last report of a board.
    pub fn report(&self, board: usize) -> Option<&IntentReport> {
        self.boards.get(board)?.report.as_deref()
    }

    /// What a board wears, once it has begun.
    pub fn worn(&self, board: usize) -> Option<&WornMind> {
        self.boards.get(board)?.worn.as_ref()
    }

    /// Value of an input at a time of the host, us.
    pub fn value(&self, input: &RobotInput, now_us: u64) -> SensedValue {
        let sensed = self.sensed(input, now_us).map(|(value, age_ms)| SensedValue {
            value: i32::try_from(value).unwrap_or(if value < 0 { i32::MIN } else { i32::MAX }),
            age_ms: Some(age_ms),
        });
        sensed.unwrap_or(SensedValue { value: input.otherwise, age_ms: None })
    }

    /// Value of an input and its age, ms; none if nothing is known that is young enough.
    fn sensed(&self, input: &RobotInput, now_us: u64) -> Option<(i64, u32)> {
        let present = |part: &[String]| {
            let boards = self.boards.iter().filter(|board| board.covers(part));
            let ages = boards.filter_map(|board| board.age_ms(input.lasts_ms, now_us));
            ages.max()
        };
        let causes = || self.causes(input, now_us).into_iter();
        match &input.source {
            RobotSource::Intent(_) => {
                let greatest = causes().map(|cause| i64::from(cause.value)).max().unwrap_or(0);
                Some((greatest, present(&[])?))
            }
            RobotSource::Load(part) | RobotSource::Cover(part) => {
                Some((causes().map(|cause| i64::from(cause.value)).sum(), present(part)?))
            }
            RobotSource::Lasts(part) => {
                Some((causes().map(|cause| i64::from(cause.value)).max().unwrap_or(0), present(part)?))
            }
            RobotSource::Apart(first, second) => {
                let age_ms = present(first)?.max(present(second)?);
                let onsets = [first, second].map(|part| self.onset_us(part, input.lasts_ms, now_us));
                let [Some(first), Some(second)] = onsets else { return Some((0, age_ms)) };
                Some(((second as i64 - first as i64) / 1000, age_ms))
            }
            RobotSource::Motion(_) | RobotSource::Told(_) => {
                causes().next().map(|cause| (cause.value.into(), cause.age_ms))
            }
        }
    }

    /// Onset of the oldest contact on a part, us.
    fn onset_us(&self, part: &[String], lasts_ms: Option<u32>, now_us: u64) -> Option<u64> {
        let boards = self.boards.iter().filter(|board| board.age_ms(lasts_ms, now_us).is_some());
        boards.flat_map(|board| board.touches(part)).map(|touch| touch.since_us).min()
    }

    /// What a value consists of, down to contacts; nothing if it is the default or nothing touches. Of an
    /// intention: the boards that announce it.
    pub fn causes(&self, input: &RobotInput, now_us: u64) -> Vec<SenseCause> {
        let boards = || {
            let ages = self.boards.iter().map(|board| board.age_ms(input.lasts_ms, now_us));
            let live = ages.enumerate().zip(&self.boards);
            live.filter_map(|((number, age_ms), board)| Some((number, age_ms?, board)))
        };
        let touches = |part: &[String], value: &dyn Fn(&PresentTouch) -> u64| -> Vec<SenseCause> {
            let of = |(number, age_ms, board): (usize, u32, &SensedBoard)| -> Vec<SenseCause> {
                let cause = |touch: &PresentTouch| SenseCause {
                    board: Some(number),
                    contact: Some((touch.felt.contact, (*touch.felt.place).clone())),
                    value: i32::try_from(value(touch)).unwrap_or(i32::MAX),
                    age_ms,
                };
                board.touches(part).map(cause).collect()
            };
            boards().flat_map(of).collect()
        };
        let alone = |value: i32, age_ms: u32| SenseCause { board: None, contact: None, value, age_ms };
        let is_young = |age_ms: &u32| input.lasts_ms.is_none_or(|lasts_ms| *age_ms < lasts_ms);
        let since_ms = |touch: &PresentTouch| now_us.saturating_sub(touch.since_us) / 1000;
        match &input.source {
            RobotSource::Intent(leading) => {
                let announced = boards().filter_map(|(number, age_ms, board)| {
                    let value = board.announces(*leading)?.0;
                    Some(SenseCause { board: Some(number), ..alone(value, age_ms) })
                });
                announced.collect()
            }
            RobotSource::Load(part) => touches(part, &|touch| touch.felt.load.into()),
            RobotSource::Cover(part) => touches(part, &|touch| touch.felt.cover_mm2.into()),
            RobotSource::Lasts(part) => touches(part, &since_ms),
            RobotSource::Apart(first, second) => {
                let both = [first, second].map(|part| touches(part, &since_ms));
                if both.iter().any(Vec::is_empty) { Vec::new() } else { both.concat() }
            }
            RobotSource::Motion(part) => {
                let is_meant =
                    |link: &str| BodyPlace { region: String::new(), link: link.into() }.is_of(part);
                let fastest = self.speeds.as_ref().and_then(|speeds| speeds.fastest(now_us, is_meant));
                let young = fastest.filter(|(_, age_ms)| is_young(age_ms));
                young.map(|(speed, age_ms)| alone(speed, age_ms)).into_iter().collect()
            }
            RobotSource::Told(name) => {
                let told = self.told.get(name).map(|(value, from_us)| {
                    let age_ms = u32::try_from(now_us.saturating_sub(*from_us) / 1000).unwrap_or(u32::MAX);
                    alone(value.0, age_ms)
                });
                told.filter(|told| is_young(&told.age_ms)).into_iter().collect()
            }
        }
    }
}
