#include "config/robot.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "config/robot_fields.hpp"
#include "config/text/toml_source.hpp"
#include "config/text/toml_text.hpp"

namespace trivela::config {

namespace {

void require_as_long(const TableColumns& columns, const char* key, std::size_t entries, const std::string& file) {
  if (columns.powers.size() == entries) return;
  throw Error{fmt::format("{}: table.powers has {} entries, table.{} {}", file, columns.powers.size(), key, entries)};
}

/// The columns as a table of set-points. Throws Error naming the file.
template <class Table>
Table table_of(const TableColumns& columns, const std::string& file) {
  require_as_long(columns, "exit_speeds_mps", columns.exit_speeds_mps.size(), file);
  std::vector<kicking::SetPoint> points;
  for (std::size_t i = 0; i < columns.powers.size(); ++i)
    points.push_back({columns.powers[i], columns.exit_speeds_mps[i]});
  try {
    return Table{std::span<const kicking::SetPoint>(points)};
  } catch (const std::invalid_argument& error) {
    throw Error{fmt::format("{}: table: {}", file, error.what())};
  }
}

std::optional<kicking::AngleTable> angles_of(const TableColumns& columns, const std::string& file) {
  if (!columns.exit_angles_deg) return std::nullopt;
  require_as_long(columns, "exit_angles_deg", columns.exit_angles_deg->size(), file);
  std::vector<kicking::AnglePoint> points;
  for (std::size_t i = 0; i < columns.powers.size(); ++i)
    points.push_back({columns.powers[i], kicking::radians((*columns.exit_angles_deg)[i])});
  return kicking::AngleTable{points};
}

/// Throws Error naming the file where the heights are not whole, or not all the same.
std::optional<std::uint8_t> lever_of(const TableColumns& columns, const std::string& file) {
  if (!columns.levers) return std::nullopt;
  require_as_long(columns, "levers", columns.levers->size(), file);
  const double height = columns.levers->front();
  for (std::size_t i = 0; i < columns.levers->size(); ++i) {
    const double other = (*columns.levers)[i];
    if (other != std::round(other)) throw Error{fmt::format("{}: table.levers[{}] = {} is no step", file, i, other)};
    if (other != height)
      throw Error{
          fmt::format("{}: table.levers[{}] = {}, but [0] = {}: the lever is too slow to move before a kick; make a "
                      "table for each of its heights",
                      file, i, other, height)};
  }
  return static_cast<std::uint8_t>(height);
}

/// The columns as a height table. Throws Error naming the file.
kicking::DistanceTable height_table_of(const DistanceColumns& columns, const std::string& file) {
  if (columns.distances_m.size() != columns.powers.size()) {
    throw Error{fmt::format("{}: height_table.distances_m has {} entries, height_table.powers {}", file,
                            columns.distances_m.size(), columns.powers.size())};
  }
  kicking::DistanceTable table;
  for (std::size_t i = 0; i < columns.powers.size(); ++i)
    table.points.push_back({columns.distances_m[i], columns.powers[i]});
  return table;
}

Robot with_height_table(Robot robot, const Settings& settings, const std::string& whose) try {
  robot.model = kicking::with_distance_table(robot.model, *robot.height_table, height_table_law(settings),
                                             settings.policy.target_height_m);
  return robot;
} catch (const std::invalid_argument& error) {
  throw Error{fmt::format("{}: height_table: {}", whose, error.what())};
}

/// The kinds of kick beside the first. Throws Error naming the file and the kind.
void take_kinds(const RobotFile& file, Robot& robot, const std::string& name) {
  if (file.kinds.size() + 1 > kicking::kMostKickKinds)
    throw Error{fmt::format("{}: a robot has {} kinds of kick at most", name, kicking::kMostKickKinds)};
  for (const KindFile& of : file.kinds) {
    const std::string which = fmt::format("{}: kinds[{}]", name, robot.kinds.size());
    if (!of.table) throw Error{which + " has no [kinds.table]"};
    if (of.table->kind != kicking::TableKind::kEffective) throw Error{which + ": table.kind must be \"effective\""};
    const kicking::RobotModel& first = robot.model;
    if (of.model.ball_offset_m != first.ball_offset_m || of.model.ball.radius_m != first.ball.radius_m ||
        of.model.ball.mass_kg != first.ball.mass_kg)
      throw Error{which + ": ball and ball_offset_m are the robot's: they stand in [kicker] alone"};
    kicking::RobotModel model = of.model;
    model.table = table_of<kicking::EffectiveTable>(*of.table, which);
    model.exit_angles = angles_of(*of.table, which);
    robot.kinds.push_back(of.kind);
    robot.kinds.back().lever = lever_of(*of.table, which);
    if (robot.kinds.back().lever.has_value() != robot.lever.has_value())
      throw Error{which + ": either each kind of kick has table.levers, or none"};
    robot.model.further_kinds.push_back(std::move(model));
  }
}

template <class Table>
void write_table(const Table& table, TableColumns& columns) {
  columns.kind = Table::kKind;
  for (const kicking::SetPoint& point : table.set_points()) {
    columns.powers.push_back(point.power);
    columns.exit_speeds_mps.push_back(point.speed_mps);
  }
}

/// Table, exit angles and lever of a kind of kick.
TableColumns columns_of(const kicking::RobotModel& model, const std::optional<kicking::TrueTable>& true_table,
                        std::optional<std::uint8_t> lever) {
  TableColumns table;
  if (true_table) {
    write_table(*true_table, table);
  } else {
    write_table(model.table, table);
  }
  if (lever) table.levers.emplace(table.powers.size(), static_cast<double>(*lever));
  if (model.exit_angles) {
    auto& angles_deg = table.exit_angles_deg.emplace();
    for (const kicking::AnglePoint& point : model.exit_angles->points())
      angles_deg.push_back(std::round(kicking::degrees(point.exit_angle_rad) * 1e9) / 1e9);  // rad holds no more
  }
  return table;
}

}  // namespace

Robot load_robot_of_any_table(const std::filesystem::path& path) {
  RobotFile file;
  const TomlSource source = parse_file(path);
  read_into(source, file);
  Robot& robot = file.robot;
  if (file.table.has_value() == file.height_table.has_value()) {
    throw Error{fmt::format("{}: a robot needs one table: [table] (exit speeds) or [height_table] (distances){}",
                            source.file, file.table ? ", not both" : "")};
  }
  if (file.height_table && !file.kinds.empty())
    throw Error{fmt::format("{}: a robot with [height_table] has no further [[kinds]]", source.file)};
  if (file.height_table) {
    robot.height_table = height_table_of(*file.height_table, source.file);
    return with_height_table(robot, {}, source.file);
  }
  const TableColumns& table = *file.table;
  if (table.kind == kicking::TableKind::kTrue) {
    robot.true_table = table_of<kicking::TrueTable>(table, source.file);
  } else {
    robot.model.table = table_of<kicking::EffectiveTable>(table, source.file);
  }
  robot.model.exit_angles = angles_of(table, source.file);
  robot.lever = lever_of(table, source.file);
  take_kinds(file, robot, source.file);
  return robot;
}

Robot load_robot(const std::filesystem::path& path) {
  Robot robot = load_robot_of_any_table(path);
  if (robot.true_table) {
    throw Error{fmt::format(
        "{}: table.kind = \"true\": the policies' laws are drag-free and need an \"effective\" table", path.string())};
  }
  return robot;
}

std::vector<std::string> defaulted_figures(const std::filesystem::path& path) {
  const TomlSource source = parse_file(path);
  std::vector<std::string> missing;
  const auto look = [&](const std::string& table, const std::string& key) {
    if (source.root.at_path(table + key)) return;
    std::string what = table + key;
    for (auto dot = key.rfind('.'); dot != std::string::npos; dot = key.rfind('.', dot - 1))
      if (const std::string whole = table + key.substr(0, dot); !source.root.at_path(whole)) what = whole;
    if (std::ranges::find(missing, what) == missing.end()) missing.push_back(what);
  };
  const toml::array* const kinds = source.root["kinds"].as_array();
  for (const auto& [key, value] : values_in(to_toml(RobotFile{}))) {
    if (value == "0.0" || key.find('.') == std::string::npos) continue;
    const bool of_lever = key == "kicker.lever_s";
    if (kinds != nullptr || !of_lever) look("", key);
    if (!key.starts_with("kicker.") || key.starts_with("kicker.ball") || of_lever) continue;
    for (std::size_t i = 0; kinds != nullptr && i < kinds->size(); ++i) look(fmt::format("kinds[{}].", i), key);
  }
  return missing;
}

kicking::HeightLaw height_table_law(const Settings& settings) {
  const auto by_law = [](kicking::PolicyName policy) { return facts(policy).kind == kicking::PolicyKind::kPlay; };
  const KickDecision& decision = settings.kick_decision;
  const bool some = decision.random.empty() ? std::ranges::any_of(decision.policy_by_half, by_law) ||
                                                  std::ranges::any_of(decision.policy_by_robot, by_law)
                                            : std::ranges::any_of(decision.random, by_law);
  return some ? settings.policy.height_law : kicking::HeightLaw::kExact;
}

Robot robot_for(Robot robot, const Settings& settings) {
  if (!robot.height_table) return robot;
  const std::string whose =
      fmt::format("robot {} with policy.target_height_m = {}", robot.name, settings.policy.target_height_m);
  return with_height_table(std::move(robot), settings, whose);
}

Hal hal_for(Hal devices, const Robot& robot) {
  auto* const board = std::get_if<IoBoardDevice>(&devices.kicker);
  if (board == nullptr || !robot.lever) return devices;
  if (board->lever && *board->lever != *robot.lever)
    throw Error{fmt::format("hal.ioboard.lever = {}, but the table of robot {} was measured with the lever at {}",
                            *board->lever, robot.name, *robot.lever)};
  board->lever = robot.lever;
  if (!robot.kinds.empty()) {
    board->levers = {*robot.lever};
    for (const KickKind& kind : robot.kinds) board->levers.push_back(*kind.lever);
    board->lever_s = robot.model.lever_s;
  }
  return devices;
}

std::string to_toml_text(const Robot& robot) {
  RobotFile file{robot, {}, {}, {}};
  for (std::size_t i = 0; i < robot.kinds.size(); ++i) {
    const kicking::RobotModel& model = robot.model.kind(i + 1);
    file.kinds.push_back({robot.kinds[i], model, columns_of(model, {}, robot.kinds[i].lever)});
  }
  if (robot.height_table) {
    auto& columns = file.height_table.emplace();
    for (const kicking::DistancePoint& point : robot.height_table->points) {
      columns.distances_m.push_back(point.distance_m);
      columns.powers.push_back(point.power);
    }
    return to_toml(file);
  }
  file.table = columns_of(robot.model, robot.true_table, robot.lever);
  return to_toml(file);
}

}  // namespace trivela::config
