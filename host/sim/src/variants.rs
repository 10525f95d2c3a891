//! Seeded variants of a scene: other places, forces and speeds; and controls.

use super::footprint::reach_mm;
use super::pressure::pitch_mm;
use super::script::Script;
use super::touch::Touch;
use super::trace::Trace;
use fastrand::Rng;
use taxel_core::garment::{Area, Layout};

/// A variant: each touch is moved to a random place of its panel at which it stays on the panel, all panels
/// are exchanged by the same number of steps, all forces are scaled by one factor and all durations by
/// another, both uniform in 0.5 ..= 1.5. The seed also becomes the seed of the noise. `layout` is that of the
/// script's garment; without it the touches keep their places.
pub fn vary(script: &Script, layout: Option<&Layout>, seed: u64) -> Script {
    let mut rng = Rng::with_seed(seed);
    let factor = |rng: &mut Rng| 0.5 + rng.f64();
    let mut variant = scale_force(script, factor(&mut rng));
    variant = scale_rate(&variant, 1.0 / factor(&mut rng));
    variant.seed = seed;
    if let Some(layout) = layout {
        let step = rng.usize(..layout.areas().len().max(1));
        let next = |panel: &str| {
            let home = layout.areas().iter().position(|area| area.name == panel).unwrap_or(0);
            layout.areas().get((home + step) % layout.areas().len().max(1))
        };
        for touch in &mut variant.touches {
            let Some(area) = next(&touch.panel) else { continue };
            touch.panel = area.name.as_str().into();
            place(touch, area, [rng.f64(), rng.f64()]);
        }
        for trace in &mut variant.traces {
            let Some(area) = next(&trace.panel) else { continue };
            trace.panel = area.name.as_str().into();
            place_trace(trace, area, [rng.f64(), rng.f64()]);
        }
    }
    variant
}

/// The scene with all forces times `factor`: a control at 0.05 should have no meaning.
pub fn scale_force(script: &Script, factor: f64) -> Script {
    let mut scaled = script.clone();
    for touch in &mut scaled.touches {
        touch.force_n *= factor;
    }
    for [_, _, _, force] in scaled.traces.iter_mut().flat_map(|trace| &mut trace.path) {
        *force *= factor;
    }
    scaled
}

/// The scene `factor` (above 0) times as fast, from its first onset on: durations and times shrink, speeds
/// grow.
pub fn scale_rate(script: &Script, factor: f64) -> Script {
    let mut scaled = script.clone();
    let starts = script.touches.iter().map(|t| t.start_s).chain(script.joints.iter().map(|j| j.start_s));
    let starts = starts.chain(script.traces.iter().flat_map(|trace| &trace.path).map(|[t, ..]| *t));
    let first = starts.fold(f64::INFINITY, f64::min).min(script.duration_s);
    let later = |t: f64| first + (t - first) / factor;
    scaled.duration_s = later(script.duration_s);
    for touch in &mut scaled.touches {
        touch.start_s = later(touch.start_s);
        for time in [&mut touch.rise_s, &mut touch.hold_s, &mut touch.fall_s] {
            *time /= factor;
        }
        touch.velocity = touch.velocity.map(|v| v * factor);
        // Rounding must not make the period shorter than the touch.
        touch.period_s = touch.period_s.map(|period| (period / factor).max(touch.once_s()));
    }
    for [t, ..] in scaled.traces.iter_mut().flat_map(|trace| &mut trace.path) {
        *t = later(*t);
    }
    for joint in &mut scaled.joints {
        joint.start_s = later(joint.start_s);
        joint.rise_s /= factor;
        joint.hold_s /= factor;
        joint.fall_s = joint.fall_s.map(|fall| fall / factor);
    }
    scaled
}

/// The script, made for the garment `from`, on the garment `to`. Touches on a missing panel move to the largest
/// panel, to the same relative place in width and height, with the same size and speed in mm.
pub fn refit(script: &Script, from: &Layout, to: &Layout) -> Script {
    let mut fitted = script.clone();
    let Some(panel) = largest(to) else { return fitted };
    let home = |name: &str| from.areas().iter().find(|area| area.name == name).filter(|_| !has(to, name));
    for touch in &mut fitted.touches {
        let Some(home) = home(&touch.panel) else { continue };
        let (old_mm, new_mm) = (pitch_mm(home), pitch_mm(panel));
        let at = moved(touch.centre(old_mm), home, panel);
        touch.panel = panel.name.as_str().into();
        (touch.at, touch.at_mm) = (None, Some([at[0] * new_mm[0], at[1] * new_mm[1]]));
        touch.velocity = [0, 1].map(|axis| touch.velocity[axis] * old_mm[axis] / new_mm[axis]);
    }
    for trace in &mut fitted.traces {
        let (Some(home), Some([_, x, y, _])) = (home(&trace.panel), trace.path.first().copied()) else {
            continue;
        };
        let (old_mm, new_mm) = (pitch_mm(home), pitch_mm(panel));
        let at = moved([x, y], home, panel);
        trace.panel = panel.name.as_str().into();
        for knot in &mut trace.path {
            let way = [knot[1] - x, knot[2] - y];
            let way = [0, 1].map(|axis| way[axis] * old_mm[axis] / new_mm[axis]);
            (knot[1], knot[2]) = (at[0] + way[0], at[1] + way[1]);
        }
    }
    fitted
}

/// Returns the same relative place on another panel, taxels.
fn moved(at: [f64; 2], from: &Area, to: &Area) -> [f64; 2] {
    let sizes = [(from.columns, to.columns), (from.rows, to.rows)];
    // The panel extends half a taxel beyond its first and its last centre.
    [0, 1].map(|axis| (at[axis] + 0.5) / f64::from(sizes[axis].0) * f64::from(sizes[axis].1) - 0.5)
}

/// Panels used by a script but missing in a garment, each once.
pub fn lacking(script: &Script, layout: &Layout) -> Vec<String> {
    let traced = script.traces.iter().map(|trace| trace.panel.clone());
    let mut panels: Vec<String> =
        script.touches.iter().map(|touch| touch.panel.clone()).chain(traced).collect();
    panels.retain(|panel| !has(layout, panel));
    panels.sort();
    panels.dedup();
    panels
}

fn has(layout: &Layout, panel: &str) -> bool {
    layout.areas().iter().any(|area| area.name == panel)
}

/// The panel with the largest surface; of equal ones the first.
pub fn largest(layout: &Layout) -> Option<&Area> {
    let mm2 = |area: &Area| {
        let [x, y] = pitch_mm(area);
        x * f64::from(area.columns) * y * f64::from(area.rows)
    };
    layout.areas().iter().rev().max_by(|a, b| mm2(a).total_cmp(&mm2(b)))
}

/// Moves a touch to a place of the panel: `part` 0 ..= 1 of the room left by footprint and path, per axis.
/// Without room it is centred.
fn place(touch: &mut Touch, area: &Area, part: [f64; 2]) {
    let pitch = pitch_mm(area);
    let reach = reach_mm(touch.shape, touch.size().map(|s| s / 2.0), touch.angle_deg);
    let counts = [area.columns, area.rows];
    let mut at = [0.0; 2];
    for ((((at, part), count), reach), (pitch, speed)) in
        at.iter_mut().zip(part).zip(counts).zip(reach).zip(pitch.into_iter().zip(touch.velocity))
    {
        let way = speed * touch.once_s();
        // The panel extends half a taxel beyond the first and the last centre.
        let low = reach / pitch - 0.5 - way.min(0.0);
        let high = f64::from(count) - 0.5 - reach / pitch - way.max(0.0);
        *at = if low < high { low + part * (high - low) } else { (low + high) / 2.0 };
    }
    touch.at_mm = None;
    touch.at = Some(at);
}

/// Moves a trace like a touch; its path keeps its form in taxels.
fn place_trace(trace: &mut Trace, area: &Area, part: [f64; 2]) {
    let pitch = pitch_mm(area);
    let reach = reach_mm(trace.shape, trace.size().map(|s| s / 2.0), trace.angle_deg);
    for (axis, (count, part)) in [area.columns, area.rows].into_iter().zip(part).enumerate() {
        let places = || trace.path.iter().map(|knot| knot[axis + 1]);
        let (least, most) =
            (places().fold(f64::INFINITY, f64::min), places().fold(f64::NEG_INFINITY, f64::max));
        let reach = reach[axis] / pitch[axis];
        let (low, high) = (reach - 0.5 - least, f64::from(count) - 0.5 - reach - most);
        let shift = if low < high { low + part * (high - low) } else { (low + high) / 2.0 };
        trace.path.iter_mut().for_each(|knot| knot[axis + 1] += shift);
    }
}

#[cfg(test)]
mod tests {
    use super::super::{World, shipped};
    use super::*;
    use taxel_core::garment::Garment;

    fn reference() -> Layout {
        Layout::build(&Garment::reference(), 2048, 4095).unwrap()
    }

    #[test]
    fn variants_keep_their_force_on_the_panel() {
        let garment = Garment::reference();
        let layout = reference();
        let mut panels = std::collections::BTreeSet::new();
        for name in ["pat", "lash", "stroke", "finger"] {
            let script = shipped(name).unwrap();
            for seed in 0..40 {
                let variant = vary(&script, Some(&layout), seed);
                variant.check().unwrap();
                assert_eq!(variant, vary(&script, Some(&layout), seed));
                let touch = &variant.touches[0];
                assert!((0.5..=1.5).contains(&(touch.force_n / script.touches[0].force_n)));
                assert!((0.5..=1.5).contains(&(touch.once_s() / script.touches[0].once_s())));
                let world = World::build(&variant, &garment).unwrap();
                let panel = garment.panels.iter().position(|p| p.name == touch.panel.as_str()).unwrap();
                for t in [
                    touch.start_s + touch.rise_s * 1.001,
                    touch.start_s + touch.rise_s + touch.hold_s * 0.999,
                ] {
                    let newtons: f32 =
                        (0..512).map(|i| world.newtons(panel * 512 + i, (t * 1e9) as u64)).sum();
                    assert!(
                        (f64::from(newtons) / touch.force_n - 1.0).abs() < 0.02,
                        "{name} {seed}: {newtons}"
                    );
                }
                panels.insert(touch.panel.clone());
            }
        }
        assert_eq!(panels.len(), 4);
    }

    #[test]
    fn controls_scale_one_thing() {
        let pat = shipped("pat").unwrap();
        assert!((scale_force(&pat, 0.05).touches[0].force_n - 0.4).abs() < 1e-12);
        let fast = scale_rate(&pat, 3.0);
        fast.check().unwrap();
        assert!((fast.touches[0].once_s() - 0.2 / 3.0).abs() < 1e-12);
        assert!((fast.touches[0].end_s() - (0.2 + 0.74 / 3.0)).abs() < 1e-9);
        assert_eq!(fast.touches[0].force_n, 8.0);
        for factor in [0.1, 0.7, 1.3, 9.0] {
            for scene in super::super::list() {
                scale_rate(&shipped(&scene.name).unwrap(), factor).check().unwrap();
            }
        }
    }

    #[test]
    fn a_script_moves_to_another_garment_in_mm() {
        let layout = Layout::build(&Garment::mat(), 2048, 4095).unwrap();
        let hands = shipped("two-hands").unwrap();
        let script = refit(&hands, &reference(), &layout);
        assert!(script.touches.iter().all(|t| t.panel == "mat"));
        assert_eq!((lacking(&hands, &layout).len(), lacking(&script, &layout).len()), (2, 0));
        World::build(&script, &Garment::mat()).unwrap();
        let drawn = "duration_s = 1\n[[trace]]\npanel = \"back\"\nshape = \"palm\"\n\
            path = [[0.2, 7.5, 15.5, 0], [0.6, 9.5, 14.5, 8]]";
        let drawn: Script = drawn.parse().unwrap();
        assert_eq!(lacking(&drawn, &layout), ["back"]);
        let trace = refit(&drawn, &reference(), &layout).traces.remove(0);
        assert_eq!(
            (trace.panel.as_str(), trace.path),
            ("mat", vec![[0.2, 15.5, 31.5, 0.0], [0.6, 17.9, 30.5, 8.0]])
        );
        let varied = vary(&drawn, Some(&reference()), 3);
        varied.check().unwrap();
        let garment = Garment::reference();
        let world = World::build(&varied, &garment).unwrap();
        let [t_s, _, _, force] = varied.traces[0].path[1];
        let felt: f32 = (0..2048).map(|taxel| world.newtons(taxel, (t_s * 1e9) as u64 - 1)).sum();
        assert!((f64::from(felt) / force - 1.0).abs() < 0.02 && force != 8.0, "{felt} of {force}");
        // The middle stays the middle, and the speed in mm stays the same.
        let stroke = "duration_s = 1\n[[touch]]\npanel = \"back\"\nshape = \"palm\"\nforce_n = 8\nat = [7.5, 15.5]\nvelocity = [5, 6]\nstart_s = 0.2".parse::<Script>();
        let touch = refit(&stroke.unwrap(), &reference(), &layout).touches.remove(0);
        assert_eq!((touch.at, touch.at_mm, touch.velocity), (None, Some([155.0, 315.0]), [6.0, 6.0]));
    }

    #[test]
    fn the_largest_panel_is_that_of_the_largest_surface() {
        let mut garment = Garment::reference();
        let largest_of = |garment: &Garment| {
            let layout = Layout::build(garment, 2048, 4095).unwrap();
            largest(&layout).unwrap().name.to_string()
        };
        assert_eq!(largest_of(&garment), "chest");
        garment.panels[2].pitch_um = [20_000, 10_000];
        assert_eq!(largest_of(&garment), "left arm");
    }
}
