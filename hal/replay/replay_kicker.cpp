#include "hal/replay/replay_kicker.hpp"

#include <fmt/core.h>

#include <stdexcept>
#include <string_view>

namespace trivela::hal {
namespace {

KickerFault fault_of(std::string_view label) {
  if (label == "none") return KickerFault::kNone;
  if (label == "charger") return KickerFault::kCharger;
  if (label == "coil") return KickerFault::kCoil;
  if (label == "link") return KickerFault::kLink;
  throw std::runtime_error{fmt::format("replay: kicker_status has the unknown fault '{}'", label)};
}

}  // namespace

ReplayKicker::ReplayKicker(const ReplayLog& log) : rows_(log, "kicker_status", {"t_ns", "charge", "armed", "fault"}) {}

std::optional<KickerSample> ReplayKicker::read(std::chrono::nanoseconds) {
  const auto row = rows_.next();
  if (!row) return std::nullopt;
  now_t_ns_ = row->integer(0);
  return KickerSample{row->integer(0), row->number(1).value(), row->boolean(2), fault_of(row->text(3))};
}

void ReplayKicker::fire(std::int64_t kick_id, double power, std::int64_t t_ns) {
  if (!safe_) fires_.push_back({t_ns, kick_id, power});
}

void ReplayKicker::withdraw(std::int64_t kick_id) {
  const std::int64_t now_t_ns = now_t_ns_;
  std::erase_if(fires_, [=](const Fire& fire) { return fire.kick_id == kick_id && fire.t_ns > now_t_ns; });
}

}  // namespace trivela::hal
