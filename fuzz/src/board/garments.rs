//! Garments and scenes that a board begins with.

use taxel_core::acquire::Depth;
use taxel_core::garment::Garment;
use taxel_core::gesture::GestureConfig;
use taxel_core::scene::Scene;

/// A garment and what it is used for.
pub struct Outfit {
    /// The garment.
    pub garment: Garment,
    /// The scene for it.
    pub scene: Scene,
}

/// Up to 64 taxels.
pub fn small(which: u8) -> Outfit {
    Outfit { garment: Garment::block(), scene: scene(which) }
}

/// Up to 2,048 taxels: four panels with seams, or one.
pub fn large(which: u8) -> Outfit {
    let garment = if which & 2 == 0 { Garment::reference() } else { Garment::mat() };
    Outfit { garment, scene: scene(which) }
}

fn scene(which: u8) -> Scene {
    let mut scene = Scene::shipped();
    if which & 1 == 1 {
        scene.plan.depth = Depth::Interlaced;
    }
    if which & 4 == 4 {
        scene.stream.pressing_hz = u16::MAX;
        scene.gestures = Some(GestureConfig::default());
    }
    scene
}
