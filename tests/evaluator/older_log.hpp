#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "evaluator/log/digest.hpp"
#include "evaluator/log/row_digest.hpp"

namespace trivela::evaluator {

/// A file that a program of an older version has made, without rows: `schema` is a file in evaluator/log.
inline SQLite::Database older_file(const std::filesystem::path& path, int application_id, int version,
                                   const std::string& schema) {
  std::filesystem::remove(path);
  SQLite::Database database(path.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  std::ifstream text(TRIVELA_SOURCE_DIR "/evaluator/log/" + schema);
  database.exec("PRAGMA application_id = " + std::to_string(application_id) +
                "; PRAGMA user_version = " + std::to_string(version));
  database.exec(std::string(std::istreambuf_iterator<char>(text), {}));
  return database;
}

/// Fills a log of an older version with rows of session 7.
struct OlderRows {
  SQLite::Database& database;
  int version;

  /// `new_columns` and `new_values`: what the table has since that version; 0: nothing.
  void insert(const std::string& table, const std::string& columns, const std::string& values, int since = 0,
              const std::string& new_columns = "", const std::string& new_values = "") const {
    const bool has_new = since > 0 && version >= since;
    database.exec("INSERT INTO " + table + " (session_id, " + columns + (has_new ? new_columns : "") + ") VALUES (7, " +
                  values + (has_new ? new_values : "") + ")");
  }
};

/// The session, with its texts.
inline void insert_session(const OlderRows& rows) {
  const int version = rows.version;
  const std::string config = "a = 1", idl = "struct X {};";
  if (version > 1) {
    for (const std::string& text : {config, idl})
      rows.database.exec("INSERT INTO texts VALUES ('" + log::sha256(text) + "', '" + text + "')");
  }
  rows.insert(
      "sessions",
      std::string("uuid, robot_id, started_t_ns, closed_t_ns, clock, realtime_offset_ns, seed, software_version, "
                  "scenario, simulated, config_sha256, ") +
          (version == 1 ? "config_toml, idl" : "idl_sha256"),
      "'00000000-0000-000e-8000-000000000000', 1, 0, 60000000000, 'simulated', 0, 3, '0.1', 'default', 1, '" +
          log::sha256(config) + (version == 1 ? "', '" + config + "', '" + idl + "'" : "', '" + log::sha256(idl) + "'"),
      4, ", paired_halves", ", 1");
  rows.insert("losses", "stream, received, lost, gaps, overflow, nan_refused, rejected, out_of_order",
              "'kick_orders', 2, 0, 0, 0, 0, 0, 0", 3, ", robot_id, from_t_ns", ", 0, 0");
}

/// Half a minute of play with one kick, which is on target.
inline void insert_half(const OlderRows& rows, int half) {
  const std::string n = std::to_string(half);
  const std::string start = std::to_string((half - 1) * 30) + "000000000";
  const std::string end = std::to_string(half * 30) + "000000000";
  const std::string policy = half == 1 ? "'stopped'" : rows.version == 1 ? "'moving'" : "'predictive'";
  rows.insert("session_policies", "half, policy", n + ", " + policy, 4, ", robot_id", ", 0");
  for (const bool playing : {true, false}) {
    rows.insert(
        "referee", "robot_id, seq, t_ns, half, playing, possession_id",
        "1, " + n + (playing ? "0, " : "1, ") + (playing ? start : end) + ", " + n + (playing ? ", 1, 1" : ", 0, 1"), 5,
        ", stage, restart, ours, goals_own, goals_other, command_counter", ", 'unknown', 'none', 0, 0, 0, 0");
  }
  rows.insert("odometry",
              "robot_id, seq, t_ns, vx_mps, vy_mps, omega_radps, x_m, y_m, heading_rad, var_v_m2ps2, "
              "var_omega_rad2ps2, var_position_m2, var_heading_rad2",
              "1, " + n + ", " + start + ", 0, 0, 0, 0, 0, 0, 0, 0, 0, 0", 6, ", obeyed", ", 'kick_decision'");
  rows.insert("kicker_status",
              "robot_id, seq, t_ns, charge, armed, ready, fault, last_kick_id, last_accepted, orders_handled, "
              "orders_refused",
              "1, " + n + ", " + start + ", 1, 1, 1, 'none', " + n + ", 1, " + n + ", 0", 6, ", state, charge_modelled",
              ", 'ready', 0");
  rows.insert(
      "kick_decisions",
      "robot_id, seq, t_ns, kick_id, half, possession_id, policy, fire, reason, x_m, y_m, heading_rad, vx_mps, "
      "vy_mps, omega_radps, target_x_m, target_y_m, target_z_m, distance_m, v0_mps, v_kick_mps, power, alpha_rad, "
      "beta_rad, aligned, offset_right_m, left_m, right_m, predicted_x_cross_m, predicted_z_cross_m, "
      "predicted_t_flight_s, opponent_distance_m, charge, shadow_count",
      "1, " + n + ", " + start + ", " + n + ", " + n + ", 1, " + policy +
          ", 1, 'fire', 0, 3, 0, 0, 0, 0, 0, 9, 0.7, 5.7, 8, 8, 20, 0, 0, 1, 0, 0.1, 0.1, 0, 0.7, 0.8, 2, 1, 0",
      2, ", p_on_target, fire_after_s, assignment_probability", ", 0.9, 0, 1");
  rows.insert("kick_orders", "robot_id, seq, t_ns, kick_id, power, fire_t_ns, valid_until_t_ns",
              "1, " + n + ", " + start + ", " + n + ", 20, " + start + ", " + end, 6, ", possession", ", 1");
  rows.insert("kick_receipts",
              "robot_id, seq, t_ns, kick_id, accepted, refusal, order_t_ns, fired_t_ns, release_t_ns, power",
              "1, " + n + ", " + start + ", " + n + ", 1, 'none', " + start + ", " + start + ", " + end + ", 20", 3,
              ", received_steady_ns, fired_steady_ns", ", 0, 0");
  rows.insert("kick_outcomes",
              "robot_id, seq, t_ns, kick_id, outcome, on_target, x_cross_m, z_cross_m, sd_cross_m, observations, "
              "exit_speed_mps, exit_elevation_rad",
              "1, " + n + ", " + end + ", " + n + ", 'on_target', 1, 0, 0.7, 0.05, 20, 8, 0.6");
  rows.insert(
      "kick_truths",
      "robot_id, seq, t_ns, kick_id, half, possession_id, outcome, x_cross_m, z_cross_m, release_t_ns, "
      "release_x_m, release_y_m, release_vx_mps, release_vy_mps, release_vz_mps, margin_m",
      "1, " + n + ", " + end + ", " + n + ", " + n + ", 1, 'on_target', 0, 0.7, " + start + ", 0, 3, 0, 6, 4, 0.3", 2,
      ", saved", ", 0");
}

/// A closed session in a match log of version 1 to 7, with a kick on target of each of two policies, in half a
/// minute each.
inline std::filesystem::path older_match_log(const std::filesystem::path& path, int version) {
  SQLite::Database database =
      older_file(path, 0x4B49434B, version, "schema_version_" + std::to_string(version) + ".sql");
  const OlderRows rows{database, version};
  insert_session(rows);
  for (const int half : {1, 2}) insert_half(rows, half);
  if (version >= log::kFirstWithDigests) log::RowDigests(database, version).write(7);
  return path;
}

}  // namespace trivela::evaluator
