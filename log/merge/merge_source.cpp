#include "log/merge/merge_source.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "log/schema/digest.hpp"
#include "log/schema/row_digest.hpp"

namespace trivela::log {
namespace {

constexpr std::int64_t kCounter = (std::int64_t{1} << 40) - 1;  // of a kick_id

}  // namespace

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

void MergeSource::for_each_row(std::string_view table, const std::vector<std::string>& columns, std::string_view key,
                               const RowFunction& fn) const {
  const std::string select = fmt::format("SELECT {} FROM {} ORDER BY ", fmt::join(columns, ", "), table);
  try {
    return reader_->query(select + std::string(key), fn);
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
}

std::int64_t MergeSource::rows_of(std::int64_t session_id) const {
  std::int64_t rows = 0;
  for (const StreamTable& table : digested_tables()) {
    try {
      reader_->query(fmt::format("SELECT count(*) FROM {} WHERE session_id = {}", table.name, session_id),
                     [&](std::int64_t count) { rows += count; });
    } catch (const std::runtime_error&) {
      if (damage_.empty()) throw;
    }
  }
  return rows;
}

std::string KickConflict::line() const {
  std::vector<std::string> claims;
  for (const Claim& one : said) claims.push_back(fmt::format("{} says {}", one.source, one.what));
  return fmt::format("kick {}:{} ({}): {}", robot_id, kick_id & kCounter, about, fmt::join(claims, ", "));
}

void KickConflicts::say(const Kick& kick, const std::string& about, const std::string& source,
                        const std::string& what) {
  auto& said = kicks_[kick][about];
  if (std::ranges::find(said, what, &KickConflict::Claim::what) == said.end()) said.push_back({source, what});
}

void KickConflicts::add(const MergeSource& file) {
  if (file.reader() == nullptr) return;
  const std::string source = file.path().filename().string();
  const auto ask = [&] {
    file.reader()->query(
        "SELECT k.robot_id, k.kick_id, k.t_ns, s.seed, iif(s.match_id IS NULL, 0, k.session_id) AS of_experiment, "
        "k.policy, "
        "k.accepted, k.refusal, k.outcome, k.hand_label FROM labelled_kicks AS k JOIN sessions AS s ON s.session_id "
        "= "
        "k.session_id",
        [&](const NamedCells& row) {
          const auto accepted = row.find<bool>("accepted");
          const auto outcome = row.find<std::string>("outcome");
          const auto by_hand = row.find<std::string>("hand_label");
          const Kick kick{row.get<int>("robot_id"), row.get<std::int64_t>("kick_id"), row.get<std::int64_t>("t_ns"),
                          row.find<std::int64_t>("seed"), row.get<std::int64_t>("of_experiment")};
          say(kick, "policy", source, row.get<std::string>("policy"));
          if (accepted)
            say(kick, "driver", source,
                *accepted ? "kicked" : "refused: " + row.find<std::string>("refusal").value_or("unknown"));
          if (outcome && *outcome != "unknown") say(kick, "outcome", source, *outcome);
          if (by_hand) say(kick, "label", source, *by_hand);
        });
  };
  try {
    ask();
  } catch (const std::runtime_error&) {
    if (file.damage().empty()) throw;
  }
}

std::vector<KickConflict> KickConflicts::conflicts() const {
  std::vector<KickConflict> conflicts;
  for (const auto& [kick, claims] : kicks_) {
    for (const auto& [about, said] : claims)
      if (said.size() > 1) conflicts.push_back({std::get<0>(kick), std::get<1>(kick), std::get<2>(kick), about, said});
  }
  return conflicts;
}

}  // namespace trivela::log
