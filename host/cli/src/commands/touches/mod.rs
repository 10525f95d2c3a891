//! `taxel gestures` and `taxel intent`: train and evaluate models of touches.

pub mod gestures;
pub mod intent;
pub mod task;
