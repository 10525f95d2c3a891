//! Errors of robots.

/// Reason why a robot's description is invalid, or does not fit what is asked of it.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RobotError {
    /// The file is not XML, or not a URDF.
    #[error("{0}")]
    NotUrdf(String),
    /// A link of the file is invalid.
    #[error("{text}")]
    Link {
        /// Name of the link.
        link: String,
        /// File, line, link, and what is wrong.
        text: String,
    },
    /// A joint of the file is invalid.
    #[error("{text}")]
    Joint {
        /// Name of the joint.
        joint: String,
        /// File, line, joint, and what is wrong.
        text: String,
    },
    /// A mesh cannot be read.
    #[error("{0}")]
    Mesh(String),
    /// The robot has no link of this name.
    #[error("{text}")]
    NoLink {
        /// The name.
        link: String,
        /// The file, and which links it has.
        text: String,
    },
    /// The robot has no joint of this name, or none that has a position of its own.
    #[error("{text}")]
    NoJoint {
        /// The name.
        joint: String,
        /// The file, and which joints it has.
        text: String,
    },
    /// The position of a joint is not a number, or is outside its limits.
    #[error("{text}")]
    Position {
        /// The joint.
        joint: String,
        /// File, line, joint, and the limits.
        text: String,
    },
}
