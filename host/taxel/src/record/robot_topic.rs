//! Topics of a recording about the robot as a whole.

use crate::client::NS;
use crate::error::Result;
use crate::recording::{Format, Store, Writer};
use serde::Serialize;

/// A topic about the robot as a whole.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RobotTopic(u16);

impl RobotTopic {
    /// Declares `/taxel/NAME`, whose messages are JSON of this schema.
    pub(super) fn open<S: Store>(writer: &mut Writer<S>, name: &str, schema: &str) -> Result<RobotTopic> {
        let title = format!("taxel.{name}");
        let format = Format {
            encoding: "json",
            schema: &title,
            schema_encoding: "jsonschema",
            text: schema.as_bytes(),
        };
        Ok(RobotTopic(writer.channel(&format!("/taxel/{name}"), &format)?))
    }

    /// Writes a message at a host time, us.
    pub(super) fn write<S: Store>(
        self,
        writer: &mut Writer<S>,
        host_us: u64,
        line: &impl Serialize,
    ) -> Result<()> {
        let ns = host_us.saturating_mul(NS);
        writer.message(self.0, ns, ns, &serde_json::to_vec(line)?)
    }
}
