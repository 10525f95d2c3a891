//! Scripts of touches.

use taxel::files::scripts;
use taxel::sim::Script;
use taxel_core::garment::{Garment, Panel};

/// Various touches in various places, in sequence and at the same time.
pub fn varied(seconds: f64, seed: u64) -> Script {
    let mut rng = fastrand::Rng::with_seed(seed);
    let mut text = format!("duration_s = {seconds}\nseed = {seed}\n");
    let mut start = 0.2;
    while start < seconds {
        let panel = rng.choice(Garment::reference().panels).unwrap().name;
        let shape = rng.choice(["box", "ball", "finger"]).unwrap();
        let mut within = |low: f64, high: f64| low + rng.f64() * (high - low);
        let size = match shape {
            "box" => format!("[{:.0}, {:.0}]", within(20.0, 180.0), within(20.0, 200.0)),
            "ball" => format!("{:.0}", within(30.0, 120.0)),
            _ => format!("{:.0}", within(12.0, 20.0)),
        };
        text += &format!(
            "[[touch]]\npanel = \"{panel}\"\nshape = \"{shape}\"\nsize_mm = {size}\nat = [{:.1}, {:.1}]\n\
             velocity = [{:.1}, {:.1}]\nforce_n = {:.1}\nstart_s = {start:.3}\nrise_s = {:.3}\nhold_s = {:.3}\n\
             fall_s = {:.3}\n",
            within(0.0, 15.0),
            within(0.0, 31.0),
            within(-20.0, 20.0),
            within(-40.0, 40.0),
            within(1.0, 80.0),
            within(0.01, 0.4),
            within(0.0, 2.0),
            within(0.01, 0.4),
        );
        start += within(0.05, 1.0);
    }
    scripts::parse(&text, "varied.toml").unwrap()
}

/// A flat object presses every panel from this time on, with 1.2 N on each taxel.
pub fn all_pressed(start_s: f64) -> Script {
    let touch = |panel: &Panel| {
        let pitch = panel.pitch_um.map(|pitch| f64::from(pitch) / 1e3);
        let (columns, rows) = (f64::from(panel.columns), f64::from(panel.rows));
        format!(
            "[[touch]]\npanel = \"{}\"\nshape = \"box\"\nsize_mm = [{:.1}, {:.1}]\nat = [{:.1}, {:.1}]\n\
             force_n = 600\nstart_s = {start_s:.4}\nrise_s = 0.05\nhold_s = 5\n",
            panel.name,
            (columns + 2.0) * pitch[0],
            (rows + 2.0) * pitch[1],
            (columns - 1.0) / 2.0,
            (rows - 1.0) / 2.0,
        )
    };
    let touches: String = Garment::reference().panels.iter().map(touch).collect();
    scripts::parse(&format!("duration_s = 9\nseed = 3\n{touches}"), "pressed.toml").unwrap()
}
