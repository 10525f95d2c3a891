//! The mind: the robot's map over what it senses.

use super::felt::BoardSense;
use super::host_input::{HostInputLine, fraction};
use super::senses::{SensedValue, Senses};
use super::speeds::LinkSpeeds;
use crate::error::{Context, MapFileError, Result, UsageError};
use crate::fcm::map::MapFile;
use crate::fcm::robot_source::{RobotInput, RobotSource};
use crate::robot::{BoardEvent, BoardState, ReadRobot, RobotEvent};
use crate::text::words;
use taxel_core::format::{Micros, Q15};
use taxel_core::intent::{CONCEPTS, EDGES, Felt, Intent, IntentConfig, IntentState, Leading, Outcome};

/// Time that an intention must lead before it is announced, ms: boards have waited already, and what leads
/// must not contradict what holds.
const ONSET_MS: u16 = 0;
/// Shortest time between two inferences, ms.
const PERIOD_MS: u16 = 5;
/// Greatest number of steps of an inference.
const STEPS: u16 = 64;
/// Activation from which a concept holds, thousandths; one that holds does so down to a tenth less.
const LEVEL: [u16; 2] = [500, 400];

/// Meaning of the touches on the robot as a whole.
#[derive(Debug, Clone, PartialEq)]
pub struct RobotMeaning {
    /// The host's time, us since 1970.
    pub host_us: u64,
    /// The announced intention.
    pub leading: Leading,
    /// Concepts with causes that hold, by their numbers.
    pub holding: Vec<usize>,
    /// Activation of each concept of the map.
    pub activations: Vec<Q15>,
    /// Steps of the inference.
    pub steps: u16,
    /// End of the inference.
    pub outcome: Outcome,
    /// Values that it heard, by the inputs of the map.
    pub heard: Vec<SensedValue>,
}

/// The mind of a robot.
#[derive(Debug, Clone)]
pub struct RobotMind {
    map: MapFile,
    inputs: Vec<RobotInput>,
    /// Numbers of the concepts with causes.
    driven: Vec<usize>,
    stage: Box<Intent>,
    state: Box<IntentState>,
    senses: Senses,
    meaning: Option<RobotMeaning>,
    now_us: u64,
    /// Host time of its last thought, us.
    thought_us: u64,
}

impl RobotMind {
    /// The mind of a robot by the map of its file. Error if the map hears what only a board hears, or the
    /// arithmetic has no room for it.
    pub fn new(robot: &ReadRobot) -> Result<RobotMind> {
        let speeds = robot.robot.clone().map(LinkSpeeds::new).transpose()?;
        RobotMind::with(robot.map.clone(), Senses::new(robot.boards.len(), speeds))
    }

    /// A mind with this map.
    pub fn with(map: MapFile, mut senses: Senses) -> Result<RobotMind> {
        let config = *map.to_config::<CONCEPTS, EDGES>()?;
        if let Some(input) = map.input.iter().find(|input| input.robot.is_none()) {
            let (name, concept) = (&map.name, &input.concept);
            fail!(
                MapFileError::Unanswerable,
                "map {name}: input {concept} is of one board: a map of a robot hears what its inputs say by `robot`"
            );
        }
        let config = IntentConfig {
            onset_ms: ONSET_MS,
            period_ms: PERIOD_MS,
            steps: STEPS,
            ..IntentConfig::new(config)
        };
        let stage = Intent::build(&config).with_context(|| format!("map {}", map.name))?;
        let inputs = map.robot_inputs();
        senses.know(&inputs);
        let is_driven = |at: &usize| map.is_driven(&map.concept[*at].name);
        Ok(RobotMind {
            inputs,
            driven: (0..map.concept.len()).filter(is_driven).collect(),
            stage: Box::new(stage),
            state: Box::default(),
            senses,
            meaning: None,
            now_us: 0,
            thought_us: 0,
            map,
        })
    }

    /// Returns its map.
    pub fn map(&self) -> &MapFile {
        &self.map
    }

    /// Returns its inputs.
    pub fn inputs(&self) -> &[RobotInput] {
        &self.inputs
    }

    /// Returns what it senses.
    pub fn senses(&self) -> &Senses {
        &self.senses
    }

    /// Returns what it meant at its last inference; none before the first.
    pub fn meaning(&self) -> Option<&RobotMeaning> {
        self.meaning.as_ref()
    }

    /// Returns the meaning of what it senses now, inferred anew; what leads and holds is that of the last inference.
    pub(crate) fn meaning_now(&self) -> RobotMeaning {
        let heard = self.hear();
        let map = self.stage.map();
        let run = map.infer(&map.encode(None, &values(&heard)), STEPS);
        let activations = run.state.iter().take(map.len()).map(|value| map.q15(*value)).collect();
        let last = self.meaning.as_ref();
        RobotMeaning {
            host_us: self.now_us,
            leading: last.map_or(Leading::None, |last| last.leading),
            holding: last.map_or(Vec::new(), |last| last.holding.clone()),
            activations,
            steps: run.steps,
            outcome: run.outcome,
            heard,
        }
    }

    /// Returns what it hears now, by its inputs.
    fn hear(&self) -> Vec<SensedValue> {
        self.inputs.iter().map(|input| self.senses.value(input, self.now_us)).collect()
    }

    /// Takes what a board says of a time of the host, us; it thinks when a board announces something else,
    /// else every 5 ms. Returns what that means if it is news: another intention leads, or other concepts hold.
    pub fn board(&mut self, board: usize, sense: &BoardSense, host_us: u64) -> Option<&RobotMeaning> {
        let announced = self.senses.report(board).map(|report| report.leading);
        self.senses.board(board, sense, host_us);
        // Of a hundred boards that scan, not each scan is worth a thought; a new word is.
        let is_word = match sense {
            BoardSense::Intent(report) => announced != Some(report.leading),
            BoardSense::Begins(_) => true,
            BoardSense::Contacts(_) | BoardSense::Alive => false,
        };
        let due_us = self.thought_us.saturating_add(1000 * u64::from(PERIOD_MS));
        if is_word || host_us >= due_us { self.pass(host_us) } else { None }
    }

    /// Takes an event of a board, whose news say this of touches. Returns what that means if it is news.
    pub fn event<T>(
        &mut self,
        event: &RobotEvent<T>,
        sense: impl FnOnce(&T) -> Option<&BoardSense>,
    ) -> Option<&RobotMeaning> {
        let RobotEvent { board, stamp, what } = event;
        match what {
            BoardEvent::News(news) => self.board(*board, sense(news)?, stamp.host_us),
            BoardEvent::State(BoardState::Lost { .. } | BoardState::Over { .. } | BoardState::Failed(_)) => {
                self.forget(*board, stamp.host_us)
            }
            BoardEvent::State(_) => None,
        }
    }

    /// A board is lost: nothing that it said counts any longer.
    pub fn forget(&mut self, board: usize, host_us: u64) -> Option<&RobotMeaning> {
        self.senses.forget(board);
        self.pass(host_us)
    }

    /// Takes what is reported at a time of the host, us. Error, and nothing is taken, if the map hears nothing by
    /// such a name, the robot has no such joint, or a value is out of its range.
    pub fn take_input(&mut self, line: &HostInputLine, host_us: u64) -> Result<Option<&RobotMeaning>> {
        let from_us = line.from_us(host_us);
        let mut reported = Vec::new();
        for (name, value) in &line.host_input {
            let known = self.inputs.iter().filter_map(|input| match &input.source {
                RobotSource::HostInput(name) => Some(name.as_str()),
                _ => None,
            });
            if !known.clone().any(|known| known == name) {
                fail!(UsageError::Unknown, "{}", words::unknown("name of a host input", name, known));
            }
            reported.push((name, fraction(name, *value)?));
        }
        if !line.positions.is_empty() {
            let Some(speeds) = self.senses.speeds() else {
                fail!(UsageError::Argument, "the robot's file names no `urdf`, and so it has no joints");
            };
            speeds.take(from_us, line.joints())?;
        }
        reported.into_iter().for_each(|(name, value)| self.senses.take_input(name, value, from_us));
        Ok(self.pass(host_us))
    }

    /// Advances to this time of the host, us: what is too old no longer counts. Returns what that means if it is
    /// news.
    pub fn pass(&mut self, host_us: u64) -> Option<&RobotMeaning> {
        // Boards report times that are not in order.
        self.now_us = self.now_us.max(host_us);
        self.thought_us = self.now_us;
        let (heard, now) = (self.hear(), Micros(self.now_us));
        let found = self.stage.process(&mut self.state, &[], &Felt::default(), &values(&heard), now)?;
        let (led, held) = self
            .meaning
            .as_ref()
            .map_or((Leading::None, &[][..]), |meaning| (meaning.leading, meaning.holding.as_slice()));
        let holds = |at: &usize| {
            let level = LEVEL[usize::from(held.contains(at))];
            found.activations.get(*at).is_some_and(|value| 1000 * value.0 >= i32::from(level) * Q15::ONE.0)
        };
        let holding: Vec<usize> = self.driven.iter().copied().filter(holds).collect();
        let is_news = found.leading != led || holding != held;
        self.meaning = Some(RobotMeaning {
            host_us: self.now_us,
            leading: found.leading,
            holding,
            activations: found.activations.to_vec(),
            steps: found.steps,
            outcome: found.outcome,
            heard,
        });
        self.meaning.as_ref().filter(|_| is_news)
    }
}

/// Values as the stage takes those of a host, by slot.
fn values(heard: &[SensedValue]) -> Vec<Q15> {
    heard.iter().map(|heard| Q15(heard.value)).collect()
}
