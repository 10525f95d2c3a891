//! Time limit of the watchdog.

use embassy_time::Duration;
use taxel_core::acquire::WATCHDOG_MS;

/// Time without a round of the loop after which the board restarts. The core refuses garments and scenes
/// whose frames take nearly as long.
pub const WATCHDOG: Duration = Duration::from_millis(WATCHDOG_MS as u64);
