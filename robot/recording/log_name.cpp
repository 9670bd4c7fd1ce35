#include "robot/recording/log_name.hpp"

#include <fmt/chrono.h>
#include <fmt/core.h>

#include <algorithm>
#include <ctime>
#include <system_error>

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

}  // namespace trivela::robot
