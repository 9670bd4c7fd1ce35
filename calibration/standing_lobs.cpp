#include "calibration/standing_lobs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace trivela::calibration {
namespace {

using kicking::lob::LobRecord;
using kicking::lob::Refusal;

constexpr std::size_t kFewestLobs = 2;    // of a set-point (paper, section 2.2)
constexpr std::uint32_t kMostKicks = 40;  // with a set-point in one more round

}  // namespace

bool is_trial(const LobRecord& lob) { return lob.refusal == Refusal::kNone && lob.effective && lob.power; }

std::map<double, Tally> tallies_of(const std::vector<double>& powers, const std::vector<DriveRecord>& records) {
  std::map<double, Tally> tallies;
  for (const double power : powers) tallies[power] = {};
  for (const DriveRecord& record : records) {
    for (const double power : record.kicked_powers) ++tallies[power].kicks;
    for (const LobRecord& lob : record.lobs) {
      if (is_trial(lob)) ++tallies[*lob.power].lobs;
    }
  }
  return tallies;
}

NextRound next_round(const std::map<double, Tally>& tallies, std::size_t wanted) {
  NextRound next;
  for (const auto& [power, tally] : tallies) {
    if (tally.lobs >= wanted) continue;
    const double share = (static_cast<double>(tally.lobs) + 0.5) / (static_cast<double>(tally.kicks) + 1.0);
    const double kicks = std::ceil(1.2 * static_cast<double>(wanted - tally.lobs) / share);
    next.powers.push_back(power);
    next.kicks = std::max(next.kicks, std::min(kMostKicks, static_cast<std::uint32_t>(kicks)));
  }
  return next;
}

void require_lobs(const std::map<double, Tally>& tallies, std::uint32_t kicks) {
  for (const auto& [power, tally] : tallies) {
    if (tally.lobs >= kFewestLobs) continue;
    throw std::runtime_error{fmt::format(
        "set-point {}: {} of the {} lobs that it needs, after {} kicks; about {} more kicks with it are needed "
        "(now {} of each set-point)",
        power, tally.lobs, kFewestLobs, tally.kicks, next_round({{power, tally}}, kFewestLobs).kicks, kicks)};
  }
}

std::vector<std::string> without_lob(const std::vector<DriveRecord>& records, std::size_t kicks) {
  std::map<std::string, std::size_t> refused;
  std::size_t seen = 0;
  for (const DriveRecord& record : records) {
    for (const LobRecord& lob : record.lobs) {
      if (lob.refusal != Refusal::kNone) ++refused[kicking::lob::name(lob.refusal)];
      if (lob.refusal != Refusal::kNone || is_trial(lob)) ++seen;
    }
  }
  std::vector<std::string> sentences;
  sentences.reserve(refused.size() + 1);
  for (const auto& [why, flights] : refused)
    sentences.push_back(fmt::format("{} flight{}: {}", flights, flights == 1 ? "" : "s", why));
  if (const std::size_t unseen = kicks - std::min(seen, kicks); unseen > 0)
    sentences.push_back(fmt::format("{} kick{}: no flight in the scans", unseen, unseen == 1 ? "" : "s"));
  return sentences;
}

kicking::TableFit fit_rising(const std::vector<kicking::Trial>& trials, std::vector<std::string>& left_out) {
  kicking::TableFit fit = kicking::fit_table(trials);
  if (fit.rises()) return fit;
  for (const std::size_t i : fit.not_rising) {
    left_out.push_back(fmt::format("order of set-point {}: {:.2f} m/s, not faster than a weaker one; pooled",
                                   fit.set_points[i].power, fit.set_points[i].exit_speed_mps.mean));
  }
  return kicking::fit_table(trials, {.least_angle_power = {}, .isotonic = true});
}

}  // namespace trivela::calibration
