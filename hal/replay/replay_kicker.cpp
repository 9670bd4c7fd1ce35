#include "hal/replay/replay_kicker.hpp"

#include "hal/open.hpp"

namespace trivela::hal {

std::optional<KickerSample> ReplayKicker::read(std::chrono::nanoseconds) {
  const auto status = samples_.next();
  if (!status) return std::nullopt;
  now_t_ns_ = status->t_ns;
  return KickerSample{
      status->t_ns,     status->charge, status->armed, static_cast<KickerFault>(status->fault), status->charge_modelled,
      status->voltage_v};
}

void ReplayKicker::fire(const Shot& shot) {
  if (!safe_) fires_.push_back({shot.t_ns, shot.kick_id, shot.power});
}

void ReplayKicker::withdraw(std::int64_t kick_id) {
  const std::int64_t now_t_ns = now_t_ns_;
  std::erase_if(fires_, [=](const Fire& fire) { return fire.kick_id == kick_id && fire.t_ns > now_t_ns; });
}

}  // namespace trivela::hal

namespace trivela::config {

std::unique_ptr<hal::Kicker> kicker_of(const ReplayDevice&, const Hal& devices, const hal::Owner& owner) {
  return std::make_unique<hal::ReplayKicker>(hal::ReplayLog::open(devices.replay_log, owner.robot_id));
}

}  // namespace trivela::config
