//! What touches the robot at a time, on one board or on several.

/// Pressure and place of a touch of the robot.
#[derive(Debug, Clone, PartialEq)]
pub struct RobotTouch {
    /// Host time for which they are told, us since 1970: the mean time of the scans from which they are.
    pub host_us: u64,
    /// Number of the board on which most of it is.
    pub board: usize,
    /// Index of the panel there.
    pub panel: u8,
    /// Centroid, `[x, y]` in taxels of that panel, which goes on beyond its seams.
    pub centroid: [f64; 2],
    /// Sum of the pressure, counts; 0 once released.
    pub total: u32,
    /// Force, N; none unless calibrations are in force on all of its boards.
    pub newtons: Option<f64>,
    /// Greatest pressure of a taxel, counts.
    pub peak: u16,
    /// Number of taxels.
    pub area: u32,
    /// What it consists of, board by board. Of one that waits at a seam or is released, the last.
    pub parts: Vec<RobotTouchPart>,
}

/// What a board has of a touch of the robot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RobotTouchPart {
    /// Number of the board.
    pub board: usize,
    /// Id of the board's contact; none if it is too faint to be one there.
    pub contact: Option<u32>,
    /// Its pressure, counts.
    pub total: u32,
    /// Age of what the board has told, us; below 0 if it is newer than that of the board that is told.
    pub age_us: i64,
}
