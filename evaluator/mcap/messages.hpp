#pragma once

#include <Eigen/Core>

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "evaluator/mcap/mcap_writer.hpp"
#include "log/schema/row.hpp"
#include "log/schema/stream_table.hpp"

namespace trivela::evaluator::mcap {

/// A message in CDR, little endian (XCDR1, as ROS 2 has it): a header of four bytes, then members in their order, each
/// aligned to its size from the header's end.
class Cdr {
 public:
  static_assert(std::endian::native == std::endian::little);

  /// Begins another message; what bytes() gave is gone.
  void begin() { bytes_.assign("\0\1\0\0", 4); }

  /// A whole number, a number or a bool.
  template <class Number>
  void put(Number number) {
    align(sizeof(number));
    append(bytes_, number);
  }

  /// Its length with the 0 at its end, then both.
  void put_text(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size() + 1));
    bytes_.append(text);
    bytes_ += '\0';
  }

  /// Of a sequence whose members follow.
  void put_length(std::size_t length) { put(static_cast<std::uint32_t>(length)); }

  std::string_view bytes() const { return bytes_; }

 private:
  void align(std::size_t size) { bytes_.append((size - (bytes_.size() - 4) % size) % size, '\0'); }

  std::string bytes_;
};

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

/// Label of an enum that its column does not know.
inline constexpr std::uint8_t kOtherLabel = 255;

/// The message that a row of a table becomes: trivela_msgs/msg/KickDecision of kick_decisions. A member a column, by
/// its name and in the order of schema.sql: int64, float64 (NULL: NaN), bool, string, and uint8 of labels, whose
/// constants stand before it. Before any but a float64 that may be NULL stands bool has_NAME.
Schema schema_of(const log::StreamTable& table);

/// The row in CDR. Throws log::WrongCell where a cell is not what its column holds.
void write_row(Cdr& cdr, const log::StreamTable& table, std::span<const log::Value> row);

}  // namespace trivela::evaluator::mcap
