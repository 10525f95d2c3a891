//! JSON schemas of the files that people write, for editors.

/// Of a garment's file.
pub const GARMENT: &str = include_str!("../../schemas/garment.json");
/// Of a scene's file.
pub const SCENE: &str = include_str!("../../schemas/scene.json");
/// Of a script of touches.
pub const TOUCHES: &str = include_str!("../../schemas/touches.json");
