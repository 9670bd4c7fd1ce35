#include "evaluator/imports/box_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string_view>

#include "evaluator/imports/zip_file.hpp"

namespace trivela::evaluator::imports {
namespace {

namespace fs = std::filesystem;

bool is_of_a_team(std::istream& in, std::string_view name) {
  if (name.ends_with(".A.msl") || name.ends_with(".B.msl")) return true;
  while (std::isspace(in.peek())) in.get();
  return in.peek() == '[' || in.peek() == '{';
}

/// `fault`: what the stream itself says after it was read to its end.
template <class Fault>
void read_one(std::istream& in, const std::string& name, BoxLogs& logs, Fault&& fault) {
  const auto note = [&](FaultCounter& faults) {
    if (const std::string why = fault(); !why.empty()) faults.note("cannot be read to its end", 0, why, "");
  };
  if (is_of_a_team(in, name)) {
    const BoxSide side = std::string_view(name).ends_with(".B.msl") ? BoxSide::kMagenta : BoxSide::kCyan;
    logs.teams.push_back({side, read_team_log(in, name)});
    note(logs.teams.back().log.faults);
  } else {
    logs.referee.push_back(read_referee_log(in, name));
    note(logs.referee.back().faults);
  }
}

void read_archive(const fs::path& file, BoxLogs& logs) {
  bool found = false;
  for (const ZipEntry& entry : zip_entries(file)) {
    if (!entry.name.ends_with(".msl")) continue;
    found = true;
    ZipStream in(file, entry);
    read_one(in, entry.name, logs, [&] { return in.fault(); });
  }
  if (!found) throw std::runtime_error(fmt::format("{}: no .msl file in it", file.string()));
}

void read_file(const fs::path& file, BoxLogs& logs) {
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in || fs::is_directory(file))
    throw std::runtime_error(
        fmt::format("cannot read {}: {}", file.string(), in ? "it is a folder" : std::strerror(errno)));
  constexpr std::uintmax_t kMost_B = 512U << 20;
  std::error_code unknown;
  if (const auto size = fs::file_size(file, unknown); !unknown && size > kMost_B)
    throw std::runtime_error(fmt::format("{}: more than {} MB: not read", file.string(), kMost_B >> 20));
  if (!fs::is_regular_file(file) && !fs::is_fifo(file))
    throw std::runtime_error(fmt::format("cannot read {}: it is no file", file.string()));
  if (is_zip(file)) return read_archive(file, logs);
  read_one(in, file.filename().string(), logs, [&] { return std::string(in.bad() ? "the disk refuses" : ""); });
}

}  // namespace

std::int64_t BoxLogs::unusable() const {
  std::int64_t n = 0;
  for (const RefereeLog& log : referee) {
    for (const Fault& fault : log.faults.all()) n += fault.name == "time goes back" ? 0 : fault.count;
  }
  for (const SidedTeamLog& team : teams) {
    n += team.log.records - std::ssize(team.log.usable) + team.log.faults.of("not JSON") +
         team.log.faults.of("no record in it") + team.log.faults.of("cannot be read to its end");
  }
  return n;
}

std::vector<std::string> BoxLogs::faults() const {
  std::vector<std::string> all;
  const auto add = [&](const FaultCounter& faults) { std::ranges::move(faults.sentences(), std::back_inserter(all)); };
  for (const RefereeLog& log : referee) add(log.faults);
  for (const SidedTeamLog& team : teams) add(team.log.faults);
  return all;
}

BoxLogs read_box_logs(const std::vector<fs::path>& files) {
  BoxLogs logs;
  for (const fs::path& file : files) read_file(file, logs);
  return logs;
}

}  // namespace trivela::evaluator::imports
