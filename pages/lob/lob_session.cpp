#include "pages/lob/lob_session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "pages/lob/lob_json.hpp"

namespace trivela::pages {

using kicking::lob::LobRecord;

LobSession::LobSession(CalibrationPlan plan, std::vector<log::TestedSetPoint> set_points,
                       std::vector<log::Verdict> verdicts)
    : plan_(std::move(plan)), set_points_(std::move(set_points)), verdicts_(std::move(verdicts)) {}

void LobSession::add(LobRecord lob, std::size_t end) { entries_.push_back({std::move(lob), end}); }

log::Verdict LobSession::judge(std::size_t number, bool accepted, const std::string& why) {
  verdicts_.push_back({.launch_t_ns = entries_.at(number).lob.launch_t_ns, .accepted = accepted, .why = why});
  return verdicts_.back();
}

std::size_t LobSession::count(std::size_t position) const {
  return static_cast<std::size_t>(
      std::ranges::count_if(entries_, [&](const Entry& entry) { return entry.end <= position; }));
}

std::vector<LobRecord> LobSession::lobs(std::size_t count) const {
  std::vector<LobRecord> lobs;
  for (std::size_t i = 0; i < std::min(count, entries_.size()); ++i) {
    lobs.push_back(entries_[i].lob);
    calibration::annotate(lobs.back(), set_points_, verdicts_);
  }
  return lobs;
}

std::optional<double> LobSession::power_at(std::int64_t t_ns) const {
  LobRecord kicked_then;
  kicked_then.launch_t_ns = t_ns;
  calibration::annotate(kicked_then, set_points_, {});
  return kicked_then.power;
}

nlohmann::json LobSession::to_json(std::size_t count, std::int64_t start_t_ns) const {
  const std::vector<LobRecord> shown = lobs(count);
  nlohmann::json list = nlohmann::json::array();
  for (std::size_t i = 0; i < shown.size(); ++i) {
    nlohmann::json json = lob_json(shown[i], start_t_ns);
    json["end"] = entries_[i].end;
    list.push_back(std::move(json));
  }
  return {{"lobs", list}, {"table", table_json(shown)}, {"plan", plan_json(plan_, shown)}};
}

std::string LobSession::table_csv(std::size_t count) const {
  std::string csv = "power,height_m,distance_m\n";
  for (const LobRecord& lob : lobs(count)) {
    if (lob.refusal != kicking::lob::Refusal::kNone || !lob.power || !lob.effective) continue;
    fmt::format_to(std::back_inserter(csv), "{:g},{:.6f},{:.6f}\n", *lob.power, lob.effective->height_m.value,
                   lob.effective->distance_m.value);
  }
  return csv;
}

}  // namespace trivela::pages
