//! Reports of a board, as standard messages. `board` is its name among those of a robot; empty if it is alone.

use super::cdr::Cdr;
use super::names::frame;
use crate::body::{DVec3, Pose, Surface};
use crate::client::is_simulated;
use std::collections::BTreeMap;
use taxel_core::garment::{Area, Layout};
use taxel_core::wire::Health;

/// `PointField.FLOAT32`
const FLOAT32: u8 = 7;
/// Space between the panels of a link, m.
const GAP: f64 = 0.02;
/// Parent frame of panels without a link.
const NO_LINK: &str = "garment";
/// Micrometres per metre.
const UM: f32 = 1e6;

/// A message that begins with `std_msgs/Header`.
fn head(host_us: u64, frame: &str) -> Cdr {
    Cdr::default().time(host_us).text(frame)
}

/// `tf2_msgs/msg/TFMessage`: the frame of each panel on its link: x along the columns, y along the rows, z into the
/// robot, as of a camera's image. A garment does not say how its panels lie on a link: those without a place on
/// `surface` are side by side along x.
pub fn frames(board: &str, host_us: u64, layout: &Layout, surface: Option<&Surface>) -> Vec<u8> {
    let mut taken: BTreeMap<&str, f64> = BTreeMap::new();
    let areas = layout.areas();
    let mut cdr = Cdr::default().u32(areas.len() as u32);
    for (panel, area) in (0..).zip(areas) {
        let placed = surface.and_then(|surface| {
            let (link, pose) = surface.panel_frame(layout, panel)?;
            Some((surface.links().get(link)?.as_str(), pose))
        });
        let (link, Pose { at, turn }) = placed.unwrap_or_else(|| {
            let link = if area.link.is_empty() { NO_LINK } else { area.link.as_str() };
            let x = taken.entry(link).or_default();
            let pose = Pose { at: DVec3::new(*x, 0.0, 0.0), ..Pose::IDENTITY };
            *x += f64::from(area.columns) * f64::from(area.pitch_um[0]) / f64::from(UM) + GAP;
            (link, pose)
        });
        cdr =
            cdr.time(host_us).text(link).text(&frame(board, area)).f64s(at.to_array()).f64s(turn.to_array());
    }
    cdr.finish()
}

/// `sensor_msgs/msg/Image`: 16 bits per taxel, counts.
pub fn image(board: &str, host_us: u64, area: &Area, values: &[u16]) -> Vec<u8> {
    let data: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
    head(host_us, &frame(board, area))
        .u32(area.rows.into())
        .u32(area.columns.into())
        .text("mono16")
        .u8(0)
        .u32(2 * u32::from(area.columns))
        .data(&data)
        .finish()
}

/// `sensor_msgs/msg/PointCloud2`: one point per taxel, x and y in metres from the panel's first taxel,
/// pressure in counts.
pub fn points(board: &str, host_us: u64, area: &Area, values: &[u16]) -> Vec<u8> {
    let [x_um, y_um] = area.pitch_um.map(|um| um as f32);
    let columns = usize::from(area.columns).max(1);
    let point = |(index, value): (usize, &u16)| {
        let (row, column) = ((index / columns) as f32, (index % columns) as f32);
        [column * x_um / UM, row * y_um / UM, 0.0, f32::from(*value)]
    };
    let points: Vec<[f32; 4]> = values.iter().enumerate().map(point).collect();
    cloud((host_us, &frame(board, area)), area, ["x", "y", "z", "pressure"], &points)
}

/// `sensor_msgs/msg/PointCloud2` of a panel at a time, us, in a frame: a point for each taxel, whose numbers
/// have these names.
pub(super) fn cloud<const N: usize>(
    (us, frame): (u64, &str),
    area: &Area,
    fields: [&str; N],
    points: &[[f32; N]],
) -> Vec<u8> {
    let data: Vec<u8> = points.iter().flatten().flat_map(|number| number.to_le_bytes()).collect();
    let is_dense = points.iter().flatten().all(|number| number.is_finite());
    let mut cdr = head(us, frame).u32(area.rows.into()).u32(area.columns.into()).u32(N as u32);
    for (name, number) in fields.into_iter().zip(0u32..) {
        cdr = cdr.text(name).u32(4 * number).u8(FLOAT32).u32(1);
    }
    let size = 4 * N as u32;
    cdr.u8(0).u32(size).u32(size * u32::from(area.columns)).data(&data).u8(is_dense.into()).finish()
}

/// `geometry_msgs/msg/WrenchStamped` of a panel that is pressed with these counts: the force, N, along z, into the
/// robot, and its moment about the panel's first taxel, N m; NaN if the pitch is unknown.
pub fn wrench(board: &str, host_us: u64, area: &Area, values: &[u16], per_newton: f64) -> Vec<u8> {
    let columns = usize::from(area.columns).max(1);
    let mut sums = [0u64; 3];
    for (index, value) in values.iter().enumerate() {
        let value = u64::from(*value);
        sums[0] += value;
        sums[1] += value * (index % columns) as u64;
        sums[2] += value * (index / columns) as u64;
    }
    let [force, by_columns, by_rows] = sums.map(|sum| sum as f64 / per_newton);
    let is_known = !area.pitch_um.contains(&0);
    let [x, y] = area.pitch_um.map(|um| if is_known { f64::from(um) / f64::from(UM) } else { f64::NAN });
    // A component of 0 has no sign.
    head(host_us, &frame(board, area))
        .f64s([0.0, 0.0, force, by_rows * y, 0.0 - by_columns * x, 0.0])
        .finish()
}

/// Level of a status that is not renewed.
const STALE: u8 = 3;

/// State of a board, as its diagnostics report it.
#[derive(Debug, Clone, Copy)]
pub enum DiagnosticState<'a> {
    /// Counters, and number of faulty taxels. A warning if anything was lost or failed.
    Reports(&'a Health, usize),
    /// Lost source, and why: stale.
    Lost(&'a str),
}

/// `diagnostic_msgs/msg/DiagnosticArray` of a board with this firmware; a simulated one says that it is.
pub fn diagnostics(board: &str, host_us: u64, firmware: &str, state: DiagnosticState<'_>) -> Vec<u8> {
    let mut values = Vec::new();
    let (level, said) = match state {
        DiagnosticState::Reports(health, faulty) => {
            let bad = health.failed + health.overruns + health.lost > 0 || faulty > 0;
            values.extend([
                ("scans", u64::from(health.scans)),
                ("failed", health.failed.into()),
                ("overruns", health.overruns.into()),
                ("thinned_frames", health.thinned_frames.into()),
                ("thinned_contacts", health.thinned_contacts.into()),
                ("lost", health.lost.into()),
                ("refused", health.refused.into()),
                ("scan_us", health.scan_us.into()),
                ("process_us", health.process_us.into()),
                ("faulty_taxels", faulty as u64),
            ]);
            (u8::from(bad), if bad { "scans, messages or taxels are missing" } else { "all is well" })
        }
        DiagnosticState::Lost(why) => (STALE, why),
    };
    let simulated = if is_simulated(firmware) { "simulated: " } else { "" };
    let name = format!("taxel: {}", if board.is_empty() { "board" } else { board });
    let status =
        head(host_us, "").u32(1).u8(level).text(&name).text(&format!("{simulated}{said}")).text(firmware);
    status.list(&values, |cdr, (key, value)| cdr.text(key).text(&value.to_string())).finish()
}

/// `std_msgs/msg/String`
pub fn text(text: &str) -> Vec<u8> {
    Cdr::default().text(text).finish()
}

/// `rosgraph_msgs/msg/Clock`
pub fn clock(us: u64) -> Vec<u8> {
    Cdr::default().time(us).finish()
}

/// `sensor_msgs/msg/JointState` with a stamp of seconds and nanoseconds: positions alone, rad.
pub fn joints((sec, nanosec): (i32, u32), names: &[&str], positions: &[f64]) -> Vec<u8> {
    let named = Cdr::default().i32(sec).u32(nanosec).text("").list(names, |cdr, name| cdr.text(name));
    named.list(positions, |cdr, position| cdr.f64(*position)).u32(0).u32(0).finish()
}

#[cfg(test)]
mod tests {
    use super::*;
    use taxel_core::garment::Garment;

    /// True if a message holds this text: its length, its letters, 0.
    fn names(message: &[u8], text: &str) -> bool {
        let text = [&(text.len() as u32 + 1).to_le_bytes()[..], text.as_bytes(), &[0]].concat();
        message.windows(text.len()).any(|window| window == text)
    }

    #[test]
    fn panels_of_the_boards_of_a_robot_have_frames_of_their_own() {
        let layout = Layout::build(&Garment::reference(), 2048, 4095).unwrap();
        let area = &layout.areas()[2];
        assert_eq!(
            [frame("", area), frame("torso-2", area)],
            ["tactile/left_arm", "tactile/torso_2/left_arm"].map(String::from)
        );
        assert!(names(&frames("hand", 5, &layout, None), "tactile/hand/left_arm"));
    }

    #[test]
    fn panels_of_one_link_lie_apart() {
        let layout = Layout::build(&Garment::reference(), 2048, 4095).unwrap();
        let areas = layout.areas();
        assert_eq!(areas[0].link, areas[1].link, "chest and back are on the torso");
        let reported = frames("", 5, &layout, None);
        let mut places = Vec::new();
        for area in areas {
            let own = frame("", area);
            assert!(names(&reported, &own) && names(&reported, &area.link), "{own}");
            let values = vec![1; usize::from(area.rows) * usize::from(area.columns)];
            for message in
                [image("", 5, area, &values), points("", 5, area, &values), wrench("", 5, area, &values, 1.0)]
            {
                assert!(names(&message, &own), "{own}");
            }
            // The position follows the name, aligned to 8 bytes from behind the header of 4.
            let at = reported.windows(own.len()).position(|window| window == own.as_bytes()).unwrap()
                + own.len()
                + 1;
            let at = 4 + (at - 4).next_multiple_of(8);
            let x = f64::from_le_bytes(reported[at..at + 8].try_into().unwrap());
            let width = f64::from(area.columns) * f64::from(area.pitch_um[0]) / 1e6;
            places.push((area.link.clone(), x, x + width));
        }
        for (index, (link, start, _)) in places.iter().enumerate() {
            let before = places[..index].iter().filter(|(other, ..)| other == link);
            assert!(before.clone().all(|(_, _, end)| start >= end), "{places:?}");
        }
    }
}
