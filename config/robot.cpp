#include "config/robot.hpp"

#include <fmt/core.h>

#include "config/robot_fields.hpp"
#include "config/toml_source.hpp"
#include "config/toml_text.hpp"

namespace trivela::config {

namespace {

kicking::EffectiveTable table_of(const TableColumns& columns, const std::string& file) {
  if (columns.kind != kicking::TableKind::kEffective) {
    throw Error{fmt::format(
        "{}: table.kind = \"true\": the policies' laws are drag-free and need an \"effective\" table", file)};
  }
  if (columns.powers.size() != columns.exit_speeds_mps.size()) {
    throw Error{fmt::format("{}: table.powers has {} entries, table.exit_speeds_mps {}", file, columns.powers.size(),
                            columns.exit_speeds_mps.size())};
  }
  std::vector<kicking::SetPoint> points;
  for (std::size_t i = 0; i < columns.powers.size(); ++i)
    points.push_back({columns.powers[i], columns.exit_speeds_mps[i]});
  try {
    return kicking::EffectiveTable{points};
  } catch (const std::invalid_argument& error) {
    throw Error{fmt::format("{}: table: {}", file, error.what())};
  }
}

}  // namespace

Robot load_robot(const std::filesystem::path& path) {
  RobotFile file;
  const TomlSource source = parse_file(path);
  read_into(source, file);
  file.robot.model.table = table_of(file.table, source.file);
  return file.robot;
}

std::string to_toml_text(const Robot& robot) {
  RobotFile file{robot, {}};
  for (const kicking::SetPoint& point : robot.model.table.set_points()) {
    file.table.powers.push_back(point.power);
    file.table.exit_speeds_mps.push_back(point.speed_mps);
  }
  return to_toml(file);
}

}  // namespace trivela::config
