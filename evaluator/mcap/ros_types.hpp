#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "evaluator/mcap/cdr.hpp"
#include "evaluator/mcap/mcap_writer.hpp"

namespace trivela::evaluator::mcap {

/// The definition of a standard type of ROS 2 (Humble) with those that it rests on: "tf2_msgs/TFMessage",
/// "geometry_msgs/PoseStamped" or "visualization_msgs/MarkerArray".
Schema standard_schema(std::string_view type);

/// A pose on the floor, x forward.
struct FloorPose {
  double x_m = 0.0;
  double y_m = 0.0;
  double yaw_rad = 0.0;  ///< counter-clockwise, 0: along x
};

/// A std_msgs/Header.
struct Header {
  std::int64_t t_ns = 0;  ///< since 1970
  std::string frame;
};

/// Red, green, blue, opacity, 0 to 1.
using Colour = std::array<float, 4>;

/// A visualization_msgs/Marker with what of it is used here.
struct Marker {
  enum Type : std::int32_t { kSphere = 2, kLineList = 5 };

  std::string what;  ///< its ns; one of a name takes the place of the one before
  Type type = kSphere;
  bool is_there = true;  ///< false: what was there by that name goes
  Colour colour{};
  double size_m = 0.1;                    ///< diameter, or width of the lines
  std::vector<Eigen::Vector3d> places{};  ///< centre of a sphere, or both ends of each line
};

/// Each writes a whole message.
void write_transform(Cdr& cdr, const Header& header, const std::string& child_frame, const FloorPose& pose);
void write_pose(Cdr& cdr, const Header& header, const FloorPose& pose);
void write_markers(Cdr& cdr, const Header& header, const std::vector<Marker>& markers);

}  // namespace trivela::evaluator::mcap
