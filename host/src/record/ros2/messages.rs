//! The messages as bytes.

use super::cdr::Cdr;
use taxel_core::garment::Area;
use taxel_core::wire::Health;

/// `PointField.FLOAT32`
const FLOAT32: u8 = 7;
/// Bytes of a point: x, y, z, pressure.
const POINT: u32 = 16;
/// Micrometres of a metre.
const UM: f32 = 1e6;

/// The header: when, and in which frame.
fn head(host_us: u64, frame: &str) -> Cdr {
    Cdr::default().i32((host_us / 1_000_000) as i32).u32((host_us % 1_000_000) as u32 * 1000).text(frame)
}

/// `sensor_msgs/msg/Image`: 16 bits a taxel, counts.
pub fn image(host_us: u64, area: &Area, values: &[u16]) -> Vec<u8> {
    let data: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
    head(host_us, &area.link)
        .u32(area.rows.into())
        .u32(area.columns.into())
        .text("mono16")
        .u8(0)
        .u32(2 * u32::from(area.columns))
        .data(&data)
        .finish()
}

/// `sensor_msgs/msg/PointCloud2`: a point a taxel, x and y in metres from the panel's first, and its pressure in counts.
pub fn points(host_us: u64, area: &Area, values: &[u16]) -> Vec<u8> {
    let [x_um, y_um] = area.pitch_um.map(|um| um as f32);
    let columns = usize::from(area.columns).max(1);
    let point = |(index, value): (usize, &u16)| {
        let (row, column) = ((index / columns) as f32, (index % columns) as f32);
        [column * x_um / UM, row * y_um / UM, 0.0, f32::from(*value)]
    };
    let data: Vec<u8> = values.iter().enumerate().flat_map(point).flat_map(f32::to_le_bytes).collect();
    let mut cdr = head(host_us, &area.link).u32(area.rows.into()).u32(area.columns.into()).u32(4);
    for (name, offset) in [("x", 0), ("y", 4), ("z", 8), ("pressure", 12)] {
        cdr = cdr.text(name).u32(offset).u8(FLOAT32).u32(1);
    }
    cdr.u8(0).u32(POINT).u32(POINT * u32::from(area.columns)).data(&data).u8(1).finish()
}

/// `geometry_msgs/msg/WrenchStamped`: a force along z, N. Pressure pushes into the panel, against its normal.
pub fn wrench(host_us: u64, area: &Area, newtons: f64) -> Vec<u8> {
    let mut cdr = head(host_us, &area.link);
    for value in [0.0, 0.0, 0.0 - newtons, 0.0, 0.0, 0.0] {
        cdr = cdr.f64(value);
    }
    cdr.finish()
}

/// `diagnostic_msgs/msg/DiagnosticArray`: the counters of a board; a warning where something was lost or failed.
pub fn diagnostics(host_us: u64, board: &str, health: &Health, ill: usize) -> Vec<u8> {
    let bad = health.failed + health.overruns + health.lost > 0 || ill > 0;
    let said = if bad { "scans, messages or taxels are missing" } else { "all is well" };
    let values = [
        ("scans", u64::from(health.scans)),
        ("failed", health.failed.into()),
        ("overruns", health.overruns.into()),
        ("thinned_frames", health.thinned_frames.into()),
        ("thinned_contacts", health.thinned_contacts.into()),
        ("lost", health.lost.into()),
        ("refused", health.refused.into()),
        ("scan_us", health.scan_us.into()),
        ("process_us", health.process_us.into()),
        ("ill_taxels", ill as u64),
    ];
    let mut cdr = head(host_us, "").u32(1).u8(bad.into()).text("taxel: board").text(said).text(board);
    cdr = cdr.u32(values.len() as u32);
    for (key, value) in values {
        cdr = cdr.text(key).text(&value.to_string());
    }
    cdr.finish()
}
