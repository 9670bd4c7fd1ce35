#include "log/schema/schema.hpp"

#include <fmt/format.h>

#include <cctype>
#include <regex>

#include "kicking/policy/policy.hpp"
#include "log/schema/bind.hpp"
#include "log/schema/reading_views.sql.hpp"
#include "log/schema/row.hpp"
#include "log/schema/scan_schema.sql.hpp"
#include "log/schema/schema.sql.hpp"

namespace trivela::log {

namespace {

/// Key of a text that the log holds from now on.
const std::string& store(SQLite::Database& database, const std::string& text, Digests& digests) {
  const std::string& key = digests.of(text);
  run(database, "INSERT OR IGNORE INTO texts (sha256, text) VALUES (?, ?)", key, text);
  return key;
}

/// The view `kicks` of the schema as a view of the connection. It asks the file's own tables, also where a view of the
/// connection stands before one of them.
std::string own_kicks() {
  static const std::string head = "CREATE VIEW kicks AS";
  static const std::regex table("(FROM|JOIN) (kick_[a-z]+)");
  const std::string schema(kSchemaSql);
  const std::string body = schema.substr(schema.find(head) + head.size());
  return "CREATE TEMP VIEW kicks AS" + std::regex_replace(body, table, "$1 main.$2");
}

}  // namespace

std::string_view schema_of(const LogKind& kind) {
  if (kind.application_id == kScanRecord.application_id) return kScanSchemaSql;
  return kSchemaSql;
}

std::optional<std::string> table_of_message(std::string_view type) {
  std::string name;
  for (const char c : type) {
    if (std::isupper(c) != 0 && !name.empty()) name += '_';
    name += static_cast<char>(std::tolower(c));
  }
  for (const char* const ending : {"", "s"}) {
    const std::string table = name + ending;
    if (std::string_view(kSchemaSql).find("CREATE TABLE " + table + " (") != std::string_view::npos) return table;
  }
  return std::nullopt;
}

namespace {

/// The view policy_order: policies with their place in every list.
std::string policy_order() {
  std::string rows;
  for (std::size_t place = 0; place < kicking::kPolicyCount; ++place)
    rows += fmt::format("{}('{}', {})", place == 0 ? "" : ", ", kicking::kPolicyFacts[place].name, place);
  return fmt::format("CREATE TEMP VIEW policy_order (policy, place) AS VALUES {};", rows);
}

}  // namespace

void create_reading_views(SQLite::Database& database) {
  database.exec(own_kicks());
  database.exec(policy_order());
  database.exec(kReadingViewsSql);
}

void create_tables(SQLite::Database& database) {
  database.exec(fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {};", kMatchLog.application_id,
                            kMatchLog.version));
  database.exec(std::string(kSchemaSql));
  database.exec("ANALYZE");  // its table now, while the schema lies in front: of a file that was cut the schema is read
}

namespace {

/// What a session has several of.
void insert_lists(SQLite::Database& database, const Session& session, std::int64_t session_id) {
  for (const DriverCount& driver : session.continued) {
    run(database, "INSERT INTO continued (session_id, robot_id, orders_handled, orders_refused) VALUES (?, ?, ?, ?)",
        session_id, driver.robot_id, driver.orders_handled, driver.orders_refused);
  }
  for (const HalfPolicy& half : session.policies) {
    run(database, "INSERT INTO session_policies (session_id, robot_id, half, policy) VALUES (?, ?, ?, ?)", session_id,
        half.robot_id, half.half, half.policy);
  }
}

}  // namespace

void insert_session(SQLite::Database& database, const Session& session, std::optional<std::int64_t> closed_t_ns,
                    Digests& digests) {
  const std::int64_t session_id = session_id_of(session.uuid);
  const std::string &config = store(database, session.config_toml, digests),
                    &idl = store(database, session.idl, digests);
  run(database,
      "INSERT INTO sessions (session_id, uuid, robot_id, started_t_ns, closed_t_ns, clock, realtime_offset_ns, "
      "config_sha256, seed, software_version, scenario, simulated, idl_sha256, arm, kicker_table, match_id, "
      "continues_uuid, replays_uuid, paired_halves, planned_s, calibration_id) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, "
      "?, ?, ?, ?, ?, ?, nullif(?, ''), nullif(?, ''), ?, ?, ?)",
      session_id, session.uuid, session.robot_id, session.started_t_ns, closed_t_ns,
      session.simulated_clock ? "simulated" : "steady", session.realtime_offset_ns, config, session.seed,
      session.software_version, session.scenario, session.simulated, idl, session.arm, session.kicker_table,
      session.match_id, session.continues_uuid, session.replays_uuid, session.paired_halves, session.planned_s,
      session.calibration_id);
  insert_lists(database, session, session_id);
}

void create_log(SQLite::Database& database, const Session& session) {
  SQLite::Transaction transaction(database);
  create_tables(database);
  Digests digests;
  insert_session(database, session, std::nullopt, digests);
  transaction.commit();
}

std::vector<std::string> tables_of(SQLite::Database& database) {
  SQLite::Statement query(database, "SELECT name FROM sqlite_schema WHERE type = 'table' ORDER BY name");
  std::vector<std::string> names;
  while (query.executeStep()) names.push_back(query.getColumn(0).getString());
  return names;
}

std::optional<std::vector<Column>> columns_of(SQLite::Database& database, std::string_view table) {
  std::string quoted;
  for (const char c : table) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  // The statement, not the function pragma_table_info(), in whose place a file may have a table.
  SQLite::Statement query(database, fmt::format("PRAGMA table_info(\"{}\")", quoted));
  std::vector<Column> columns;
  while (query.executeStep())
    columns.push_back({query.getColumn("name").getString(), query.getColumn("notnull").getInt() != 0,
                       !query.getColumn("dflt_value").isNull()});
  if (columns.empty()) return std::nullopt;
  return columns;
}

}  // namespace trivela::log
