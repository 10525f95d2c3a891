//! Contacts that are hard to get right, each with its exact answer: nothing, everything, spirals, seams, more
//! than fit.

mod capacity;
mod flood;
mod forms;
mod gaps;
mod layouts;
mod rig;
mod seams;
mod sewn;
mod symmetry;
mod thresholds;
mod tracks;
mod turns;
mod words;
