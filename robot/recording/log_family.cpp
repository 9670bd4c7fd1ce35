#include "robot/recording/log_family.hpp"

#include <fmt/chrono.h>
#include <fmt/core.h>

#include <algorithm>
#include <ctime>
#include <exception>
#include <system_error>

#include "kicking/geometry/time.hpp"
#include "log/read/reader.hpp"
#include "log/schema/digest.hpp"

namespace trivela::robot {
namespace {
namespace fs = std::filesystem;

constexpr std::string_view kTime = "{time}";

std::string replaced(std::string text, std::string_view what, const std::string& by) {
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

std::string fit_for_a_name(std::string text) {
  for (char& c : text) {
    if (c == '/' || static_cast<unsigned char>(c) < ' ') c = '_';
  }
  return text.empty() ? "team" : text;
}

fs::path file_of(const std::string& setting) {
  std::error_code none;
  const fs::path path{setting};
  const bool is_folder = setting.empty() || path.filename().empty() || fs::is_directory(path, none);
  return is_folder ? path / kLogPattern : path;
}

/// The file's name with all but the time.
std::string timeless(const std::string& setting, const LogNaming& naming) {
  const std::string named = replaced(file_of(setting).filename().string(), "{robot}", std::to_string(naming.robot_id));
  return replaced(named, "{team}", fit_for_a_name(naming.team));
}

}  // namespace

std::string log_time(std::int64_t utc_ns) {
  const std::time_t utc_s = utc_ns / 1'000'000'000;
  return fmt::format("{:%Y%m%dT%H%M%SZ}", fmt::gmtime(utc_s));
}

bool LogFamily::has(const fs::path& file) const {
  const std::string stem = file.stem().string();
  return file.extension() == ending && ((!name.empty() && stem == name) || stem.starts_with(beginning));
}

fs::path log_path(const std::string& setting, const LogNaming& naming) {
  return file_of(setting).parent_path() / replaced(timeless(setting, naming), kTime, log_time(naming.now_utc_ns));
}

LogFamily log_family(const std::string& setting, const LogNaming& naming) {
  const fs::path file{timeless(setting, naming)};
  const std::string stem = file.stem().string();
  const auto time = stem.find(kTime);
  if (time == std::string::npos) return {stem, stem + "-r", file.extension().string()};
  return {"", stem.substr(0, time), file.extension().string()};
}

namespace {
// Logs that may be of the same match, the one written to last first.
std::vector<fs::path> candidates(const fs::path& asked_folder, const LogFamily& family) {
  std::vector<std::pair<fs::file_time_type, fs::path>> found;
  std::error_code error;
  const fs::path folder = asked_folder.empty() ? fs::path{"."} : asked_folder;
  for (fs::directory_iterator entry{folder, error}, end; !error && entry != end; entry.increment(error)) {
    const fs::path& path = entry->path();
    if (!family.has(path) || !entry->is_regular_file(error)) continue;
    if (entry->file_size(error) == 0) continue;
    auto changed = entry->last_write_time(error);
    // What is not folded in yet stands beside it.
    std::error_code none;
    if (const auto wal = fs::last_write_time(path.string() + "-wal", none); !none) changed = std::max(changed, wal);
    found.emplace_back(changed, path);
  }
  std::ranges::sort(found, std::greater<>{});
  constexpr std::size_t kMost = 16;
  std::vector<fs::path> paths;
  for (std::size_t i = 0; i < std::min(found.size(), kMost); ++i) paths.push_back(found[i].second);
  return paths;
}

std::int64_t first_number(const log::Reader& reader, const std::string& sql) {
  std::int64_t n = 0;
  reader.query(sql, [&](std::optional<std::int64_t> number) { n = number.value_or(0); });
  return n;
}

// Robots that said nothing in the session are where they were when it began.
std::vector<log::DriverCount> drivers_of(const log::Reader& reader, std::int64_t session_id) {
  using D = log::DriverCount;
  return reader.rows<D>(fmt::format("SELECT robot_id, orders_handled, orders_refused FROM kicker_status AS k "
                                    "WHERE session_id = {0} AND seq = (SELECT max(seq) FROM kicker_status "
                                    "WHERE session_id = {0} AND robot_id = k.robot_id) "
                                    "UNION ALL SELECT robot_id, orders_handled, orders_refused FROM continued AS c "
                                    "WHERE session_id = {0} AND NOT EXISTS (SELECT 1 FROM kicker_status "
                                    "WHERE session_id = {0} AND robot_id = c.robot_id) ORDER BY robot_id",
                                    session_id),
                        &D::robot_id, &D::orders_handled, &D::orders_refused);
}

}  // namespace

std::optional<Predecessor> find_predecessor(const fs::path& folder, const LogFamily& family,
                                            const log::Session& session, std::int64_t now_utc_ns,
                                            const std::function<void(const std::string&)>& warn) {
  std::optional<Predecessor> newest;
  std::int64_t newest_start_utc_ns = 0;
  const std::string config_sha256 = log::sha256(session.config_toml);
  for (const fs::path& path : candidates(folder, family)) {
    if (newest) break;
    try {
      // A match goes on while this looks: whether the rows are sound is for the report to say.
      const log::Reader reader{path, log::Check::kQuick};
      for (const auto& recorded : reader.sessions()) {
        const std::int64_t start_utc_ns = recorded.started_t_ns + recorded.realtime_offset_ns;
        if (recorded.config_sha256 != config_sha256) continue;
        if (newest && start_utc_ns <= newest_start_utc_ns) continue;
        const std::int64_t last_t_ns = first_number(
            reader,
            fmt::format("SELECT max(to_t_ns) FROM losses WHERE session_id = {} AND robot_id = 0", recorded.session_id));
        const std::int64_t last_utc_ns = std::max(last_t_ns, recorded.started_t_ns) + recorded.realtime_offset_ns;
        if (kicking::seconds(now_utc_ns - last_utc_ns) > kLongestPause_s) continue;
        newest = Predecessor{recorded.uuid, path, drivers_of(reader, recorded.session_id)};
        newest_start_utc_ns = start_utc_ns;
      }
    } catch (const std::exception& error) {
      warn(fmt::format("a log beside the new one is passed over: {}", error.what()));
    }
  }
  return newest;
}

}  // namespace trivela::robot
