//! Parts of the board that reports describe.

use crate::board::info::BoardInfo;
use crate::board::setup::Setup;
use crate::body::Placed;
use crate::boot::Boot;
use crate::condition::{Certificate, Image};
use crate::health::Monitor;
use crate::pipeline::CONTACTS;
use crate::shape::Taught;
use crate::unsure::UnsureState;
use crate::wire::SelfTestReport;

/// Parts of the board that reports describe.
#[derive(Clone, Copy)]
pub(crate) struct About<'a> {
    pub info: &'a BoardInfo,
    /// Start of the board.
    pub boot: Option<Boot>,
    pub setup: &'a Setup,
    pub monitor: &'a Monitor,
    /// The last self-test of lines and inputs.
    pub examined: Option<&'a SelfTestReport>,
    /// The calibration in force.
    pub certificate: Option<&'a Certificate>,
    /// Present contacts of the last frame.
    pub present: &'a [Placed],
    /// Age of their forms, frames, in the same order.
    pub form_ages: &'a [u8],
    /// Contacts that may be drift.
    pub unsure: &'a UnsureState<CONTACTS>,
    /// Taught shapes.
    pub taught: &'a Taught<CONTACTS>,
    /// The last conditioned image.
    pub image: &'a Image<'a>,
}
