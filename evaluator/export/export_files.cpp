#include "evaluator/export/export_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>

namespace trivela::evaluator {
namespace {

namespace fs = std::filesystem;

/// "out/csv/" names the folder "out/csv".
fs::path without_slash(const fs::path& path) {
  return path.has_filename() || !path.has_parent_path() ? path : path.parent_path();
}

}  // namespace

Snapshot::~Snapshot() {
  try {
    reader_.query("COMMIT", [](auto) {});
  } catch (const std::exception&) {  // nothing was written
  }
}

std::vector<log::StreamTable> tables_of(const ExportPlan& plan) {
  std::vector<std::string> known;
  std::vector<log::StreamTable> tables;
  for (const log::StreamTable& table : log::stream_tables()) {
    known.push_back(table.name);
    if (plan.streams.empty() || std::ranges::find(plan.streams, table.name) != plan.streams.end())
      tables.push_back(table);
  }
  for (const std::string& name : plan.streams) {
    if (std::ranges::find(known, name) == known.end())
      throw BadExport(fmt::format("there is no stream \"{}\"; there are {}", name, fmt::join(known, ", ")));
  }
  return tables;
}

std::vector<log::RecordedSession> sessions_of(const ExportPlan& plan, const log::Reader& reader) {
  auto all = reader.sessions();
  if (plan.sessions.empty()) return all;
  std::vector<log::RecordedSession> chosen;
  for (const std::string& begin : plan.sessions) {
    const auto before = chosen.size();
    for (const log::RecordedSession& session : all) {
      const bool is_new = std::ranges::find(chosen, session.uuid, &log::RecordedSession::uuid) == chosen.end();
      if (session.uuid.starts_with(begin) && is_new) chosen.push_back(session);
    }
    if (chosen.size() == before)
      throw BadExport(
          fmt::format("no session begins with \"{}\"; trivela query DB 'SELECT uuid FROM sessions'", begin));
  }
  return chosen;
}

std::string only_sessions(const ExportPlan& plan, const log::Reader& reader) {
  if (plan.sessions.empty()) return "";
  std::vector<std::int64_t> ids;
  for (const log::RecordedSession& session : sessions_of(plan, reader)) ids.push_back(session.session_id);
  return fmt::format(" WHERE session_id IN ({})", fmt::join(ids, ", "));
}

std::int64_t count_rows(const ExportPlan& plan, const log::Reader& reader) {
  const std::string where = only_sessions(plan, reader);
  std::int64_t rows = 0;
  for (const log::StreamTable& table : tables_of(plan)) {
    reader.query(fmt::format("SELECT count(*) FROM {}{}", table.name, where), [&](std::int64_t n) { rows += n; });
  }
  return rows;
}

Draft::Draft(const fs::path& place) : place_(without_slash(place)), draft_(place_) {
  draft_ += fmt::format(".{}.new", getpid());
}

Draft::~Draft() {
  std::error_code ignored;
  fs::remove_all(draft_, ignored);
}

void Draft::keep() {
  std::error_code failed;
  if (fs::is_directory(draft_) && fs::is_directory(place_)) {
    for (const auto& entry : fs::directory_iterator(draft_)) {
      if (!failed) fs::rename(entry.path(), place_ / entry.path().filename(), failed);
    }
  } else {
    fs::rename(draft_, place_, failed);
  }
  if (failed) throw std::runtime_error(fmt::format("cannot write {}: {}", place_.string(), failed.message()));
}

}  // namespace trivela::evaluator
