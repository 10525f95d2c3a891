//! A cycle: from what touches the robot to the velocities of its joints.

use super::clamp::is_clamped;
use super::command::{MotionCause, MotionCommand, MotionDeed, MotionPhase};
use super::config::TouchAction;
use super::file::Behaviour;
use super::guard::{self, MotionFault, SeenCycle};
use super::input::{MotionInput, MotionTouch};
use super::known::{self, Chosen, RecentTouch};
use super::limits::allowed_change;
use super::solve::{Bound, Goal, NEXT_LEVEL, solve};
use super::spot::TouchedSpot;
use super::state::{MotionState, Retreat};
use super::yielding::{self, LeadingForce};
use crate::body::robot::{Poses, Robot};
use std::sync::Arc;

/// A robot and its behaviour; see the [module](super).
#[derive(Debug, Clone)]
pub struct MotionControl {
    robot: Arc<Robot>,
    behaviour: Behaviour,
}

/// Task of an armed cycle.
struct CyclePlan {
    deed: MotionDeed,
    /// Velocities that points should have; none: the robot stands still, at once.
    goals: Option<Vec<Goal>>,
    /// Greatest factor on the robot's own speed.
    speed: f64,
}

impl MotionControl {
    /// A robot with a behaviour that was checked against it.
    pub fn new(robot: Arc<Robot>, behaviour: Behaviour) -> MotionControl {
        MotionControl { robot, behaviour }
    }

    /// Its robot.
    pub fn robot(&self) -> &Arc<Robot> {
        &self.robot
    }

    /// Its behaviour.
    pub fn behaviour(&self) -> &Behaviour {
        &self.behaviour
    }

    /// The state at the start: disarmed.
    pub fn start(&self) -> MotionState {
        MotionState::new(self.robot.free().len(), self.behaviour.config.tank_j)
    }

    /// Arms it, from standstill, with a full tank. Error, and it stays as it is, while what is known would be a fault.
    pub fn arm(&self, state: &mut MotionState, input: &MotionInput<'_>) -> Result<(), MotionFault> {
        let joints = self.robot.free().len();
        if let Some(fault) = guard::fault(&self.behaviour.config.faults, joints, None, input) {
            return Err(fault);
        }
        let (counts, seen) = (state.counts, Some(SeenCycle::of(input)));
        *state = MotionState { counts, seen, phase: MotionPhase::Armed, ..self.start() };
        Ok(())
    }

    /// Advances to a cycle. Whatever the input is, the command is 0 unless it is armed and without a fault.
    pub fn step(&self, state: &mut MotionState, input: &MotionInput<'_>) -> MotionCommand {
        let moves = state.velocities.iter().any(|velocity| *velocity != 0.0);
        let before = state.seen.replace(SeenCycle::of(input));
        if state.phase == MotionPhase::Armed {
            let (faults, joints) = (&self.behaviour.config.faults, self.robot.free().len());
            if let Some(fault) =
                guard::fault(faults, joints, before.as_ref().map(|seen| (seen, moves)), input)
            {
                state.stop(fault);
            }
        }
        let posture = input.posture.filter(|_| state.phase == MotionPhase::Armed);
        let (Some(posture), Some(before)) = (posture, before) else { return self.resting(state) };
        let seconds = input.now_us.saturating_sub(before.now_us) as f64 * 1e-6;
        let poses = self.robot.poses(posture.positions);
        known::take(&mut state.known, input);
        let spot =
            |touch: &MotionTouch| TouchedSpot::of(&self.robot, &poses, touch.link, touch.at, touch.normal);
        let spots: Vec<(&MotionTouch, TouchedSpot)> =
            input.touches.iter().filter_map(|touch| Some((touch, spot(touch)?))).collect();
        let chosen: Vec<Option<Chosen>> =
            state.known.iter().map(|it| it.chosen(&self.behaviour.config, input.leading)).collect();
        let plan = self.plan(state, input.now_us, &poses, (&chosen, &spots), seconds);
        let mut share = 1.0;
        match &plan.goals {
            None => state.stand(),
            Some(goals) => {
                let late = input.now_us.saturating_sub(posture.at_us) as f64 * 1e-6;
                state.velocities = self.within_limits(state, goals, posture.positions, (seconds, late));
                share = self.safe_share(state, &poses, &spots, seconds);
                state.velocities.iter_mut().for_each(|velocity| *velocity *= share);
            }
        }
        if !state.velocities.iter().all(|velocity| velocity.is_finite()) {
            state.stop(MotionFault::NotANumber);
            return self.resting(state);
        }
        let deed = self.pace(state, &plan, input.now_us, seconds);
        let causes = state.known.iter().zip(&chosen).filter_map(|(it, chosen)| cause(it, (*chosen)?));
        MotionCommand {
            deed,
            speed: Some(state.speed),
            share,
            causes: causes.collect(),
            ..self.resting(state)
        }
    }

    /// The command of a robot that stands still, or the parts that all commands share.
    fn resting(&self, state: &MotionState) -> MotionCommand {
        let (deed, speed) = match state.phase {
            MotionPhase::Stopped => (MotionDeed::Stop, Some(0.0)),
            _ => (MotionDeed::Nothing, None),
        };
        MotionCommand {
            phase: state.phase,
            deed,
            fault: state.fault,
            speed,
            velocities: state.velocities.clone(),
            tank_j: state.tank.left_j(),
            share: 1.0,
            causes: Vec::new(),
        }
    }

    /// Decides what to do, by priority: clamped, stop, retreat, yield, slow.
    fn plan(
        &self,
        state: &mut MotionState,
        now_us: u64,
        poses: &Poses,
        (chosen, spots): (&[Option<Chosen>], &[(&MotionTouch, TouchedSpot)]),
        seconds: f64,
    ) -> CyclePlan {
        let config = &self.behaviour.config;
        let after = |s: f64| now_us.saturating_add((s * 1e6) as u64);
        if is_clamped(spots, &config.clamp) {
            state.clamped_us = after(config.clamp.seconds);
        }
        if now_us < state.clamped_us {
            return CyclePlan { deed: MotionDeed::Clamped, goals: None, speed: 0.0 };
        }
        if chosen.iter().flatten().any(|chosen| chosen.action == TouchAction::Stop) {
            return CyclePlan { deed: MotionDeed::Stop, goals: None, speed: 0.0 };
        }
        let mut forces = Vec::new();
        for (it, chosen) in state.known.iter().zip(chosen) {
            let Some(chosen) = chosen else { continue };
            match chosen.action {
                TouchAction::Retreat => {
                    begin_retreat(&mut state.retreats, it, after(config.retreat.seconds));
                }
                TouchAction::Yield if it.is_present => {
                    // A link that is led already is led on: a hand loses it for a moment.
                    let is_led = state.led.iter().any(|led| led.link == it.touch.link);
                    let is_new = now_us < it.since_us + micros(config.yields.after_s);
                    let spot = spots.iter().find(|(touch, _)| touch.touch == it.touch.touch);
                    let leads = spot.filter(|_| is_led || !is_new);
                    forces.extend(leads.map(|(touch, spot)| LeadingForce {
                        link: touch.link,
                        at: touch.at,
                        force: -spot.normal * touch.newtons.max(0.0),
                    }));
                }
                _ => {}
            }
        }
        state.retreats.retain(|retreat| state.known.iter().any(|it| it.touch.touch == retreat.touch));
        yielding::advance(&mut state.led, &forces, &config.yields, seconds);

        let retreats = state.retreats.iter().filter(|retreat| now_us <= retreat.until_us);
        let away = retreats.filter_map(|Retreat { link, at, normal, .. }| {
            let spot = TouchedSpot::of(&self.robot, poses, *link, *at, *normal)?;
            Some(Goal { velocity: -spot.normal * config.retreat.speed, columns: spot.columns, weight: 1.0 })
        });
        let mut goals: Vec<Goal> = away.collect();
        let is_retreat = !goals.is_empty();
        let weight = if is_retreat { NEXT_LEVEL } else { 1.0 };
        let led = state.led.iter().filter_map(|it| {
            let spot = TouchedSpot::of(&self.robot, poses, it.link, it.at, it.velocity)?;
            Some(Goal { velocity: it.velocity, columns: spot.columns, weight })
        });
        goals.extend(led);
        let (deed, speed) = match (is_retreat, goals.is_empty()) {
            (true, _) => (MotionDeed::Retreat, 0.0),
            (false, false) => (MotionDeed::Yield, 0.0),
            (false, true) => {
                let factors = chosen.iter().flatten().map(|chosen| chosen.factor);
                (MotionDeed::Slow, factors.fold(1.0, f64::min))
            }
        };
        CyclePlan { deed, goals: Some(goals), speed }
    }

    /// Velocities that fulfil the goals within the limits of the joints.
    fn within_limits(
        &self,
        state: &MotionState,
        goals: &[Goal],
        positions: &[f64],
        (seconds, late): (f64, f64),
    ) -> Vec<f64> {
        let limits = &self.behaviour.joints;
        let joints = limits.iter().zip(positions.iter().zip(&state.velocities));
        let bounds: Vec<Bound> = joints
            .map(|(limit, (position, velocity))| Bound {
                range: limit.velocities(*position, *velocity, late),
                most: limit.velocity,
            })
            .collect();
        let wanted = solve(goals, &bounds);
        let change = allowed_change(limits, &state.velocities, &wanted, seconds);
        let changed = state.velocities.iter().zip(&wanted).map(|(from, to)| from + change * (to - from));
        // A limit of position goes before the direction.
        changed.zip(&bounds).map(|(velocity, bound)| velocity.clamp(bound.range.0, bound.range.1)).collect()
    }

    /// The share of the velocities that pairs of links and the tank allow.
    fn safe_share(
        &self,
        state: &mut MotionState,
        poses: &Poses,
        spots: &[(&MotionTouch, TouchedSpot)],
        seconds: f64,
    ) -> f64 {
        let pairs = self.behaviour.apart.iter();
        let apart = pairs.map(|pair| pair.share(&self.robot, poses, &state.velocities)).fold(1.0, f64::min);
        let powers = spots.iter().map(|(touch, spot)| {
            apart * touch.newtons.max(0.0) * spot.normal.dot(spot.velocity(&state.velocities))
        });
        let powers: Vec<f64> = powers.collect();
        apart * state.tank.pay(&powers, seconds, self.behaviour.config.tank_j)
    }

    /// Sets the speed of the robot's own motion: down at once, up after a while and slowly. Returns what is done.
    fn pace(&self, state: &mut MotionState, plan: &CyclePlan, now_us: u64, seconds: f64) -> MotionDeed {
        let resume = &self.behaviour.config.resume;
        if plan.speed <= state.speed {
            (state.speed, state.slowed_us) = (plan.speed, now_us);
        } else if now_us >= state.slowed_us + micros(resume.after_s) {
            let step = if resume.over_s > 0.0 { seconds / resume.over_s } else { 1.0 };
            state.speed = (state.speed + step).min(plan.speed);
        }
        match plan.deed {
            MotionDeed::Slow if state.speed >= 1.0 => MotionDeed::Free,
            MotionDeed::Slow if plan.speed >= 1.0 => MotionDeed::Resume,
            deed => deed,
        }
    }
}

/// Begins a retreat from a touch, or goes on with it. A touch that has ended begins one, and does not prolong it.
fn begin_retreat(retreats: &mut Vec<Retreat>, it: &RecentTouch, until_us: u64) {
    let RecentTouch { touch, is_present, .. } = it;
    let MotionTouch { link, at, normal, .. } = *touch;
    match retreats.iter_mut().find(|retreat| retreat.touch == touch.touch) {
        Some(retreat) if *is_present => *retreat = Retreat { link, at, normal, until_us, ..*retreat },
        Some(_) => {}
        None => retreats.push(Retreat { touch: touch.touch, link, at, normal, until_us }),
    }
}

fn cause(it: &RecentTouch, Chosen { action, row, .. }: Chosen) -> Option<MotionCause> {
    let newtons = if it.is_present { it.touch.newtons } else { it.most };
    let place = it.touch.place.clone();
    (action != TouchAction::Ignore).then_some(MotionCause {
        touch: it.touch.touch,
        place,
        newtons,
        action,
        row,
    })
}

fn micros(seconds: f64) -> u64 {
    (seconds * 1e6) as u64
}
