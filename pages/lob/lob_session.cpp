#include "pages/lob/lob_session.hpp"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>

#include "config/text/error.hpp"
#include "config/text/parse_number.hpp"
#include "pages/lob/lob_page.hpp"

namespace trivela::pages {
namespace {

using config::BadArgument;

constexpr std::size_t kMostPowers = 32;  // as many as a power table holds

// `list`: the whole, as messages call it.
double number_of(const std::string& text, const std::string& list) {
  const auto value = config::parse_number(text);
  if (value && std::isfinite(*value) && *value > 0.0) return *value;
  throw BadArgument{fmt::format("{}: '{}' is no power", list, text)};
}

// From the two last powers on to `end`, in their step.
void go_on(std::vector<double>& powers, double end, const std::string& list) {
  const double step = powers.size() < 2 ? 0.0 : powers.back() - powers[powers.size() - 2];
  const double steps = (end - powers.back()) / step;
  if (!(steps >= 1.0) || std::abs(steps - std::round(steps)) > 1e-9) {
    throw BadArgument{fmt::format("{}: the two powers before '...' do not lead to the one behind it", list)};
  }
  const double start = powers.back();
  const double count = std::min(std::round(steps), static_cast<double>(kMostPowers));
  for (double i = 1.0; i < count; ++i) powers.push_back(start + i * step);
}

}  // namespace

std::vector<double> parse_powers(const std::string& text, const std::string& called) {
  const std::string list = called + ' ' + text;
  std::vector<double> powers;
  bool dots = false;
  std::istringstream parts{text};
  for (std::string part; std::getline(parts, part, ',');) {
    if (part == "..." && powers.size() >= 2 && !dots) {
      dots = true;
      continue;
    }
    const double power = number_of(part, list);
    if (dots) go_on(powers, power, list);
    dots = false;
    powers.push_back(power);
  }
  if (dots) throw BadArgument{fmt::format("{}: a power must follow '...'", list)};
  if (powers.size() > kMostPowers) throw BadArgument{fmt::format("{}: more than {} powers", list, kMostPowers)};
  for (auto power = powers.begin(); power != powers.end(); ++power) {
    if (std::find(powers.begin(), power, *power) == power) continue;
    throw BadArgument{fmt::format("{}: {:g} stands in it twice", list, *power)};
  }
  return powers;
}

std::vector<int> kicks_done(const CalibrationPlan& plan, std::span<const kicking::lob::LobRecord> lobs) {
  std::vector<int> done(plan.powers.size(), 0);
  for (const kicking::lob::LobRecord& lob : lobs) {
    if (!lob.power || lob.refusal != kicking::lob::Refusal::kNone) continue;
    const auto power = std::find(plan.powers.begin(), plan.powers.end(), *lob.power);
    if (power != plan.powers.end()) ++done[static_cast<std::size_t>(power - plan.powers.begin())];
  }
  return done;
}

std::optional<double> next_power(const CalibrationPlan& plan, const std::vector<int>& done, double power) {
  const std::size_t n = plan.powers.size();
  const auto found = std::find(plan.powers.begin(), plan.powers.end(), power);
  const auto start =
      found == plan.powers.end() ? std::size_t{0} : static_cast<std::size_t>(found - plan.powers.begin());
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t place = (start + i) % n;
    if (done[place] < plan.trials) return plan.powers[place];
  }
  const bool the_last = found != plan.powers.end() && done[start] == plan.trials;
  return the_last ? std::nullopt : std::optional{power};
}

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
