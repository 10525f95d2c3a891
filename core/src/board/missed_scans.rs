//! Counts missed frames: during work other than scanning, and when scans fail.

use super::Board;
use crate::acquire::ScanError;
use crate::format::Micros;

impl<const TAXELS: usize, const RUNS: usize, const PARTS: usize> Board<TAXELS, RUNS, PARTS> {
    /// Counts and logs a failed scan.
    #[cold]
    pub(super) fn stumbled(&mut self, error: ScanError) {
        self.scan_ended();
        self.health.failed = self.health.failed.wrapping_add(1);
        self.stumbles = self.stumbles.saturating_add(1);
        self.outbox.log(format_args!("scan: {error}"));
    }

    /// Called when the first scan after failures or an interruption began at `start`: counts the frames
    /// missed beside the failed ones, to the nearest scan.
    #[cold]
    pub(super) fn go_on(&mut self, start: Micros) {
        let failed = u64::from(core::mem::take(&mut self.stumbles)) * u64::from(self.health.scan_us);
        self.interrupted = false;
        let half = u64::from(self.health.scan_us) / 2;
        self.not_scanned((start.since(self.ledger.scanned()) + half).saturating_sub(failed));
    }

    /// Counts as overruns the scans that fit into `us` without a scan.
    pub(super) fn not_scanned(&mut self, us: u64) {
        if self.setup.scene.rate_hz == 0 {
            let missed = us.checked_div(self.health.scan_us.into()).unwrap_or(0).min(u32::MAX.into()) as u32;
            self.health.overruns = self.health.overruns.wrapping_add(missed);
        }
    }
}
