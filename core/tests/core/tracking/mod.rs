//! Contacts over time: who stays who, how fast they are, and whether they slip.

mod filters;
mod identity;
mod impulses;
mod rig;
mod slip;
mod speed;
