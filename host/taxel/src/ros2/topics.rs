//! Topics and services of the node `taxel ros2`, and of the nodes of `taxel ros2`: their names, types and qualities of service. Recordings have
//! some of the topics, too.

/// Quality of service of a topic.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RosQos {
    /// Lost messages are sent again; else they are not.
    pub reliable: bool,
    /// A new subscriber gets the last messages.
    pub latched: bool,
    /// Messages kept for a subscriber.
    pub depth: usize,
}

/// A topic.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RosTopic {
    /// Name of the topic; `PANEL`, `LINK`, `CONCEPT` and `NAME` stand for one topic each. A name that does not begin
    /// with `/` lies in the node's namespace, behind the node's name if it begins with `~/`.
    pub name: &'static str,
    /// Package and name of its type.
    pub message: (&'static str, &'static str),
    /// Quality of service.
    pub qos: RosQos,
}

const fn topic(name: &'static str, package: &'static str, message: &'static str, qos: RosQos) -> RosTopic {
    RosTopic { name, message: (package, message), qos }
}

/// Each message counts.
const EVERY: RosQos = RosQos { reliable: true, latched: false, depth: 100 };
/// Each message counts, and the last one to a new subscriber.
const STATE: RosQos = RosQos { reliable: true, latched: true, depth: 1 };
/// The newest message counts, as for images of a camera: of large messages that are sent again, most come late.
const NEWEST: RosQos = RosQos { reliable: false, latched: false, depth: 5 };
/// Each message counts for whoever controls by it: controllers ask for reliable messages, ten of them.
const CONTROL: RosQos = RosQos { reliable: true, latched: false, depth: 10 };

/// Contacts of each scan.
pub const CONTACTS: RosTopic = topic("~/contacts", "taxel_msgs", "Contacts", EVERY);
/// Words for contacts.
pub const SYMBOLS: RosTopic = topic("~/symbols", "taxel_msgs", "Symbols", EVERY);
/// Reactions, and their ends.
pub const REACTIONS: RosTopic = topic("~/reactions", "taxel_msgs", "Reaction", EVERY);
/// The intention.
pub const INTENT: RosTopic = topic("~/intent", "taxel_msgs", "Intent", EVERY);
/// Counters of the board.
pub const HEALTH: RosTopic = topic("~/health", "taxel_msgs", "Health", STATE);
/// Every event but images as a line of JSON, for nodes without `taxel_msgs`.
pub const JSON: RosTopic = topic("~/json", "std_msgs", "String", EVERY);
/// The posture that the board has accepted, with the stamp of the joint states that it came from.
pub const POSTURE: RosTopic = topic("~/posture", "sensor_msgs", "JointState", STATE);
/// Image of a panel.
pub const IMAGE: RosTopic = topic("tactile/PANEL/image", "sensor_msgs", "Image", NEWEST);
/// Points of a panel.
pub const POINTS: RosTopic = topic("tactile/PANEL/points", "sensor_msgs", "PointCloud2", NEWEST);
/// Force on a panel.
pub const WRENCH: RosTopic = topic("tactile/PANEL/wrench", "geometry_msgs", "WrenchStamped", CONTROL);
/// Contacts and forces on the robot, with a body.
pub const PRESSING: RosTopic = topic("~/pressing", "taxel_msgs", "Pressing", EVERY);
/// Touch state of the regions of the robot's surface, with a body.
pub const REGIONS: RosTopic = topic("~/regions", "taxel_msgs", "BodyRegions", EVERY);
/// Force and moment on a link, with a body and a calibration.
pub const LINK_WRENCH: RosTopic =
    topic("tactile/links/LINK/wrench", "geometry_msgs", "WrenchStamped", CONTROL);
/// Force and moment on a link in counts, with a body and without a calibration.
pub const LINK_COUNTS: RosTopic =
    topic("tactile/links/LINK/wrench_counts", "geometry_msgs", "WrenchStamped", CONTROL);
/// Frames of the panels.
pub const FRAMES: RosTopic = topic("/tf_static", "tf2_msgs", "TFMessage", STATE);
/// State of the board.
pub const DIAGNOSTICS: RosTopic = topic("/diagnostics", "diagnostic_msgs", "DiagnosticArray", EVERY);
/// The board's time, with `--clock`.
pub const CLOCK: RosTopic = topic("/clock", "rosgraph_msgs", "Clock", EVERY);

/// Meaning of touches to a robot of several boards, by the node of the robot.
pub const ROBOT_INTENT: RosTopic = topic("robot_intent", "taxel_msgs", "RobotIntent", EVERY);

/// Topics that the nodes publish.
pub const PUBLISHED: [RosTopic; 18] = [
    CONTACTS,
    SYMBOLS,
    REACTIONS,
    INTENT,
    HEALTH,
    JSON,
    POSTURE,
    IMAGE,
    POINTS,
    WRENCH,
    PRESSING,
    REGIONS,
    LINK_WRENCH,
    LINK_COUNTS,
    FRAMES,
    DIAGNOSTICS,
    CLOCK,
    ROBOT_INTENT,
];

/// Joint states, taken as posture.
pub const JOINT_STATES: RosTopic = topic("joint_states", "sensor_msgs", "JointState", NEWEST);
/// A concept that the scene's map lets the host feed.
pub const CONCEPT: RosTopic = topic("~/concepts/CONCEPT", "std_msgs", "Float64", EVERY);
/// Value that others send the robot's map by a name, to the node of the robot.
pub const HOST_INPUT: RosTopic = topic("~/host_input/NAME", "std_msgs", "Float64", EVERY);

/// Topics to which the nodes subscribe.
pub const TAKEN: [RosTopic; 3] = [JOINT_STATES, CONCEPT, HOST_INPUT];

/// Velocities of the joints, for MoveIt Servo.
pub const JOINT_JOG: RosTopic = topic("~/joint_jog", "control_msgs", "JointJog", CONTROL);
/// Velocity of a link, for MoveIt Servo.
pub const TWIST: RosTopic = topic("~/twist", "geometry_msgs", "TwistStamped", CONTROL);
/// Factor on the speed of a trajectory controller.
pub const SPEED_SCALING: RosTopic = topic("~/speed_scaling", "control_msgs", "SpeedScalingFactor", CONTROL);
/// Velocities of the joints, for forward velocity controllers.
pub const VELOCITIES: RosTopic = topic("~/velocities", "std_msgs", "Float64MultiArray", CONTROL);
/// Force and moment of all touches in the base, for compliance controllers.
pub const TOUCH_WRENCH: RosTopic = topic("~/wrench", "geometry_msgs", "WrenchStamped", CONTROL);
/// Command and its causes, a line of JSON.
pub const MOTION: RosTopic = topic("~/motion", "std_msgs", "String", EVERY);

/// Topics that the node of `taxel motion` publishes.
pub const MOTION_PUBLISHED: [RosTopic; 6] =
    [JOINT_JOG, TWIST, SPEED_SCALING, VELOCITIES, TOUCH_WRENCH, MOTION];

/// A service: its name, and package and name of its type.
pub type RosService = (&'static str, (&'static str, &'static str));

/// Takes the mean of the next frames as the baseline.
pub const TARE: RosService = ("~/tare", ("std_srvs", "Trigger"));
/// Saves the board's settings to its flash.
pub const SAVE: RosService = ("~/save", ("std_srvs", "Trigger"));
/// Sends a scene.
pub const SET_SCENE: RosService = ("~/set_scene", ("taxel_msgs", "SetScene"));

/// Arms and disarms the node of `taxel motion`.
pub const ARM: RosService = ("~/arm", ("std_srvs", "Trigger"));
/// See [`ARM`].
pub const DISARM: RosService = ("~/disarm", ("std_srvs", "Trigger"));

/// Services that the node offers.
pub const SERVICES: [RosService; 3] = [TARE, SAVE, SET_SCENE];
