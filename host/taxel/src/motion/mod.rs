//! From touch to motion: velocities of a robot's joints, and the speed of its own motion, from what touches it.
//!
//! Pure functions of robot, posture, contacts, meaning and time. Nothing here waits, reads a clock, or does I/O. It is
//! no safety function: `docs/guides/motion.md`.
//!
//! | file | holds |
//! |---|---|
//! | `config.rs` | [`BehaviourConfig`]: a behaviour as its author writes it |
//! | `limits.rs` | [`JointLimit`]: position, velocity and acceleration of a joint |
//! | `apart.rs` | links that are kept apart |
//! | `file.rs` | [`Behaviour`]: read, and checked against a robot |
//! | `input.rs` | [`MotionInput`]: what is known at a cycle |
//! | `guard.rs` | [`MotionFault`]: reasons for which nothing may be commanded |
//! | `known.rs` | touches that are present or have just ended, and what is done about each |
//! | `spot.rs` | places of the surface in a posture |
//! | `clamp.rs` | touches that oppose each other |
//! | `yielding.rs` | links that are led by hand |
//! | `solve.rs` | damped least squares within bounds |
//! | `tank.rs` | energy that commands may give |
//! | `command.rs` | [`MotionCommand`]: what is commanded, and why |
//! | `line.rs` | a command as JSON and in words |
//! | `state.rs` | [`MotionState`]: what is remembered |
//! | `control.rs` | [`MotionControl`]: a cycle |
//! | `feed.rs` | [`MotionFeed`]: what boards, joints and mind say, as the input of a cycle |
//!
//! Priorities: fault, clamped, `stop`, `retreat`, `yield`, `slow`, and the robot's own motion. What stops the robot
//! stops it at once; a retreat goes before a hand that leads, which moves only what the retreat leaves free.
//!
//! ```
//! use std::sync::Arc;
//! use taxel::body::{DVec3, robot};
//! use taxel::mind::{BodyPlace, Mover};
//! use taxel::motion::{Behaviour, MotionBoard, MotionControl, MotionInput, MotionPosture, MotionTouch};
//! use taxel_core::intent::Leading;
//!
//! let robot = Arc::new(robot::read("reference")?);
//! let control = MotionControl::new(robot.clone(), Behaviour::read("people", &robot)?);
//! let mut state = control.start();
//! let forearm = BodyPlace { region: "left forearm".into(), link: "left_forearm".into() };
//! let pressed = [MotionTouch {
//!     touch: 1,
//!     link: robot.link("left_forearm")?,
//!     place: Arc::new(forearm),
//!     at: DVec3::new(0.03, 0.0, -0.1),
//!     normal: DVec3::X,
//!     newtons: 45.0,
//!     mover: Mover::Other,
//! }];
//! let positions = robot.posture([("left_elbow", 1.0)])?;
//! for cycle in 0..20u64 {
//!     let now_us = 5000 * cycle;
//!     let input = MotionInput {
//!         now_us,
//!         posture: Some(MotionPosture { at_us: now_us, positions: &positions }),
//!         boards: &[MotionBoard { scanned_us: Some(now_us), period_us: 5120, is_calibrated: true, begun: 1 }],
//!         touches: &pressed,
//!         leading: Leading::None,
//!     };
//!     if cycle == 10 {
//!         control.arm(&mut state, &input).unwrap();
//!     }
//!     // It begins disarmed, and stands still until it is armed.
//!     let command = control.step(&mut state, &input);
//!     assert_eq!(command.moves(), cycle > 10);
//! }
//! # Ok::<(), taxel::Error>(())
//! ```

mod apart;
mod clamp;
mod command;
mod config;
mod control;
mod feed;
mod file;
mod guard;
mod input;
mod known;
mod limits;
mod line;
mod solve;
mod spot;
mod state;
mod tank;
mod yielding;

pub use command::{MotionCause, MotionCommand, MotionDeed, MotionPhase};
pub use config::{
    ApartConfig, BehaviourConfig, ClampConfig, FaultConfig, ForceLimitConfig, JointConfig, JointLimitConfig,
    ResumeConfig, RetreatConfig, TouchAction, WhenConfig, YieldConfig,
};
pub use control::MotionControl;
pub use feed::{MotionFeed, MotionNews};
pub use file::Behaviour;
pub use guard::MotionFault;
pub use input::{MotionBoard, MotionInput, MotionPosture, MotionTouch};
pub use limits::JointLimit;
pub use line::MOTION;
pub use state::MotionState;
