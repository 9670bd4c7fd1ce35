#include "calibration/rows/lobs_of_scans.hpp"

#include <cmath>
#include <cstdlib>

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

}  // namespace trivela::calibration
