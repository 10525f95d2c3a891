//! The robot's contacts as a message of ROS 2.

use super::contact::RobotContact;
use super::contacts_line::{RobotContactLine, RobotContactPartLine, RobotContactsLine};
use super::file::ReadRobot;
use crate::ros2::Cdr;
use taxel_core::contact::Phase;

/// Millimetres per metre.
const MM: f64 = 1000.0;

/// `taxel_msgs/msg/RobotContacts` at a host time, us: what [`RobotContactsLine`] says, in the units of ROS.
pub fn robot_contacts_message(robot: &ReadRobot, host_us: u64, contacts: &[RobotContact]) -> Vec<u8> {
    let line = RobotContactsLine::of(robot, host_us, contacts);
    Cdr::default().time(line.host_time_us).text("").list(&line.contacts, contact).finish()
}

/// `taxel_msgs/msg/RobotContact`
fn contact(cdr: Cdr, contact: &RobotContactLine<'_>) -> Cdr {
    let phase = match contact.phase {
        Phase::Onset => 0,
        Phase::Held => 1,
        Phase::Released => 2,
    };
    cdr.u32(contact.id)
        .u8(phase)
        .text(contact.board)
        .text(contact.panel_name)
        .f64s([contact.x_mm / MM, contact.y_mm / MM, 0.0])
        .f64(contact.force_n.unwrap_or(f64::NAN))
        .u32(contact.total)
        .u16(contact.peak)
        .u32(contact.area)
        .f64s([contact.x, contact.y])
        .f64(contact.duration)
        .f64(contact.age_us as f64 / 1e6)
        .list(&contact.parts, part)
}

/// `taxel_msgs/msg/RobotContactPart`
fn part(cdr: Cdr, part: &RobotContactPartLine<'_>) -> Cdr {
    cdr.text(part.board)
        .u8(part.contact.is_some().into())
        .u32(part.contact.unwrap_or(0))
        .u32(part.total)
        .f64(part.age_us as f64 / 1e6)
}
