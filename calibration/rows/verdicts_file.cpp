#include "calibration/rows/verdicts_file.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "evaluator/render/write_file.hpp"

namespace trivela::calibration {

namespace fs = std::filesystem;

fs::path verdicts_path(const fs::path& record) {
  fs::path path = record;
  path += ".verdicts.json";
  return path;
}

std::vector<log::Verdict> verdicts_beside(const fs::path& record) {
  const fs::path path = verdicts_path(record);
  std::vector<log::Verdict> verdicts;
  if (!fs::exists(path)) return verdicts;
  try {
    std::ifstream in(path);
    for (const auto& json : nlohmann::json::parse(in)) {
      verdicts.push_back({.launch_t_ns = json.at("launch_t_ns").get<std::int64_t>(),
                          .accepted = json.at("accepted").get<bool>(),
                          .why = json.at("why").get<std::string>()});
    }
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(fmt::format("{} does not hold verdicts: {}", path.string(), error.what()));
  }
  return verdicts;
}

void write_verdicts(const fs::path& record, std::span<const log::Verdict> verdicts) {
  auto list = nlohmann::ordered_json::array();
  for (const log::Verdict& verdict : verdicts) {
    list.push_back({{"launch_t_ns", verdict.launch_t_ns}, {"accepted", verdict.accepted}, {"why", verdict.why}});
  }
  evaluator::replace_file(verdicts_path(record), list.dump(2) + '\n', "the verdicts");
}

}  // namespace trivela::calibration
