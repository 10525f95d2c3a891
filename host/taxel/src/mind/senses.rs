//! Senses of a robot now: the newest of each board, of its joints and of what others send, each with its age.

use super::body_part::{BodyPart, parts_of};
use super::felt::{BoardPlacement, BoardSense};
use super::mover::{Mover, REACH_M};
use super::place::BodyPlace;
use super::probe::Probe;
use super::sensed_board::{ListedAt, SensedBoard, SensedTouch, TOGETHER_US};
use super::speeds::{LinkSpeeds, LinksAt};
use crate::fcm::robot_source::{PartWords, RobotInput, RobotSource};
use std::collections::BTreeMap;
use std::sync::Arc;
use taxel_core::format::Q15;
use taxel_core::intent::Leading;
use taxel_core::wire::IntentReport;

/// Greatest speed of a link, m/s: what was farther away than that allows is not near now.
const FASTEST_M_S: f64 = 10.0;

/// A value for an input of the robot's map.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SensedValue {
    /// The value, in the unit of its source.
    pub value: i32,
    /// Age, ms; none if it is the default that the map states.
    pub age_ms: Option<u32>,
}

/// One of the things of which a value consists.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SenseCause {
    /// Number of the board; none if it is no board's.
    pub board: Option<usize>,
    /// Id of the board's contact, and where it lies; none if it is no contact.
    pub contact: Option<(u32, Arc<BodyPlace>)>,
    /// Contribution, in the unit of the source.
    pub value: i32,
    /// Age, ms.
    pub age_ms: u32,
}

impl SenseCause {
    /// A contact of a board.
    fn of(board: usize, touch: &SensedTouch, value: u64, age_ms: u32) -> SenseCause {
        SenseCause {
            board: Some(board),
            contact: Some((touch.felt.contact, touch.felt.place.clone())),
            value: i32::try_from(value).unwrap_or(i32::MAX),
            age_ms,
        }
    }
}

/// All that a robot senses.
#[derive(Debug, Clone)]
pub struct Senses {
    boards: Vec<SensedBoard>,
    speeds: Option<LinkSpeeds>,
    /// Values by name, with the host's time from which they are, us.
    reported: BTreeMap<String, (Q15, u64)>,
    /// Parts of the body that have a number.
    parts: Vec<PartWords>,
}

impl Senses {
    /// Makes the senses of so many boards, of which nothing is known; without a description of the robot nothing is
    /// known of its motion.
    pub fn new(boards: usize, speeds: Option<LinkSpeeds>) -> Senses {
        Senses {
            boards: vec![SensedBoard::default(); boards],
            speeds,
            reported: BTreeMap::new(),
            parts: Vec::new(),
        }
    }

    /// Values of these inputs will be asked for: gives a number to each part that they name.
    pub(super) fn know(&mut self, inputs: &[RobotInput]) {
        self.parts = parts_of(inputs);
    }

    /// Takes what a board says of a time of the host, us.
    pub fn board(&mut self, board: usize, sense: &BoardSense, host_us: u64) {
        let Senses { boards, speeds, parts, .. } = self;
        let Some(sensed) = boards.get_mut(board) else { return };
        match sense {
            BoardSense::Begins(placement) => *sensed = SensedBoard::begin(placement, parts),
            BoardSense::Contacts(contacts) => {
                let speeds = speeds.as_ref();
                let has_spot = contacts.iter().any(|felt| felt.spot.is_some());
                let links = speeds.filter(|_| has_spot).and_then(|speeds| speeds.at(host_us));
                let links = links.as_ref();
                sensed.list(contacts, &ListedAt { host_us, speeds, links, parts });
                if speeds.is_some() {
                    pair(boards, board, links, host_us);
                }
            }
            BoardSense::Intent(report) => sensed.report = Some(report.clone()),
            BoardSense::Alive => {}
        }
        let Some(sensed) = self.boards.get_mut(board) else { return };
        sensed.heard_us = Some(sensed.heard_us.map_or(host_us, |heard| heard.max(host_us)));
    }

    /// Number of boards.
    pub fn boards(&self) -> usize {
        self.boards.len()
    }

    /// Contacts of a board that are present, and those that have just ended.
    pub fn touches(&self, board: usize) -> &[SensedTouch] {
        self.boards.get(board).map_or(&[], |sensed| &sensed.contacts)
    }

    /// A board is lost: nothing that it said counts any longer.
    pub fn forget(&mut self, board: usize) {
        if let Some(sensed) = self.boards.get_mut(board) {
            sensed.forget();
        }
    }

    /// Takes what somebody sends by a name, of a time of the host, us.
    pub fn take_input(&mut self, name: &str, value: Q15, host_us: u64) {
        self.reported.insert(name.into(), (value, host_us));
    }

    /// The robot's own links, if it has a description.
    pub fn speeds(&mut self) -> Option<&mut LinkSpeeds> {
        self.speeds.as_mut()
    }

    /// The last report of a board.
    pub fn report(&self, board: usize) -> Option<&IntentReport> {
        self.boards.get(board)?.report.as_deref()
    }

    /// The garment of a board, once it has begun.
    pub(crate) fn placement(&self, board: usize) -> Option<&BoardPlacement> {
        self.boards.get(board)?.placement.as_ref()
    }

    /// Value of an input at a time of the host, us.
    pub fn value(&self, input: &RobotInput, now_us: u64) -> SensedValue {
        let sensed = self.sensed(input, now_us).map(|(value, age_ms)| SensedValue {
            value: i32::try_from(value).unwrap_or(if value < 0 { i32::MIN } else { i32::MAX }),
            age_ms: Some(age_ms),
        });
        sensed.unwrap_or(SensedValue { value: input.default, age_ms: None })
    }

    /// The part that these words name.
    fn part<'a>(&self, words: &'a [String]) -> BodyPart<'a> {
        BodyPart::of(words, &self.parts)
    }

    /// Value of an input and its age, ms; none if nothing is known that is young enough.
    fn sensed(&self, input: &RobotInput, now_us: u64) -> Option<(i64, u32)> {
        let present = |words: &[String]| {
            let part = self.part(words);
            let boards = self.boards.iter().filter(|board| board.covers(part));
            let ages = boards.filter_map(|board| board.age_ms(input.timeout_ms, now_us));
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
                let onsets = [first, second].map(|part| self.onset_us(part, input.timeout_ms, now_us));
                let [Some(first), Some(second)] = onsets else { return Some((0, age_ms)) };
                Some(((second as i64 - first as i64) / 1000, age_ms))
            }
            // A board's word is excused by its own contacts alone.
            RobotSource::Own => {
                let announces = |board: &SensedBoard| {
                    board.report.as_ref().is_some_and(|report| report.leading != Leading::None)
                };
                let live =
                    || self.boards.iter().filter(|board| board.age_ms(input.timeout_ms, now_us).is_some());
                let announcing = live().filter(|board| announces(board));
                let excused = announcing.map(|board| board.own().unwrap_or(0)).min();
                let least = causes().min_by_key(|cause| cause.value)?;
                Some((excused.unwrap_or(least.value).into(), least.age_ms))
            }
            // Of several objects, that which is pressed most.
            RobotSource::Hardness(_)
            | RobotSource::Point(_)
            | RobotSource::Slide(_)
            | RobotSource::Stir(_) => causes().next().map(|cause| (cause.value.into(), cause.age_ms)),
            RobotSource::Motion(_) | RobotSource::HostInput(_) => {
                causes().next().map(|cause| (cause.value.into(), cause.age_ms))
            }
        }
    }

    /// Onset of the oldest contact on a part, us.
    fn onset_us(&self, words: &[String], timeout_ms: Option<u32>, now_us: u64) -> Option<u64> {
        let part = self.part(words);
        let boards = self.boards.iter().filter(|board| board.age_ms(timeout_ms, now_us).is_some());
        boards.flat_map(|board| board.touches(part, now_us)).map(|touch| touch.since_us).min()
    }

    /// The boards that count for an input: their numbers, and their ages, ms.
    fn live(&self, input: &RobotInput, now_us: u64) -> impl Iterator<Item = (usize, u32, &SensedBoard)> {
        let ages = self.boards.iter().map(move |board| board.age_ms(input.timeout_ms, now_us));
        let boards = ages.enumerate().zip(&self.boards);
        boards.filter_map(|((number, age_ms), board)| Some((number, age_ms?, board)))
    }

    /// Returns the contact with the greatest force of what a part has moved into; its board, and the age of that, ms.
    fn met(&self, words: &[String], input: &RobotInput, now_us: u64) -> Option<(usize, u32, &SensedTouch)> {
        let part = self.part(words);
        let own = self.live(input, now_us).flat_map(|(number, age_ms, board)| {
            let own = board.contacts.iter().filter(|touch| touch.mover == Mover::Own);
            own.filter(move |touch| touch.is_of(part)).map(move |touch| (number, age_ms, touch))
        });
        own.max_by_key(|(.., touch)| touch.most)
    }

    /// Returns what a value consists of, down to contacts; nothing if it is the default or nothing touches. Of an
    /// intention: the boards that announce it.
    pub fn causes(&self, input: &RobotInput, now_us: u64) -> Vec<SenseCause> {
        let boards = || self.live(input, now_us);
        let touches = |words: &[String], value: &dyn Fn(&SensedTouch) -> u64| -> Vec<SenseCause> {
            let part = self.part(words);
            let of = |(number, age_ms, board): (usize, u32, &SensedBoard)| -> Vec<SenseCause> {
                let cause = |touch: &SensedTouch| SenseCause::of(number, touch, value(touch), age_ms);
                board.touches(part, now_us).map(cause).collect()
            };
            boards().flat_map(of).collect()
        };
        let probed = |part: &[String], value: &dyn Fn(Probe) -> Option<u32>| -> Vec<SenseCause> {
            let cause = self.met(part, input, now_us).and_then(|(number, age_ms, touch)| {
                Some(SenseCause::of(number, touch, value(touch.course.probe())?.into(), age_ms))
            });
            cause.into_iter().collect()
        };
        let alone = |value: i32, age_ms: u32| SenseCause { board: None, contact: None, value, age_ms };
        let is_young = |age_ms: &u32| input.timeout_ms.is_none_or(|timeout_ms| *age_ms < timeout_ms);
        let since_ms = |touch: &SensedTouch| now_us.saturating_sub(touch.since_us) / 1000;
        match &input.source {
            RobotSource::Intent(leading) => {
                let announced = boards().filter_map(|(number, age_ms, board)| {
                    let value = board.announces(*leading)?.0;
                    Some(SenseCause { board: Some(number), ..alone(value, age_ms) })
                });
                announced.collect()
            }
            RobotSource::Load(part) => touches(part, &|touch| touch.recent.0.into()),
            RobotSource::Cover(part) => {
                touches(part, &|touch| touch.ended_us.map_or(touch.felt.cover_mm2, |_| 0).into())
            }
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
            RobotSource::Hardness(part) => probed(part, &|probe| probe.hardness),
            RobotSource::Point(part) => probed(part, &|probe| Some(probe.point)),
            RobotSource::Slide(part) => probed(part, &|probe| Some(probe.slide)),
            RobotSource::Stir(part) => probed(part, &|probe| Some(probe.stir)),
            RobotSource::Own => {
                let own = boards().filter_map(|(number, age_ms, board)| {
                    Some(SenseCause { board: Some(number), ..alone(board.own()?, age_ms) })
                });
                own.collect()
            }
            RobotSource::HostInput(name) => {
                let reported = self.reported.get(name).map(|(value, from_us)| {
                    let age_ms = u32::try_from(now_us.saturating_sub(*from_us) / 1000).unwrap_or(u32::MAX);
                    alone(value.0, age_ms)
                });
                reported.filter(|reported| is_young(&reported.age_ms)).into_iter().collect()
            }
        }
    }
}

/// Pairs contacts: where the robot's own surfaces face each other and both are pressed, the robot touches itself, and
/// one of them may be still. What begins beside the robot's own bump belongs to it. Looks at the contacts of a board,
/// which has just sent them, and at all others; the links are there then, if that is known.
fn pair(boards: &mut [SensedBoard], board: usize, links: Option<&LinksAt<'_>>, now_us: u64) {
    let mut own = Vec::new();
    for (number, sensed) in boards.iter().enumerate() {
        for other in &sensed.contacts {
            // Most are far from each other, and nothing more is looked at.
            for mine in boards[board].contacts.iter().filter(|mine| !is_far(mine, other, now_us)) {
                let meets = || meet(mine, other, links);
                if mine.mover != Mover::Own && (is_of_bump(mine, other) || meets()) {
                    own.push((board, mine.felt.contact));
                }
                let is_concerned = number != board && other.ended_us.is_none();
                if is_concerned && other.mover != Mover::Own && (is_of_bump(other, mine) || meets()) {
                    own.push((number, other.felt.contact));
                }
            }
        }
    }
    for (number, contact) in own {
        let touches = boards[number].contacts.iter_mut();
        touches.filter(|touch| touch.felt.contact == contact).for_each(|touch| touch.mover = Mover::Own);
    }
}

/// True if two touches cannot be near each other, by where they were when they were reported last.
fn is_far(touch: &SensedTouch, other: &SensedTouch, now_us: u64) -> bool {
    let (Some(((a, _), a_us)), Some(((b, _), b_us))) = (touch.in_base, other.in_base) else { return false };
    let passed_s = (now_us.abs_diff(a_us) + now_us.abs_diff(b_us)) as f64 * 1e-6;
    a.distance_squared(b) > (REACH_M + FASTEST_M_S * passed_s).powi(2)
}

/// True if a touch begins beside a bump of the robot, and with it.
fn is_of_bump(touch: &SensedTouch, bump: &SensedTouch) -> bool {
    let began_with = || bump.since_us.abs_diff(touch.since_us) <= TOGETHER_US;
    let spots = || touch.felt.spot.as_ref().zip(bump.felt.spot.as_ref());
    bump.mover == Mover::Own && began_with() && spots().is_some_and(|(spot, at)| spot.is_beside(at))
}

/// True if two touches that are present are the robot's own surface touching itself.
fn meet(touch: &SensedTouch, other: &SensedTouch, links: Option<&LinksAt<'_>>) -> bool {
    let is_pressed = touch.ended_us.is_none() && other.ended_us.is_none();
    let spots = touch.felt.spot.as_ref().zip(other.felt.spot.as_ref()).zip(links).filter(|_| is_pressed);
    spots.is_some_and(|((spot, facing), links)| spot.meets(facing, links))
}
