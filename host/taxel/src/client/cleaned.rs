//! Removes control characters from a board's names, which are shown in many places.

use crate::text::words::printable;
use taxel_core::garment::Garment;
use taxel_core::react::Cause;
use taxel_core::scene::Scene;

/// Cleans a name.
pub fn name<const BYTES: usize>(name: &mut heapless::String<BYTES>) {
    if let std::borrow::Cow::Owned(clean) = printable(name) {
        name.clear();
        // Replacements are never longer.
        let _ = name.push_str(&clean);
    }
}

/// Cleans all names of a garment.
pub fn garment(garment: &mut Garment) {
    name(&mut garment.name);
    for panel in &mut garment.panels {
        [&mut panel.name, &mut panel.link, &mut panel.region].into_iter().for_each(name);
    }
}

/// Cleans all names of a scene.
pub fn scene(scene: &mut Scene) {
    name(&mut scene.name);
    scene.friendliness.iter_mut().for_each(|entry| name(&mut entry.region));
    scene.joints.iter_mut().for_each(name);
    for row in &mut scene.react {
        name(&mut row.name);
        name(&mut row.region);
        if let Cause::Concept(concept) = &mut row.cause {
            name(concept);
        }
    }
    if let Some(intent) = &mut scene.intent {
        name(&mut intent.map.name);
        intent.map.concepts.iter_mut().for_each(name);
    }
}
