//! Reads a scene.

use super::Unread;
use crate::board::refusal::Refusal;
use crate::format::LEFT_OUT;
use crate::intent::{IntentConfig, MapConfig};
use crate::scene::Scene;

/// Decodes a scene from postcard, in the order of its fields. After an error `to` holds the fields read so
/// far.
#[inline(never)]
pub(crate) fn scene(bytes: &[u8], to: &mut Scene) -> Result<(), Refusal> {
    let from = &mut Unread { what: "scene", bytes };
    from.put("name", &mut to.name)?;
    from.put("plan", &mut to.plan)?;
    from.put("rate_hz", &mut to.rate_hz)?;
    from.put("condition", &mut to.condition)?;
    from.put("contact", &mut to.contact)?;
    from.put("shape", &mut to.shape)?;
    from.put("gestures", &mut to.gestures)?;
    from.put("symbol", &mut to.symbol)?;
    to.intent = None;
    if from.next("intent")? {
        if !cfg!(feature = "intent") {
            return Err(format_args!("scene: intent {LEFT_OUT}").into());
        }
        intent(from, to.intent.get_or_insert_with(|| IntentConfig::new(MapConfig::default())))?;
    }
    from.list("friendliness", &mut to.friendliness)?;
    from.list("joints", &mut to.joints)?;
    from.list("react", &mut to.react)?;
    from.put("stream", &mut to.stream)?;
    from.end()
}

#[inline(never)]
fn intent(from: &mut Unread<'_>, to: &mut IntentConfig) -> Result<(), Refusal> {
    map(from, &mut to.map)?;
    from.put("intent.onset_ms", &mut to.onset_ms)?;
    from.put("intent.level", &mut to.level)?;
    from.put("intent.margin", &mut to.margin)?;
    from.put("intent.hold_ms", &mut to.hold_ms)?;
    from.put("intent.period_ms", &mut to.period_ms)?;
    from.put("intent.steps", &mut to.steps)
}

fn map(from: &mut Unread<'_>, to: &mut MapConfig) -> Result<(), Refusal> {
    from.put("intent.map.name", &mut to.name)?;
    from.list("intent.map.concepts", &mut to.concepts)?;
    from.put("intent.map.decimals", &mut to.decimals)?;
    from.list("intent.map.edges", &mut to.edges)?;
    from.put("intent.map.rule", &mut to.rule)?;
    from.put("intent.map.transfer", &mut to.transfer)?;
    from.put("intent.map.lambda", &mut to.lambda)?;
    from.put("intent.map.threshold", &mut to.threshold)?;
    from.list("intent.map.thresholds", &mut to.thresholds)?;
    from.put("intent.map.held", &mut to.held)?;
    from.list("intent.map.inputs", &mut to.inputs)
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;
    use crate::format::name;
    use crate::intent::{Edge, MapInput, Source, Threshold};
    use std::string::{String, ToString};

    /// A scene whose map fills every list.
    fn full() -> Scene {
        let mut scene = Scene::shipped();
        let map = &mut scene.intent.as_mut().unwrap().map;
        map.concepts = (0..64).map(|at| name(&std::format!("c{at}"))).collect();
        map.edges = (0..=255).map(|at| Edge { from: at % 32, to: 32 + at / 8, weight: -9_999 }).collect();
        map.thresholds = (0..64).map(|concept| Threshold { concept, value: -5 }).collect();
        let input = |concept| MapInput {
            concept,
            source: Source::Rise,
            low: i32::MIN,
            high: 1,
            at_low: 0,
            at_high: 1,
        };
        map.inputs = (0..32).map(input).collect();
        scene
    }

    fn refused(bytes: &[u8]) -> String {
        let mut to = Scene::empty();
        scene(bytes, &mut to).unwrap_err().sentence().to_string()
    }

    #[test]
    fn it_reads_what_a_scene_is_written_as() {
        let mut to = Scene::empty();
        let mut bytes = [0; 4096];
        // All into one scene: nothing of the previous one may remain.
        for wanted in [Scene::shipped(), full(), Scene::empty(), Scene::scaled(255), full()] {
            scene(postcard::to_slice(&wanted, &mut bytes).unwrap(), &mut to).unwrap();
            assert_eq!(to, wanted);
        }
    }

    #[test]
    fn a_scene_cut_anywhere_is_refused_with_the_field_that_is_missing() {
        let mut bytes = [0; 4096];
        let bytes = postcard::to_slice(&full(), &mut bytes).unwrap();
        for end in 0..bytes.len() {
            let why = refused(&bytes[..end]);
            assert!(why.starts_with("scene: it ends within "), "{end}: {why}");
        }
        assert_eq!(refused(&bytes[..1]), "scene: it ends within name");
    }

    #[test]
    fn a_map_too_big_is_refused_with_its_size_and_what_fits() {
        // The bytes before a list locate it.
        let mut bytes = [0; 4096];
        let length = postcard::to_slice(&Scene::shipped(), &mut bytes).unwrap().len();
        let concepts = bytes.windows(8).position(|it| it == b"\x07tactile").unwrap() + 8;
        assert_eq!(bytes[concepts], 22);
        bytes[concepts] = 65;
        assert_eq!(refused(&bytes[..length]), "scene: 65 intent.map.concepts, and there is room for 64");
        bytes[concepts] = 22;
        let edges = bytes.windows(5).position(|it| it == b"\x04grip").unwrap() + 5 + 1;
        assert_eq!(bytes[edges], 41);
        bytes.copy_within(edges + 1..length, edges + 2);
        [bytes[edges], bytes[edges + 1]] = [0x81, 0x02];
        assert_eq!(refused(&bytes[..length + 1]), "scene: 257 intent.map.edges, and there is room for 256");
    }

    #[test]
    fn what_follows_a_scene_is_refused() {
        let mut bytes = [0; 4096];
        let length = postcard::to_slice(&Scene::shipped(), &mut bytes).unwrap().len();
        assert_eq!(refused(&bytes[..length + 2]), "scene: bytes after its end: 2");
        assert_eq!(refused(&[17]), "scene: it ends within name");
        assert_eq!(refused(&[1, 0xff]), "scene: name cannot be read");
    }
}
