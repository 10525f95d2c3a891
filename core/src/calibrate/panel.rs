//! Input and output of the calibration of a panel.

use crate::format::Code;

/// Values of the taxels of a panel.
pub(crate) struct PanelCodes<'a> {
    pub codes: &'a [Code],
    pub limit: &'a [u16],
    pub rest: &'a [u16],
    pub gain: &'a [u16],
    pub out: &'a mut [u16],
}
