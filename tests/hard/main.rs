//! Contacts that are hard to get right, each with its exact answer: nothing, everything, spirals, seams, more than fit.

mod capacity;
mod flood;
mod forms;
mod rig;
mod seams;
mod symmetry;
mod tracks;
