#include "pages/lob/plan.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "config/text/error.hpp"
#include "config/text/parse_number.hpp"

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

}  // namespace trivela::pages
