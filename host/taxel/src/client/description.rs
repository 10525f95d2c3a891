//! Contents of a board's `Hello`.

use super::cleaned;
use crate::text::words::printable;
use std::cmp::Ordering;
use taxel_core::boot::Boot;
use taxel_core::format::{Micros, Name};
use taxel_core::garment::{Garment, Layout};
use taxel_core::pipeline::Pipeline;
use taxel_core::scene::Scene;
use taxel_core::wire::{Hello, MAGIC, PROTOCOL, decode};

/// Name of the firmware of simulated boards.
pub const SIMULATED: &str = concat!("taxel-sim ", env!("CARGO_PKG_VERSION"));

/// True if this firmware is that of a simulated board, of any version.
pub fn is_simulated(firmware: &str) -> bool {
    firmware.split(' ').next() == SIMULATED.split(' ').next()
}

/// Garment, scene and firmware of a board.
#[derive(Debug, Clone, PartialEq)]
pub struct BoardDescription {
    /// Name and version of the firmware.
    pub firmware: String,
    /// Unique id of the board's chip; empty if it has none, as a simulated board.
    pub chip: String,
    /// The garment.
    pub garment: Garment,
    /// Geometry of the garment.
    pub layout: Layout,
    /// The scene.
    pub scene: Scene,
    /// Id, date and fit error of the calibration in use; empty if pressure is in counts.
    pub calibration: String,
    /// The board's time of the `Hello`.
    pub clock: Micros,
    /// Cause of the board's start; none if it does not know.
    pub boot: Option<Boot>,
}

impl BoardDescription {
    /// True if the board is simulated, by the name of its firmware: also over a network, and in a recording.
    pub fn is_simulated(&self) -> bool {
        is_simulated(&self.firmware)
    }

    /// Names of the concepts of the scene's map.
    pub fn concepts(&self) -> &[Name] {
        self.scene.intent.as_ref().map_or(&[], |intent| intent.map.concepts.as_slice())
    }

    /// Says why a board of this protocol is not understood.
    pub(super) fn speaks(protocol: u16) -> Result<(), String> {
        let how = match protocol.cmp(&PROTOCOL) {
            Ordering::Equal => return Ok(()),
            Ordering::Less => "flash the firmware of this version (`taxel flash`)",
            Ordering::Greater => "update this program",
        };
        Err(format!("the board speaks protocol {protocol}, this program {PROTOCOL}: {how}"))
    }

    /// Decodes a `Hello`, or says why not.
    pub fn read(hello: &Hello<'_>) -> Result<BoardDescription, String> {
        if hello.magic != MAGIC {
            return Err("the Hello of something that is not a taxel board".into());
        }
        BoardDescription::speaks(hello.protocol)?;
        let text = |bytes: &[u8]| printable(&String::from_utf8_lossy(bytes)).into_owned();
        let mut garment: Garment = decode(hello.garment).map_err(|e| format!("garment in Hello: {e}"))?;
        cleaned::garment(&mut garment);
        // Exactness depends on the board's full scale, which the board has checked.
        let layout = Layout::build(&garment, usize::from(u16::MAX), 1)
            .map_err(|e| format!("garment {} in Hello: {e}", garment.name))?;
        let mut scene: Scene = decode(hello.scene).map_err(|e| format!("scene in Hello: {e}"))?;
        cleaned::scene(&mut scene);
        // The board has checked its scene like this; the display relies on it.
        Pipeline::build(&scene, &layout).map_err(|e| format!("scene in Hello: {e}"))?;
        Ok(BoardDescription {
            firmware: text(hello.firmware),
            chip: text(hello.chip),
            layout,
            scene,
            calibration: text(hello.calibration),
            boot: hello.boot,
            clock: decode(hello.clock).map_err(|e| format!("clock in Hello: {e}"))?,
            garment,
        })
    }
}
