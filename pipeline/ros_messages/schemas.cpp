// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ros_messages/schemas.hpp"

#include <algorithm>
#include <array>

namespace terracut::ros_messages {
namespace {

/// Texts put together while compiling.
template <const std::string_view&... kParts>
struct Joined {
  static constexpr auto kText = [] {
    std::array<char, (kParts.size() + ...)> text{};
    auto end = text.begin();
    ((end = std::ranges::copy(kParts, end).out), ...);
    return text;
  }();
  static constexpr std::string_view kView{kText.data(), kText.size()};
};

// Definitions that several types need.
constexpr std::string_view kHeader =
    R"(================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
)";
constexpr std::string_view kPoseAndPoint =
    R"(================================================================================
MSG: geometry_msgs/Pose
geometry_msgs/Point position
geometry_msgs/Quaternion orientation
================================================================================
MSG: geometry_msgs/Point
float64 x
float64 y
float64 z
)";
constexpr std::string_view kVectorAndQuaternion =
    R"(================================================================================
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
)";

constexpr std::string_view kPointCloud2Itself = R"(std_msgs/Header header
uint32 height
uint32 width
sensor_msgs/PointField[] fields
bool is_bigendian
uint32 point_step
uint32 row_step
uint8[] data
bool is_dense
)";
constexpr std::string_view kPointCloud2Parts =
    R"(================================================================================
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
)";
constexpr std::string_view kDiagnosticArrayItself = R"(std_msgs/Header header
diagnostic_msgs/DiagnosticStatus[] status
)";
constexpr std::string_view kDiagnosticArrayParts =
    R"(================================================================================
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
)";
constexpr std::string_view kTfMessageItself = R"(geometry_msgs/TransformStamped[] transforms
================================================================================
MSG: geometry_msgs/TransformStamped
std_msgs/Header header
string child_frame_id
geometry_msgs/Transform transform
)";
constexpr std::string_view kTfMessageParts =
    R"(================================================================================
MSG: geometry_msgs/Transform
geometry_msgs/Vector3 translation
geometry_msgs/Quaternion rotation
)";
constexpr std::string_view kDetection3DArrayItself = R"(std_msgs/Header header
vision_msgs/Detection3D[] detections
)";
constexpr std::string_view kDetection3DArrayParts =
    R"(================================================================================
MSG: vision_msgs/Detection3D
std_msgs/Header header
vision_msgs/ObjectHypothesisWithPose[] results
vision_msgs/BoundingBox3D bbox
string id
================================================================================
MSG: vision_msgs/ObjectHypothesisWithPose
vision_msgs/ObjectHypothesis hypothesis
geometry_msgs/PoseWithCovariance pose
================================================================================
MSG: vision_msgs/ObjectHypothesis
string class_id
float64 score
================================================================================
MSG: geometry_msgs/PoseWithCovariance
geometry_msgs/Pose pose
float64[36] covariance
================================================================================
MSG: vision_msgs/BoundingBox3D
geometry_msgs/Pose center
geometry_msgs/Vector3 size
)";
constexpr std::string_view kMarkerArrayItself = R"(visualization_msgs/Marker[] markers
================================================================================
MSG: visualization_msgs/Marker
int32 ARROW=0
int32 CUBE=1
int32 SPHERE=2
int32 CYLINDER=3
int32 LINE_STRIP=4
int32 LINE_LIST=5
int32 CUBE_LIST=6
int32 SPHERE_LIST=7
int32 POINTS=8
int32 TEXT_VIEW_FACING=9
int32 MESH_RESOURCE=10
int32 TRIANGLE_LIST=11
int32 ADD=0
int32 MODIFY=0
int32 DELETE=2
int32 DELETEALL=3
std_msgs/Header header
string ns
int32 id
int32 type
int32 action
geometry_msgs/Pose pose
geometry_msgs/Vector3 scale
std_msgs/ColorRGBA color
builtin_interfaces/Duration lifetime
bool frame_locked
geometry_msgs/Point[] points
std_msgs/ColorRGBA[] colors
string texture_resource
sensor_msgs/CompressedImage texture
visualization_msgs/UVCoordinate[] uv_coordinates
string text
string mesh_resource
visualization_msgs/MeshFile mesh_file
bool mesh_use_embedded_materials
)";
constexpr std::string_view kMarkerArrayParts =
    R"(================================================================================
MSG: std_msgs/ColorRGBA
float32 r
float32 g
float32 b
float32 a
================================================================================
MSG: builtin_interfaces/Duration
int32 sec
uint32 nanosec
================================================================================
MSG: sensor_msgs/CompressedImage
std_msgs/Header header
string format
uint8[] data
================================================================================
MSG: visualization_msgs/UVCoordinate
float32 u
float32 v
================================================================================
MSG: visualization_msgs/MeshFile
string filename
uint8[] data
)";
constexpr std::string_view kLaserScanItself = R"(std_msgs/Header header
float32 angle_min
float32 angle_max
float32 angle_increment
float32 time_increment
float32 scan_time
float32 range_min
float32 range_max
float32[] ranges
float32[] intensities
)";
constexpr std::string_view kPolygonStampedItself = R"(std_msgs/Header header
geometry_msgs/Polygon polygon
)";
constexpr std::string_view kPolygonStampedParts =
    R"(================================================================================
MSG: geometry_msgs/Polygon
geometry_msgs/Point32[] points
================================================================================
MSG: geometry_msgs/Point32
float32 x
float32 y
float32 z
)";
constexpr std::string_view kOccupancyGridItself = R"(std_msgs/Header header
nav_msgs/MapMetaData info
int8[] data
)";
constexpr std::string_view kOccupancyGridParts =
    R"(================================================================================
MSG: nav_msgs/MapMetaData
builtin_interfaces/Time map_load_time
float32 resolution
uint32 width
uint32 height
geometry_msgs/Pose origin
)";

}  // namespace

constinit const Schema kPointCloud2{"sensor_msgs/msg/PointCloud2",
                                    Joined<kPointCloud2Itself, kHeader, kPointCloud2Parts>::kView};
constinit const Schema kDiagnosticArray{
    "diagnostic_msgs/msg/DiagnosticArray",
    Joined<kDiagnosticArrayItself, kHeader, kDiagnosticArrayParts>::kView};
constinit const Schema kTfMessage{
    "tf2_msgs/msg/TFMessage",
    Joined<kTfMessageItself, kHeader, kTfMessageParts, kVectorAndQuaternion>::kView};
constinit const Schema kDetection3DArray{
    "vision_msgs/msg/Detection3DArray",
    Joined<kDetection3DArrayItself, kHeader, kDetection3DArrayParts, kPoseAndPoint,
           kVectorAndQuaternion>::kView};
constinit const Schema kMarkerArray{"visualization_msgs/msg/MarkerArray",
                                    Joined<kMarkerArrayItself, kHeader, kPoseAndPoint,
                                           kVectorAndQuaternion, kMarkerArrayParts>::kView};
constinit const Schema kLaserScan{"sensor_msgs/msg/LaserScan",
                                  Joined<kLaserScanItself, kHeader>::kView};
constinit const Schema kPolygonStamped{
    "geometry_msgs/msg/PolygonStamped",
    Joined<kPolygonStampedItself, kHeader, kPolygonStampedParts>::kView};
constinit const Schema kOccupancyGrid{"nav_msgs/msg/OccupancyGrid",
                                      Joined<kOccupancyGridItself, kHeader, kOccupancyGridParts,
                                             kPoseAndPoint, kVectorAndQuaternion>::kView};

}  // namespace terracut::ros_messages
