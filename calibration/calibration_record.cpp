#include "calibration/calibration_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "config/text/error.hpp"
#include "config/text/open_file.hpp"
#include "evaluator/render/json_values.hpp"
#include "evaluator/render/write_file.hpp"
#include "log/read/reader.hpp"

namespace trivela::calibration {

namespace fs = std::filesystem;

namespace {

bool is_whole_log(const fs::path& file) {
  try {
    const auto sessions = log::Reader{file}.sessions();
    return !sessions.empty() && std::ranges::all_of(sessions, [](const auto& s) { return s.closed_t_ns.has_value(); });
  } catch (const std::exception&) {
    return false;
  }
}

/// Drives whose logs were closed; scans (NAME.scans.db) and what was set aside have a dot in their names.
std::set<std::string> played_in(const fs::path& folder) {
  std::set<std::string> drives;
  for (const auto& entry : fs::directory_iterator{folder}) {
    const fs::path& file = entry.path();
    const std::string drive = file.stem().string();
    if (file.extension() == ".db" && drive.find('.') == std::string::npos && is_whole_log(file)) drives.insert(drive);
  }
  return drives;
}

}  // namespace

CalibrationRecord::CalibrationRecord(fs::path folder, std::string arguments)
    : folder_(std::move(folder)), file_(folder_ / "calibration.json"), arguments_(std::move(arguments)) {
  fs::exists(file_) ? read() : write();
}

void CalibrationRecord::read() {
  std::string begun_with;
  try {
    const auto json = evaluator::Json::parse(config::read_text_file(file_));
    begun_with = json.at("arguments").get<std::string>();
    for (const auto& [what, value] : json.at("measured").items()) measured_[what] = value.get<double>();
    finished_ = json.at("finished").get<std::set<std::string>>();
  } catch (const evaluator::Json::exception&) {
    throw std::runtime_error{fmt::format(
        "{} is cut short, or no record of a calibration. Its drives are not lost: to go on with those whose "
        "logs are whole beside it, write this into it (what was measured is asked again):\n{}",
        file_.string(), text_with(played_in(folder_)))};
  }
  if (begun_with == arguments_) return;
  throw config::BadArgument{
      fmt::format("{} was begun with '{}', not with '{}': take another --out-dir for another calibration",
                  file_.string(), begun_with, arguments_)};
}

std::string CalibrationRecord::text_with(const std::set<std::string>& finished) const {
  return evaluator::json_text(
      evaluator::Json{{"arguments", arguments_}, {"measured", measured_}, {"finished", finished}});
}

void CalibrationRecord::write() const {
  evaluator::replace_file(file_, text_with(finished_), "the calibration's record");
}

std::optional<double> CalibrationRecord::measured(const std::string& what) const {
  const auto found = measured_.find(what);
  return found == measured_.end() ? std::nullopt : std::optional{found->second};
}

void CalibrationRecord::measure(const std::string& what, double value) {
  measured_[what] = value;
  write();
}

void CalibrationRecord::finish(const std::string& drive) {
  finished_.insert(drive);
  write();
}

std::size_t set_aside(const fs::path& folder, const std::string& drive) {
  const std::string partial = drive + ".partial-";
  std::vector<std::string> endings;
  std::set<std::string> kept;
  for (const auto& entry : fs::directory_iterator{folder}) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(partial))
      kept.insert(name.substr(partial.size(), name.find('.', partial.size()) - partial.size()));
    else if (name.starts_with(drive + "."))
      endings.push_back(name.substr(drive.size()));
  }
  int n = 1;
  while (kept.contains(std::to_string(n))) ++n;
  for (const std::string& ending : endings)
    fs::rename(folder / (drive + ending), folder / fmt::format("{}{}{}", partial, n, ending));
  return endings.size();
}

}  // namespace trivela::calibration
