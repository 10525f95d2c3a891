//! Meaning of touches to the robot as a message of ROS 2.

use super::line::{RobotMeaningLine, RobotTouchLine};
use super::mover::{Approach, Mover};
use super::probe::Probe;
use crate::robot::ReadRobot;
use crate::ros2::Cdr;

/// Millimetres per metre.
const MM: f64 = 1000.0;

/// `taxel_msgs/msg/RobotIntent`: what the line says, in the units of ROS.
pub fn robot_intent_message(robot: &ReadRobot, line: &RobotMeaningLine) -> Vec<u8> {
    let names: Vec<&String> = line.concepts.keys().collect();
    let activations: Vec<f64> =
        line.concepts.values().map(|value| value.as_f64().unwrap_or(f64::NAN)).collect();
    Cdr::default()
        .time(line.host_time_us)
        .text("")
        .text(line.leading)
        .list(&line.holding, |cdr, name| cdr.text(name))
        .list(&names, |cdr, name| cdr.text(name))
        .list(&activations, |cdr, value| cdr.f64(*value))
        .list(&line.defaults, |cdr, name| cdr.text(name))
        .list(&line.touches, |cdr, line| touch(cdr, robot, line))
        .finish()
}

/// `taxel_msgs/msg/RobotTouch`
fn touch(cdr: Cdr, robot: &ReadRobot, line: &RobotTouchLine) -> Cdr {
    let mover = match line.mover {
        Mover::Own => 0,
        Mover::Other => 1,
        Mover::Unsure => 2,
    };
    let unknown = Approach { normal_m_s: f64::NAN, speed_m_s: f64::NAN };
    let approach = line.approach.unwrap_or(unknown);
    cdr.text(robot.boards.get(line.board).map_or("", |board| board.name.as_str()))
        .u32(line.contact)
        .text(&line.region)
        .text(&line.link)
        .u32(line.load)
        .u8(mover)
        .f64s([approach.normal_m_s, approach.speed_m_s])
        .f64s(line.probe.map_or([f64::NAN; 4], felt))
}

/// Hardness, point, slide and stir.
fn felt(probe: Probe) -> [f64; 4] {
    let Probe { hardness, point, slide, stir } = probe;
    [
        hardness.map_or(f64::NAN, |hardness| f64::from(hardness) * MM),
        f64::from(point) / 100.0,
        f64::from(slide) / MM,
        f64::from(stir) / 100.0,
    ]
}
