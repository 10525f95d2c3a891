//! JSON schemas of the files that people write, for editors.

/// Schema of a garment's file.
pub const GARMENT: &str = include_str!("../../schemas/garment.json");
/// Schema of a scene's file.
pub const SCENE: &str = include_str!("../../schemas/scene.json");
/// Schema of a script of touches.
pub const TOUCHES: &str = include_str!("../../schemas/touches.json");
/// Schema of a robot's file.
pub const ROBOT: &str = include_str!("../../schemas/robot.json");
