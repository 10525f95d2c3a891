#![doc = include_str!("../README.md")]
//!
//! ## Modules
//!
//! The modules in the order of the data: [`garment`] (layout, wiring), [`acquire`] (multiplexer scan),
//! [`reflex`] (check of raw codes within a frame), [`selftest`] (select lines, converter inputs), [`health`]
//! (faulty taxels), [`fold`] (posture, what the garment's folds press), [`condition`] (baseline, calibration,
//! filter), [`contact`] (segments, moments, tracks), [`gesture`] (touch over time), [`shape`] (NMI, k-NN),
//! [`body`] (region of a contact), [`unsure`] (contacts that may be drift), [`symbol`] (words), [`surface`]
//! (place and force on the robot, and what its regions feel), [`intent`] (fuzzy cognitive map), [`react`]
//! (reactions), [`scene`] (settings of all stages), [`pipeline`] (composition of the stages), [`boot`] (causes
//! of restarts), [`wire`] (messages, frames), [`board`] (the device as a function of its inputs) and
//! [`mod@run`] (the loop around it).
//! [`format`](mod@format) is the table of number formats, [`capacity`] the sizes of the board that ships.
//!
//! Two stages compose folders, private to the crate: `image`, `calibrate`, `baseline` and
//! `filter` make up [`condition`]; `segment`, `measure` and `track` make up [`contact`].
//!
//! `// M0+: out of line` explains an `#[inline(never)]`: on the Cortex-M0+ only eight registers are cheap to
//! reach. A hot loop is therefore a function of its own, out of line, so that it gets all of them. The choice
//! follows the cycles of the emulated image.
#![no_std]
#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod format;

pub mod capacity;

pub mod garment;

pub mod reflex;

pub mod acquire;

pub mod selftest;

pub mod health;

pub mod fold;

mod image;

mod calibrate;

mod baseline;

mod filter;

pub mod condition;

mod segment;

mod measure;

mod track;

pub mod contact;

pub mod gesture;

pub mod shape;

pub mod body;

pub mod unsure;

pub mod symbol;

pub mod surface;

pub mod intent;

pub mod react;

pub mod scene;

pub mod pipeline;

pub mod boot;

pub mod wire;

pub mod board;

pub mod run;

// Of a build that leaves nothing out.
#[cfg(all(
    any(test, target_arch = "arm"),
    feature = "folds",
    feature = "gallery",
    feature = "gesture",
    feature = "intent"
))]
mod memory;
