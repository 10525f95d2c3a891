//! Fit of a garment's panels to the touches, in words.

use serde_json::{Value, json};
use std::fmt::Write;
use taxel::body::fit::{BodyFit, FittedTouch, KnownTouch, PatchFit};

/// A paragraph for each panel, with a line for each touch.
pub fn table(fit: &BodyFit, touches: &[KnownTouch]) -> String {
    let mut text = String::new();
    for panel in &fit.panels {
        panel_text(&mut text, panel, touches);
    }
    for (panel, count) in &fit.few {
        let _ = writeln!(text, "{panel}: {count} of the 3 touches that it needs: it stays as it was");
    }
    text
}

fn panel_text(text: &mut String, fit: &PatchFit, touches: &[KnownTouch]) {
    let millimetres = fit.shift_sd.map(|sd| sd * 1e3);
    let _ = writeln!(
        text,
        "{}: {:.1} mm to the right (sd {:.1}), {:.1} mm down (sd {:.1}), {}",
        fit.panel,
        fit.offset.right * 1e3,
        millimetres[0],
        fit.offset.down * 1e3,
        millimetres[1],
        match fit.turn_sd {
            Some(sd) => format!("turned by {:.2} degrees (sd {sd:.2})", fit.offset.turn),
            None => format!(
                "turned by {:.2} degrees as before: the touches are too near each other to say",
                fit.offset.turn
            ),
        }
    );
    let (kept, all) = (fit.kept().count(), fit.touches.len());
    let _ = writeln!(
        text,
        "  {kept} of {all} touches, {:.1} mm rms, {:.1} mm above the surface",
        fit.rms() * 1e3,
        fit.height() * 1e3
    );
    for touch in &fit.touches {
        let known = &touches[touch.number];
        let _ = writeln!(
            text,
            "  touch {:>3}  {} {:.3} {:.3} {:.3}  {}",
            touch.number + 1,
            known.link,
            known.x,
            known.y,
            known.z,
            touch_text(touch)
        );
    }
    let distance = |touch: &&FittedTouch| touch.distance().unwrap_or(0.0);
    if let Some(worst) = fit.kept().max_by(|a, b| distance(a).total_cmp(&distance(b))) {
        let _ = writeln!(text, "  worst: touch {}, {:.1} mm", worst.number + 1, distance(&worst) * 1e3);
    }
}

fn touch_text(touch: &FittedTouch) -> String {
    match (touch.off, touch.is_kept) {
        (Some([right, down]), is_kept) => {
            let left_out = if is_kept { "" } else { ", left out" };
            format!(
                "off by {:.1} mm: {:.1} right, {:.1} down{left_out}",
                right.hypot(down) * 1e3,
                right * 1e3,
                down * 1e3
            )
        }
        (None, _) => "not on this panel, left out".into(),
    }
}

/// An object with all numbers, in metres and degrees.
pub fn json(fit: &BodyFit) -> String {
    let touch = |touch: &FittedTouch| json!({ "number": touch.number + 1, "off": touch.off, "height": touch.height, "kept": touch.is_kept });
    let panel = |fit: &PatchFit| {
        json!({
            "panel": fit.panel, "offset": fit.offset, "shift_sd": fit.shift_sd, "turn_sd": fit.turn_sd, "rms": fit.rms(),
            "height": fit.height(), "touches": fit.touches.iter().map(touch).collect::<Value>(),
        })
    };
    let few = |(panel, touches): &(String, usize)| json!({ "panel": panel, "touches": touches });
    let panels: Value = fit.panels.iter().map(panel).collect();
    let few: Value = fit.few.iter().map(few).collect();
    format!("{}\n", json!({ "panels": panels, "few": few }))
}
