//! Drift is tracked and touches are kept: the limits of docs/evidence/drift.md, on various garments and at all rates.

mod chart;
mod held;
mod hours;
mod idle;
mod limits;
mod rig;

fn is_campaign() -> bool {
    std::env::var_os("TAXEL_CAMPAIGN").is_some()
}
