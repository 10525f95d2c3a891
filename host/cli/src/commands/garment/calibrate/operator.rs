//! Simulates a user who puts weights on a garment.

use anyhow::{Context, Result};
use taxel::files::calibrate::Plate;
use taxel::files::scripts;
use taxel::sim::{Script, Sensor};
use taxel_core::garment::Layout;

/// Rest before the first weight, and between plates, s.
const REST_S: (f64, f64) = (40.0, 1.0);
/// Time to put a weight on or take it off, and time for which it stays, s.
const EACH_S: (f64, f64) = (0.3, 0.6);
/// Pitch of a simulated garment without one, um.
const PITCH_UM: u32 = 10_000;

/// A script in which each plate is loaded with all weights (N, ascending) and unloaded again.
pub fn script(
    garment: &str,
    layout: &Layout,
    plates: &[Plate],
    weights: &[f64],
    sensor: &Sensor,
    seed: u64,
) -> Result<Script> {
    let heaviest = weights.last().copied().unwrap_or(1.0);
    let parts: Vec<f64> = weights.iter().map(|weight| weight / heaviest).collect();
    let levels: Vec<f64> = parts.iter().chain(parts.iter().rev().skip(1)).copied().collect();
    let once_s = levels.len() as f64 * (EACH_S.0 + EACH_S.1) + EACH_S.0;
    let mut touches = toml::value::Array::new();
    for (index, plate) in plates.iter().enumerate() {
        let bounds = &plate.bounds;
        let area = layout.areas().get(usize::from(bounds.panel)).context("the garment has no such panel")?;
        let [px, py] = area.pitch_um.map(|um| f64::from(if um == 0 { PITCH_UM } else { um }) / 1000.0);
        let (wide, high) =
            (f64::from(bounds.right - bounds.left + 1), f64::from(bounds.bottom - bounds.top + 1));
        let centre = |low: u16, high: u16| f64::from(low + high) / 2.0;
        let touch = toml::toml! {
            shape = "plate"
            fall_s = 0.3
        };
        let mut touch = touch;
        touch.insert("panel".into(), area.name.as_str().into());
        touch.insert(
            "at".into(),
            pair([centre(bounds.left, bounds.right), centre(bounds.top, bounds.bottom)]),
        );
        touch.insert("size_mm".into(), pair([wide * px, high * py]));
        touch.insert("force_n".into(), heaviest.into());
        touch.insert("start_s".into(), (REST_S.0 + index as f64 * (once_s + REST_S.1)).into());
        touch.insert("rise_s".into(), EACH_S.0.into());
        touch.insert("hold_s".into(), EACH_S.1.into());
        touch.insert("levels".into(), toml::Value::try_from(&levels).context("the levels")?);
        touches.push(touch.into());
    }
    let mut text = toml::Table::new();
    text.insert("name".into(), "calibration".into());
    text.insert("duration_s".into(), (REST_S.0 + plates.len() as f64 * (once_s + REST_S.1)).into());
    text.insert("garment".into(), garment.into());
    text.insert("seed".into(), toml::Value::Integer((seed & 0xffff_ffff) as i64));
    text.insert("sensor".into(), toml::Value::try_from(sensor).context("the sensor")?);
    text.insert("touch".into(), touches.into());
    Ok(scripts::parse(&text.to_string(), "calibration.toml")?)
}

fn pair(values: [f64; 2]) -> toml::Value {
    toml::Value::Array(values.map(toml::Value::Float).into())
}
