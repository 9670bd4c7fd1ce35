#include "evaluator/log/reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "evaluator/log/log_file.hpp"
#include "evaluator/log/row_digest.hpp"
#include "evaluator/log/soundness.hpp"

namespace trivela::evaluator::log {
namespace {

std::optional<double> number_of(const Value& value) {
  const auto* const number = std::get_if<double>(&value);
  return number != nullptr ? std::optional(*number) : std::nullopt;
}

std::optional<std::int64_t> integer_of(const Value& value) {
  const auto* const integer = std::get_if<std::int64_t>(&value);
  return integer != nullptr ? std::optional(*integer) : std::nullopt;
}

std::string text_of(const Value& value) {
  const auto* const text = std::get_if<std::string>(&value);
  return text != nullptr ? *text : std::string();
}

std::optional<Crossing> crossing_of(const Value& outcome, const Value& x_cross_m, const Value& z_cross_m) {
  if (!std::holds_alternative<std::string>(outcome)) return std::nullopt;
  return Crossing{text_of(outcome), number_of(x_cross_m), number_of(z_cross_m)};
}

}  // namespace

struct Reader::Impl {
  Impl(const std::filesystem::path& path, Check check) : file(path, kMatchLog, check) {
    create_reading_views(file.database(), file.version());
    file.query("BEGIN", [](auto) {});  // a log may grow meanwhile
    check_texts(file);
    verification = file.looks_at_everything() ? verify(file) : unverified(file);
    file.query("COMMIT", [](auto) {});
  }

  LogFile file;
  Verification verification;
};

Reader::Reader(const std::filesystem::path& path, Check check) : impl_(std::make_unique<Impl>(path, check)) {}
Reader::~Reader() = default;

int Reader::version() const { return impl_->file.version(); }

const Verification& Reader::verification() const { return impl_->verification; }

std::optional<std::string> Reader::doubt() const {
  const Verification& found = impl_->verification;
  if (impl_->file.version() < kFirstWithDigests)
    return fmt::format("not verified: a match log of version {} has no digests", impl_->file.version());
  if (!found.compared && found.rows > 0)
    return fmt::format("not verified: {} rows; trivela report --verify", found.rows);
  if (found.without_digest > 0)
    return fmt::format("not verified: {} that never ended and so {} no digest",
                       found.without_digest == 1 ? "a session" : fmt::format("{} sessions", found.without_digest),
                       found.without_digest == 1 ? "has" : "have");
  return std::nullopt;
}

void Reader::leave_out(const std::vector<std::int64_t>& session_ids, const std::vector<RecordedKick>& kicks) const {
  SQLite::Database& database = impl_->file.database();
  SQLite::Statement session(database, "INSERT OR IGNORE INTO temp.left_out_sessions VALUES (?)");
  for (const std::int64_t session_id : session_ids) {
    session.bind(1, session_id);
    session.exec();
    session.reset();
  }
  SQLite::Statement insert(database, "INSERT OR IGNORE INTO temp.left_out_kicks VALUES (?, ?, ?)");
  for (const RecordedKick& kick : kicks) {
    insert.bind(1, kick.session_id);
    insert.bind(2, kick.robot_id);
    insert.bind(3, kick.kick_id);
    insert.exec();
    insert.reset();
  }
}

void Reader::query(std::string_view sql, const RowFunction& fn) const { impl_->file.query(sql, fn); }

void Reader::for_each_row(std::string_view table, const std::vector<std::string>& columns,
                          const RowFunction& fn) const {
  const auto schema = columns_of(impl_->file.database(), table);
  if (!schema) throw std::runtime_error(fmt::format("the match log {} has no table '{}'", impl_->file.path(), table));
  const auto has = [&](const std::string& name) {
    return std::ranges::find(*schema, name, &Column::name) != schema->end();
  };
  for (const std::string& column : columns) {
    if (has(column)) continue;
    throw std::runtime_error(fmt::format("table '{}' of {} has no column '{}'", table, impl_->file.path(), column));
  }
  std::vector<std::string> order;
  for (const char* const key : {"session_id", "robot_id", "seq", "shadow_index"}) {
    if (has(key)) order.push_back(key);
  }
  query(fmt::format("SELECT {} FROM {}{}{}", fmt::join(columns, ", "), table, order.empty() ? "" : " ORDER BY ",
                    fmt::join(order, ", ")),
        fn);
}

std::vector<RecordedSession> Reader::sessions() const {
  std::vector<RecordedSession> sessions;
  query(
      "SELECT session_id, uuid, robot_id, started_t_ns, closed_t_ns, clock, realtime_offset_ns, idl_sha256, "
      "config_sha256, seed, software_version, scenario, simulated, arm, kicker_table, match_id, "
      "continues_uuid, replays_uuid, paired_halves, planned_s, calibration_id "
      "FROM sessions ORDER BY started_t_ns, session_id",
      [&](std::span<const Value> row) {
        RecordedSession session;
        session.session_id = *integer_of(row[0]);
        session.uuid = text_of(row[1]);
        if (const auto robot_id = integer_of(row[2])) session.robot_id = static_cast<int>(*robot_id);
        session.started_t_ns = *integer_of(row[3]);
        session.closed_t_ns = integer_of(row[4]);
        session.simulated_clock = text_of(row[5]) == "simulated";
        session.realtime_offset_ns = *integer_of(row[6]);
        session.idl_sha256 = text_of(row[7]);
        session.config_sha256 = text_of(row[8]);
        session.seed = integer_of(row[9]);
        session.software_version = text_of(row[10]);
        session.scenario = text_of(row[11]);
        session.simulated = *integer_of(row[12]) != 0;
        if (!text_of(row[13]).empty()) session.arm = text_of(row[13]);
        if (!text_of(row[14]).empty()) session.kicker_table = text_of(row[14]);
        session.match_id = integer_of(row[15]);
        session.continues_uuid = text_of(row[16]);
        session.replays_uuid = text_of(row[17]);
        session.paired_halves = *integer_of(row[18]) != 0;
        session.planned_s = number_of(row[19]);
        session.calibration_id = integer_of(row[20]);
        sessions.push_back(std::move(session));
      });
  for_each_row("session_policies", {"session_id", "half", "policy", "robot_id"}, [&](std::span<const Value> row) {
    const auto session = std::ranges::find(sessions, *integer_of(row[0]), &RecordedSession::session_id);
    if (session == sessions.end()) return;
    session->policies.push_back(
        {static_cast<int>(*integer_of(row[1])), text_of(row[2]), static_cast<int>(*integer_of(row[3]))});
  });
  return sessions;
}

RecordedSession Reader::whole(RecordedSession session) const {
  query(fmt::format(
            "SELECT config.text, idl.text FROM sessions LEFT JOIN texts AS config ON config.sha256 = config_sha256 "
            "LEFT JOIN texts AS idl ON idl.sha256 = idl_sha256 WHERE session_id = {}",
            session.session_id),
        [&](std::span<const Value> row) {
          session.config_toml = text_of(row[0]);
          session.idl = text_of(row[1]);
        });
  return session;
}

std::vector<Kick> Reader::kicks() const {
  std::vector<Kick> kicks;
  query(
      "SELECT session_id, robot_id, kick_id, t_ns, half, possession_id, policy, order_seq, accepted, refusal, outcome, "
      "x_cross_m, z_cross_m, sd_cross_m, truth_outcome, truth_x_cross_m, truth_z_cross_m, truth_margin_m FROM kicks "
      "ORDER BY session_id, t_ns, robot_id",
      [&](std::span<const Value> row) {
        Kick kick;
        kick.session_id = *integer_of(row[0]);
        kick.robot_id = static_cast<int>(*integer_of(row[1]));
        kick.kick_id = *integer_of(row[2]);
        kick.t_ns = *integer_of(row[3]);
        kick.half = static_cast<int>(*integer_of(row[4]));
        kick.possession_id = *integer_of(row[5]);
        kick.policy = text_of(row[6]);
        kick.ordered = integer_of(row[7]).has_value();
        if (const auto accepted = integer_of(row[8])) kick.accepted = *accepted != 0;
        kick.refusal = text_of(row[9]);
        kick.observed = crossing_of(row[10], row[11], row[12]);
        kick.sd_cross_m = number_of(row[13]);
        kick.truth = crossing_of(row[14], row[15], row[16]);
        kick.truth_margin_m = number_of(row[17]);
        kicks.push_back(std::move(kick));
      });
  return kicks;
}

std::vector<Loss> Reader::losses() const {
  std::vector<Loss> losses;
  query(
      "SELECT stream, sum(received), sum(lost), sum(gaps), sum(overflow), sum(nan_refused), sum(rejected), "
      "sum(out_of_order) FROM losses GROUP BY stream ORDER BY stream",
      [&](std::span<const Value> row) {
        losses.push_back({.stream = text_of(row[0]),
                          .received = *integer_of(row[1]),
                          .lost = *integer_of(row[2]),
                          .gaps = *integer_of(row[3]),
                          .overflow = *integer_of(row[4]),
                          .nan_refused = *integer_of(row[5]),
                          .rejected = *integer_of(row[6]),
                          .out_of_order = *integer_of(row[7])});
      });
  return losses;
}

std::vector<std::string> Reader::warnings() const {
  std::vector<std::string> warnings;
  for (const RecordedSession& session : sessions()) {
    if (session.closed_t_ns) continue;
    warnings.push_back(fmt::format("session {} was not closed: {}", session.uuid, impl_->file.not_closed()));
  }
  for (const Loss& loss : losses()) {
    if (loss.missing() > 0) warnings.push_back(fmt::format("{}: {} rows are missing", loss.stream, loss.missing()));
  }
  return warnings;
}

}  // namespace trivela::evaluator::log
