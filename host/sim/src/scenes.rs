//! Shipped scripts of touches.

use super::script::Script;

/// Description of a script of touches.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneInfo {
    /// Name.
    pub name: String,
    /// Title.
    pub title: String,
    /// Length, s.
    pub duration: f64,
}

macro_rules! scenes {
    ($($name:literal),* $(,)?) => {
        [$(($name, include_str!(concat!("../scenes/", $name, ".toml")))),*]
    };
}

/// Names and texts.
const SCENES: [(&str, &str); 13] = scenes![
    "pat",
    "lash",
    "stroke",
    "hold",
    "finger",
    "box",
    "ball",
    "two-hands",
    "elbow",
    "press",
    "five",
    "source",
    "idle",
];

/// Names of all shipped scripts.
pub fn names() -> impl Iterator<Item = &'static str> + Clone {
    SCENES.into_iter().map(|(name, _)| name)
}

/// Text of a shipped script, with its comments.
pub fn text(name: &str) -> Option<&'static str> {
    SCENES.into_iter().find(|(known, _)| *known == name).map(|(_, text)| text)
}

/// A shipped script.
pub fn shipped(name: &str) -> Option<Script> {
    let script: Script = text(name)?.parse().ok()?;
    Some(if script.name.is_empty() { Script { name: name.into(), ..script } } else { script })
}

/// All shipped scripts of touches.
pub fn list() -> Vec<SceneInfo> {
    let info =
        |script: Script| SceneInfo { name: script.name, title: script.title, duration: script.duration_s };
    names().filter_map(shipped).map(info).collect()
}

#[cfg(test)]
mod tests {
    use super::super::{FRAME_PERIOD_US, World};
    use super::*;
    use taxel_core::garment::Garment;

    #[test]
    fn every_scene_loads_and_plays_after_the_tare() {
        assert_eq!(list().len(), SCENES.len());
        for (scene, (name, _)) in list().iter().zip(SCENES) {
            let script = shipped(name).unwrap();
            assert_eq!(scene.name, name);
            assert!(!script.title.is_empty() && !script.description.is_empty(), "{name}");
            assert!(f64::from(script.tare_frames) * FRAME_PERIOD_US as f64 / 1e6 < 0.15);
            for touch in &script.touches {
                assert!(touch.start_s >= 0.15 && touch.end_s() + 0.1 <= script.duration_s, "{name}");
            }
            World::build(&script, &Garment::preset(&script.garment).unwrap()).unwrap();
        }
    }

    /// Forces by panel at a time, N.
    fn forces(name: &str, seconds: f64) -> [f32; 4] {
        let script = shipped(name).unwrap();
        let world = World::build(&script, &Garment::reference()).unwrap();
        let t_ns = (seconds * 1e9) as u64;
        [0, 1, 2, 3].map(|panel| (0..512).map(|taxel| world.newtons(panel * 512 + taxel, t_ns)).sum())
    }

    #[test]
    fn scenes_put_their_force_where_they_say() {
        let close = |found: [f32; 4], reported: [f32; 4]| {
            assert!(
                found.iter().zip(reported).all(|(f, t)| (f - t).abs() <= 0.02 * t),
                "{found:?} is not {reported:?}"
            );
        };
        for peak in [0.3, 0.57, 0.84] {
            close(forces("pat", peak), [0.0, 8.0, 0.0, 0.0]);
        }
        close(forces("pat", 0.45), [0.0; 4]);
        close(forces("lash", 0.38), [0.0, 40.0, 0.0, 0.0]);
        for t in [0.35, 0.7, 1.05] {
            close(forces("stroke", t), [0.0, 0.0, 5.0, 0.0]);
        }
        close(forces("hold", 1.0), [0.0, 0.0, 0.0, 40.0]);
        close(forces("finger", 0.5), [3.0, 0.0, 0.0, 0.0]);
        close(forces("box", 0.5), [20.0, 0.0, 0.0, 0.0]);
        close(forces("ball", 0.5), [0.0, 25.0, 0.0, 0.0]);
        close(forces("two-hands", 1.0), [12.0, 10.0, 0.0, 0.0]);
        close(forces("elbow", 1.3), [0.0, 0.0, 25.0, 0.0]);
        close(forces("press", 0.8), [70.0, 0.0, 0.0, 0.0]);
        for frame in 0..340 {
            close(forces("five", 0.3 + f64::from(frame) / 195.0), [13.0, 15.0, 7.0, 12.0]);
        }
        let angles: Vec<_> = [0.2, 0.75, 1.3, 2.5]
            .iter()
            .map(|t| shipped("elbow").unwrap().posture(*t).map(|(_, angle)| angle.round()).next().unwrap())
            .collect();
        assert_eq!(angles, [0.0, 55.0, 110.0, 0.0]);
    }
}
