#include "calibration/evening_book.hpp"

#include <fmt/format.h>

#include <fstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "config/error.hpp"
#include "evaluator/report/json_values.hpp"
#include "evaluator/report/write_file.hpp"

namespace trivela::calibration {

namespace fs = std::filesystem;

EveningBook::EveningBook(fs::path folder, std::string arguments)
    : folder_(std::move(folder)), file_(folder_ / "evening.json"), arguments_(std::move(arguments)) {
  fs::exists(file_) ? read() : write();
}

void EveningBook::read() {
  std::string begun_with;
  try {
    std::ifstream file{file_};
    const auto json = evaluator::Json::parse(file);
    begun_with = json.at("arguments").get<std::string>();
    for (const auto& [what, value] : json.at("measured").items()) measured_[what] = value.get<double>();
    finished_ = json.at("finished").get<std::set<std::string>>();
  } catch (const evaluator::Json::exception& error) {
    throw std::runtime_error{fmt::format("{} is no book of an evening: {}", file_.string(), error.what())};
  }
  if (begun_with == arguments_) return;
  throw config::BadArgument{
      fmt::format("{} was begun with '{}', not with '{}': take another --out-dir for another evening", file_.string(),
                  begun_with, arguments_)};
}

void EveningBook::write() const {
  const evaluator::Json json{{"arguments", arguments_}, {"measured", measured_}, {"finished", finished_}};
  evaluator::replace_file(file_, evaluator::json_text(json), "the evening's book");
}

std::optional<double> EveningBook::measured(const std::string& what) const {
  const auto found = measured_.find(what);
  return found == measured_.end() ? std::nullopt : std::optional{found->second};
}

void EveningBook::measure(const std::string& what, double value) {
  measured_[what] = value;
  write();
}

void EveningBook::finish(const std::string& drive) {
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
