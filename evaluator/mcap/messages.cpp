#include "evaluator/mcap/messages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <sstream>

#include "log/schema/queries.hpp"

namespace trivela::evaluator::mcap {
namespace {

struct Definition {
  std::string_view type, text;
};

// Members and constants of the .msg files of ROS 2 Humble.
constexpr Definition kDefinitions[] = {
    {"builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n"},
    {"builtin_interfaces/Duration", "int32 sec\nuint32 nanosec\n"},
    {"std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n"},
    {"std_msgs/ColorRGBA", "float32 r\nfloat32 g\nfloat32 b\nfloat32 a\n"},
    {"geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n"},
    {"geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n"},
    {"geometry_msgs/Quaternion", "float64 x 0\nfloat64 y 0\nfloat64 z 0\nfloat64 w 1\n"},
    {"geometry_msgs/Pose", "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n"},
    {"geometry_msgs/PoseStamped", "std_msgs/Header header\ngeometry_msgs/Pose pose\n"},
    {"geometry_msgs/Transform", "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n"},
    {"geometry_msgs/TransformStamped",
     "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform\n"},
    {"tf2_msgs/TFMessage", "geometry_msgs/TransformStamped[] transforms\n"},
    {"sensor_msgs/CompressedImage", "std_msgs/Header header\nstring format\nuint8[] data\n"},
    {"visualization_msgs/UVCoordinate", "float32 u\nfloat32 v\n"},
    {"visualization_msgs/MeshFile", "string filename\nuint8[] data\n"},
    {"visualization_msgs/Marker",
     "int32 ARROW=0\nint32 CUBE=1\nint32 SPHERE=2\nint32 CYLINDER=3\nint32 LINE_STRIP=4\nint32 LINE_LIST=5\n"
     "int32 CUBE_LIST=6\nint32 SPHERE_LIST=7\nint32 POINTS=8\nint32 TEXT_VIEW_FACING=9\nint32 MESH_RESOURCE=10\n"
     "int32 TRIANGLE_LIST=11\nint32 ADD=0\nint32 MODIFY=0\nint32 DELETE=2\nint32 DELETEALL=3\n"
     "std_msgs/Header header\nstring ns\nint32 id\nint32 type\nint32 action\ngeometry_msgs/Pose pose\n"
     "geometry_msgs/Vector3 scale\nstd_msgs/ColorRGBA color\nbuiltin_interfaces/Duration lifetime\n"
     "bool frame_locked\ngeometry_msgs/Point[] points\nstd_msgs/ColorRGBA[] colors\nstring texture_resource\n"
     "sensor_msgs/CompressedImage texture\nvisualization_msgs/UVCoordinate[] uv_coordinates\nstring text\n"
     "string mesh_resource\nvisualization_msgs/MeshFile mesh_file\nbool mesh_use_embedded_materials\n"},
    {"visualization_msgs/MarkerArray", "visualization_msgs/Marker[] markers\n"},
};

const Definition* definition_of(std::string_view type) {
  const auto* const at = std::ranges::find(kDefinitions, type, &Definition::type);
  return at == std::end(kDefinitions) ? nullptr : at;
}

/// The types that `text` rests on, each once, behind those that are known already.
void add_types_of(std::string_view text, std::vector<const Definition*>& known) {
  std::istringstream lines{std::string(text)};
  for (std::string line; std::getline(lines, line);) {
    const std::string type = line.substr(0, line.find_first_of(" ["));
    const Definition* const found = definition_of(type);
    if (found == nullptr || std::ranges::find(known, found) != known.end()) continue;
    known.push_back(found);
    add_types_of(found->text, known);
  }
}

void put_numbers(Cdr& cdr, std::initializer_list<double> numbers) {
  for (const double number : numbers) cdr.put(number);
}

void put_header(Cdr& cdr, const Header& header) {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  cdr.put(static_cast<std::int32_t>(header.t_ns / kSecond_ns));
  cdr.put(static_cast<std::uint32_t>(header.t_ns % kSecond_ns));
  cdr.put_text(header.frame);
}

/// Place, then turn about z.
void put_floor_pose(Cdr& cdr, const FloorPose& pose) {
  put_numbers(cdr, {pose.x_m, pose.y_m, 0.0, 0.0, 0.0, std::sin(0.5 * pose.yaw_rad), std::cos(0.5 * pose.yaw_rad)});
}

void put_marker(Cdr& cdr, const Header& header, const Marker& marker) {
  constexpr std::int32_t kAdd = 0, kDelete = 2;
  const bool is_sphere = marker.type == Marker::kSphere;
  const Eigen::Vector3d centre = is_sphere && !marker.places.empty() ? marker.places[0] : Eigen::Vector3d::Zero();
  const double thick_m = is_sphere ? marker.size_m : 0.0;  // of lines x alone is their width
  put_header(cdr, header);
  cdr.put_text(marker.what);
  cdr.put(std::int32_t{0});  // id
  cdr.put(std::int32_t{marker.type});
  cdr.put(marker.is_there ? kAdd : kDelete);
  put_numbers(cdr, {centre.x(), centre.y(), centre.z(), 0.0, 0.0, 0.0, 1.0});
  put_numbers(cdr, {marker.size_m, thick_m, thick_m});
  for (const float part : marker.colour) cdr.put(part);
  cdr.put(std::int32_t{0});  // lifetime: until another takes its place
  cdr.put(std::uint32_t{0});
  cdr.put(false);  // frame_locked
  cdr.put_length(is_sphere ? 0 : marker.places.size());
  if (!is_sphere)
    for (const Eigen::Vector3d& place : marker.places) put_numbers(cdr, {place.x(), place.y(), place.z()});
  cdr.put_length(0);    // colors
  cdr.put_text("");     // texture_resource
  put_header(cdr, {});  // texture
  cdr.put_text("");
  cdr.put_length(0);
  cdr.put_length(0);                             // uv_coordinates
  for (int i = 0; i < 3; ++i) cdr.put_text("");  // text, mesh_resource, mesh_file.filename
  cdr.put_length(0);
  cdr.put(false);  // mesh_use_embedded_materials
}

}  // namespace

Schema standard_schema(std::string_view type) {
  const std::string name(type);
  const auto slash = name.find('/');
  Schema schema{name.substr(0, slash) + "/msg" + name.substr(slash), std::string(definition_of(type)->text)};
  std::vector<const Definition*> rest;
  add_types_of(schema.text, rest);
  for (const Definition* const definition : rest)
    schema.text += fmt::format("{:=<80}\nMSG: {}\n{}", "", definition->type, definition->text);
  return schema;
}

void write_transform(Cdr& cdr, const Header& header, const std::string& child_frame, const FloorPose& pose) {
  cdr.begin();
  cdr.put_length(1);
  put_header(cdr, header);
  cdr.put_text(child_frame);
  put_floor_pose(cdr, pose);
}

void write_pose(Cdr& cdr, const Header& header, const FloorPose& pose) {
  cdr.begin();
  put_header(cdr, header);
  put_floor_pose(cdr, pose);
}

void write_markers(Cdr& cdr, const Header& header, const std::vector<Marker>& markers) {
  cdr.begin();
  cdr.put_length(markers.size());
  for (const Marker& marker : markers) put_marker(cdr, header, marker);
}

namespace {

using log::CellKind;
using log::StreamColumn;

const char* type_of(CellKind kind) {
  constexpr std::array kTypes{"int64", "bool", "float64", "uint8", "string"};
  static_assert(kTypes.size() == static_cast<std::size_t>(CellKind::kText) + 1);
  return kTypes.at(static_cast<std::size_t>(kind));
}

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

/// Of a table's name in the plural: "kick_decision", "session_policy", "loss"; "kicker_status" is none.
std::string singular(std::string name) {
  const auto drop = [&](std::size_t n) { name.resize(name.size() - n); };
  if (name.ends_with("ies")) {
    drop(3);
    name += 'y';
  } else if (name.ends_with("sses")) {
    drop(2);
  } else if (name.ends_with("s") && !name.ends_with("us") && !name.ends_with("ss")) {
    drop(1);
  }
  return name;
}

std::string in_camel_case(const std::string& name) {
  std::string text;
  bool begins = true;
  for (const char c : name) {
    if (c != '_') text += begins ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    begins = c == '_';
  }
  return text;
}

/// NaN says it of a number, has_NAME of all else.
bool says_whether_there(const StreamColumn& column) { return column.may_be_null && column.kind != CellKind::kNumber; }

std::uint8_t number_of(const StreamColumn& column, const std::string& label) {
  const auto at = std::ranges::find(column.labels, label);
  return at == column.labels.end() ? kOtherLabel : static_cast<std::uint8_t>(at - column.labels.begin());
}

/// What stands for NULL where has_NAME is false: 0 and "".
template <class T>
T there(const log::Value& cell, std::size_t place) {
  if (std::holds_alternative<std::monostate>(cell)) return {};
  return log::cell_as<T>(cell, place);
}

void write_cell(Cdr& cdr, const StreamColumn& column, const log::Value& cell, std::size_t place) {
  const bool is_null = std::holds_alternative<std::monostate>(cell);
  if (is_null && !column.may_be_null) throw log::WrongCell{place, "there"};
  if (says_whether_there(column)) cdr.put(!is_null);
  switch (column.kind) {
    case CellKind::kInteger:
      return cdr.put(there<std::int64_t>(cell, place));
    case CellKind::kTruth:
      return cdr.put(there<bool>(cell, place));
    case CellKind::kNumber:
      return cdr.put(is_null ? std::numeric_limits<double>::quiet_NaN() : log::cell_as<double>(cell, place));
    case CellKind::kLabel:
      return cdr.put(is_null ? std::uint8_t{0} : number_of(column, log::cell_as<std::string>(cell, place)));
    default:
      return cdr.put_text(there<std::string>(cell, place));
  }
}

}  // namespace

Schema schema_of(const log::StreamTable& table) {
  std::string text = fmt::format("# {}\n", table.meaning);
  for (const StreamColumn& column : table.columns) {
    for (std::size_t i = 0; i < column.labels.size(); ++i)
      text += fmt::format("uint8 {}_{}={}\n", upper(column.name), upper(column.labels[i]), i);
    if (!column.labels.empty()) text += fmt::format("uint8 {}_OTHER_LABEL={}\n", upper(column.name), kOtherLabel);
    if (says_whether_there(column)) text += fmt::format("bool has_{}\n", column.name);
    text += fmt::format("{} {}  # {}\n", type_of(column.kind), column.name, column.meaning);
  }
  return {"trivela_msgs/msg/" + in_camel_case(singular(table.name)), text};
}

void write_row(Cdr& cdr, const log::StreamTable& table, std::span<const log::Value> row) {
  cdr.begin();
  for (std::size_t i = 0; i < row.size(); ++i) write_cell(cdr, table.columns[i], row[i], i);
}

}  // namespace trivela::evaluator::mcap
