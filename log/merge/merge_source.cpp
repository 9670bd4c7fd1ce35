#include "log/merge/merge_source.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>

#include "log/schema/digest.hpp"
#include "log/schema/row_digest.hpp"

namespace trivela::log {

MergeSource::MergeSource(const std::filesystem::path& path) : path_(path) {
  open();
  if (reader_) look_for_sessions();
}

void MergeSource::open() {
  try {
    reader_ = std::make_unique<Reader>(path_, Check::kWhole);
    return;
  } catch (const std::exception& error) {
    damage_ = error.what();
  }
  try {
    reader_ = std::make_unique<Reader>(path_, Check::kSchema);
  } catch (const std::exception& error) {
    damage_ = error.what();
  }
}

void MergeSource::look_for_sessions() {
  std::vector<std::pair<std::int64_t, bool>> found;
  const auto look = [&](const char* order) {
    try {
      reader_->query(
          fmt::format("SELECT session_id, closed_t_ns IS NOT NULL FROM sessions ORDER BY session_id{}", order),
          [&](std::int64_t session_id, bool closed) { found.emplace_back(session_id, closed); });
      return true;
    } catch (const std::runtime_error&) {
      return false;
    }
  };
  if (!look("")) look(" DESC");
  for (const auto& [session_id, closed] : found) {
    const bool whole = damage_.empty() ? closed : reader_->is_whole(session_id);
    sessions_[session_id] = whole ? Copy::kWhole : damage_.empty() ? Copy::kOpen : Copy::kDamaged;
  }
  if (sessions_.empty() && !damage_.empty()) reader_.reset();
}

void MergeSource::for_each_text(const std::function<void(const std::string&, const std::string&)>& fn) const {
  for_each_row("texts", {"sha256", "text"}, "sha256", [&](std::span<const Value> row) {
    const std::string& name = std::get<std::string>(row[0]);
    const std::string& text = std::get<std::string>(row[1]);
    if (sha256(text) == name) fn(name, text);
  });
}

bool MergeSource::for_each_row(std::string_view table, const std::vector<std::string>& columns, std::string_view key,
                               const RowFunction& fn) const {
  const std::string select = fmt::format("SELECT {} FROM {} ORDER BY ", fmt::join(columns, ", "), table);
  try {
    reader_->query(select + std::string(key), fn);
    return true;
  } catch (const std::runtime_error&) {
    if (damage_.empty()) throw;
  }
  std::string backwards;
  for (const char c : key) backwards += c == ',' ? std::string(" DESC,") : std::string(1, c);
  try {
    reader_->query(select + backwards + " DESC", fn);
  } catch (const std::runtime_error&) {
    // That it is damaged is known; what came until here is taken.
  }
  return false;
}

std::int64_t MergeSource::rows_of(std::int64_t session_id) const {
  std::int64_t rows = 0;
  for (const DigestedTable& table : digested_tables()) {
    try {
      reader_->query(fmt::format("SELECT count(*) FROM {} WHERE session_id = {}", table.name, session_id),
                     [&](std::int64_t count) { rows += count; });
    } catch (const std::runtime_error&) {
      if (damage_.empty()) throw;
    }
  }
  return rows;
}

}  // namespace trivela::log
