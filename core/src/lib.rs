//! `taxel-core`: everything between the converter's codes and the meaning of a touch.
//!
//! The modules in the order of the data: [`garment`] (layout, wiring), [`acquire`] (multiplexer scan),
//! [`reflex`] (check of a sub-field), [`selftest`] (of lines and inputs), [`health`] (of every taxel),
//! [`condition`] (baseline, calibration, filter), [`fold`] (posture), [`contact`] (segments, moments,
//! tracks), [`gesture`] (touch over time), [`shape`] (NMI, k-NN), [`body`] (place on the robot), [`unsure`]
//! (what may be drift), [`symbol`] (words), [`intent`] (fuzzy cognitive map), [`react`] (reflexes), [`scene`]
//! (all their settings), [`pipeline`] (their composition), [`boot`] (what resets leave), [`wire`] (messages,
//! frames), [`board`] (a function of what happened) and [`mod@run`] (the loop around it).
//! [`format`](mod@format) is the table of number formats.
#![no_std]
#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod format;

pub mod garment;

pub mod acquire;

pub mod reflex;

pub mod selftest;

pub mod health;

pub mod condition;

pub mod fold;

pub mod contact;

pub mod gesture;

pub mod shape;

pub mod body;

pub mod unsure;

pub mod symbol;

pub mod intent;

pub mod react;

pub mod scene;

pub mod pipeline;

pub mod boot;

pub mod wire;

pub mod board;

pub mod run;
