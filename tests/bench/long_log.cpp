// Match logs as long as a tournament: one recorded match many times over, each copy a session of its own.
//   long_log match.db long.db --copies 36
#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>

#include "log/file/new_file.hpp"
#include "log/file/session_tallies.hpp"
#include "log/schema/digest.hpp"
#include "log/schema/row_digest.hpp"
#include "log/schema/schema.hpp"

namespace {

using namespace trivela::log;

constexpr std::int64_t kApart_ns = 7'200'000'000'000;  // starts of two matches

/// The columns of a table but its key, each as it is in the recorded match.
std::string other_columns(SQLite::Database& database, const std::string& table) {
  std::string names;
  const auto columns = columns_of(database, table).value();
  for (const Column& column : columns)
    if (column.name != "session_id") names += ", " + column.name;
  return names;
}

/// The session and its rows once more: another match of another seed, hours later.
void copy_session(SQLite::Database& database, std::int64_t session_id, int copy) {
  const std::string uuid = make_uuid();
  const std::int64_t other_id = session_id_of(uuid);
  for (const StreamTable& table : digested_tables()) {
    if (table.name == "sessions") continue;
    const std::string columns = other_columns(database, table.name);
    database.exec(
        fmt::format("INSERT INTO main.{0} (session_id{1}) SELECT {2}{1} FROM recorded.{0} WHERE session_id = "
                    "{3} ORDER BY {4}",
                    table.name, columns, other_id, session_id, table.key));
  }
  std::string values = other_columns(database, "sessions");
  const auto change = [&](const std::string& column, const std::string& value) {
    values.replace(values.find(", " + column) + 2, column.size(), value);
  };
  change("uuid", "'" + uuid + "'");
  change("realtime_offset_ns", fmt::format("realtime_offset_ns + {}", copy * kApart_ns));
  change("seed", fmt::format("seed + {}", copy));
  database.exec(
      fmt::format("INSERT INTO main.sessions (session_id{}) SELECT {}{} FROM recorded.sessions WHERE "
                  "session_id = {}",
                  other_columns(database, "sessions"), other_id, values, session_id));
  RowDigests(database).write(other_id);
  write_tallies(database, other_id);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"One recorded match many times over"};
  std::string from, to;
  int copies = 1;
  app.add_option("match", from, "Match log of this version with one session")->required();
  app.add_option("out", to, "The long log, must not exist")->required();
  app.add_option("--copies", copies, "Sessions")->check(CLI::Range(1, 10000));
  CLI11_PARSE(app, argc, argv);
  const auto database = new_file(to, kMatchLog, [&](SQLite::Database& made) {
    made.exec("PRAGMA synchronous = OFF; PRAGMA cache_size = -65536;");
    create_tables(made);
    SQLite::Statement attach(made, "ATTACH ? AS recorded");
    attach.bind(1, from);
    attach.exec();
    made.exec("INSERT INTO main.texts SELECT * FROM recorded.texts");
    const std::int64_t session_id = made.execAndGet("SELECT session_id FROM recorded.sessions").getInt64();
    for (int copy = 0; copy < copies; ++copy) {
      SQLite::Transaction transaction(made);
      copy_session(made, session_id, copy);
      transaction.commit();
    }
    attach.reset();
    made.exec("DETACH recorded");
  });
  fold(*database);
  fmt::print("{}: {} sessions, {} rows\n", to, copies,
             SQLite::Database(to).execAndGet("SELECT sum(row_count) FROM digests").getInt64());
}
