//! Names of the parameters of the node `taxel ros2`.

/// Short name of the source; it cannot be set.
pub const SOURCE: &str = "source";
/// Images, points and forces of a panel per second; 0: none.
pub const IMAGE_HZ: &str = "image_hz";
/// Frames of a tare.
pub const TARE_FRAMES: &str = "tare_frames";
/// Time for which the value of a concept counts, ms; 0: until the next one.
pub const CONCEPT_TIMEOUT_MS: &str = "concept_timeout_ms";

/// All of them, with their types and values at the start.
pub const PARAMETERS: [(&str, &str, &str); 4] = [
    (SOURCE, "string", "the source"),
    (IMAGE_HZ, "double", "10.0"),
    (TARE_FRAMES, "integer", "64"),
    (CONCEPT_TIMEOUT_MS, "integer", "2000"),
];
