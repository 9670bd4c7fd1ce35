#include "calibration/rows/lobs_of_scans.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include "evaluator/render/write_file.hpp"

namespace trivela::calibration {
namespace {

constexpr std::int64_t kSameLaunch_ns = 500'000'000;  // no kicker charges twice in so short a time

}  // namespace

void annotate(kicking::lob::LobRecord& lob, std::span<const log::TestedSetPoint> set_points,
              std::span<const log::Verdict> verdicts) {
  const log::TestedSetPoint* latest = nullptr;
  for (const log::TestedSetPoint& tested : set_points) {
    if (tested.t_ns > lob.launch_t_ns || (latest != nullptr && tested.t_ns < latest->t_ns)) continue;
    latest = &tested;
  }
  if (latest != nullptr) lob.power = latest->power;
  const log::Verdict* last = nullptr;
  for (const log::Verdict& verdict : verdicts) {
    if (std::abs(verdict.launch_t_ns - lob.launch_t_ns) <= kSameLaunch_ns) last = &verdict;
  }
  if (last == nullptr) return;
  if (!last->accepted) {
    lob.refusal = kicking::lob::Refusal::kOperator;
    lob.why = last->why.empty() ? "rejected by the operator" : "rejected by the operator: " + last->why;
  } else if (lob.effective) {
    lob.refusal = kicking::lob::Refusal::kNone;
    lob.why.clear();
  }
}

std::vector<kicking::lob::LobRecord> lobs_of_scans(const log::ScanReader& scans,
                                                   const kicking::lob::AnalyzerConfig& config,
                                                   std::span<const log::Verdict> later_verdicts) {
  std::vector<kicking::lob::LobRecord> lobs;
  const auto keep = [&](std::optional<kicking::lob::LobRecord> lob) {
    if (lob) lobs.push_back(std::move(*lob));
  };
  kicking::lob::Analyzer analyzer(scans.session().geometry, scans.session().mount, config);
  for (std::size_t i = 0; i < scans.size(); ++i) keep(analyzer.add(scans.scan(i)));
  keep(analyzer.finish());

  const std::vector<log::TestedSetPoint> set_points = scans.set_points();
  std::vector<log::Verdict> verdicts = scans.verdicts();
  verdicts.insert(verdicts.end(), later_verdicts.begin(), later_verdicts.end());
  for (kicking::lob::LobRecord& lob : lobs) annotate(lob, set_points, verdicts);
  return lobs;
}

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
