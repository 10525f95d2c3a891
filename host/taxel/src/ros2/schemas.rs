//! Message definitions with those that they use, in the form that MCAP calls `ros2msg`.

/// Definition of the header that several messages begin with.
macro_rules! header {
    () => {
        "\n================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id

================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
"
    };
}

/// `sensor_msgs/msg/Image`
pub const IMAGE: &str = concat!(
    "std_msgs/Header header
uint32 height
uint32 width
string encoding
uint8 is_bigendian
uint32 step
uint8[] data
",
    header!()
);

/// `sensor_msgs/msg/PointCloud2`
pub const POINT_CLOUD: &str = concat!(
    "std_msgs/Header header
uint32 height
uint32 width
sensor_msgs/PointField[] fields
bool is_bigendian
uint32 point_step
uint32 row_step
uint8[] data
bool is_dense
",
    header!(),
    "
================================================================================
MSG: sensor_msgs/PointField
uint8 INT8=1
uint8 UINT8=2
uint8 INT16=3
uint8 UINT16=4
uint8 INT32=5
uint8 UINT32=6
uint8 FLOAT32=7
uint8 FLOAT64=8
string name
uint32 offset
uint8 datatype
uint32 count
"
);

/// `geometry_msgs/msg/WrenchStamped`
pub const WRENCH: &str = concat!(
    "std_msgs/Header header
geometry_msgs/Wrench wrench
",
    header!(),
    "
================================================================================
MSG: geometry_msgs/Wrench
geometry_msgs/Vector3 force
geometry_msgs/Vector3 torque

================================================================================
MSG: geometry_msgs/Vector3
float64 x
float64 y
float64 z
"
);

/// `tf2_msgs/msg/TFMessage`
pub const FRAMES: &str = concat!(
    "geometry_msgs/TransformStamped[] transforms

================================================================================
MSG: geometry_msgs/TransformStamped
std_msgs/Header header
string child_frame_id
geometry_msgs/Transform transform
",
    header!(),
    "
================================================================================
MSG: geometry_msgs/Transform
geometry_msgs/Vector3 translation
geometry_msgs/Quaternion rotation

================================================================================
MSG: geometry_msgs/Vector3
float64 x
float64 y
float64 z

================================================================================
MSG: geometry_msgs/Quaternion
float64 x
float64 y
float64 z
float64 w
"
);

/// `diagnostic_msgs/msg/DiagnosticArray`
pub const DIAGNOSTICS: &str = concat!(
    "std_msgs/Header header
diagnostic_msgs/DiagnosticStatus[] status
",
    header!(),
    "
================================================================================
MSG: diagnostic_msgs/DiagnosticStatus
byte OK=0
byte WARN=1
byte ERROR=2
byte STALE=3
byte level
string name
string message
string hardware_id
diagnostic_msgs/KeyValue[] values

================================================================================
MSG: diagnostic_msgs/KeyValue
string key
string value
"
);
