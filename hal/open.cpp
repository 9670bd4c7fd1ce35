#include "hal/open.hpp"

#include <fmt/core.h>

#include <stdexcept>

#include "hal/replay/replay_kicker.hpp"
#include "hal/replay/replay_wheels.hpp"
#include "hal/sim/sim_kicker.hpp"
#include "hal/sim/sim_wheels.hpp"

namespace trivela::hal {
namespace {

[[noreturn]] void unknown(const char* what, std::string_view backend) {
  throw std::runtime_error{
      fmt::format("hal.{}: no backend is called '{}'; there are 'sim' and 'replay'", what, backend)};
}

}  // namespace

std::unique_ptr<Wheels> open_wheels(std::string_view backend, const Device& device) {
  if (backend == "sim") return std::make_unique<SimWheels>(device.participant, device.robot_id);
  if (backend == "replay") return std::make_unique<ReplayWheels>(ReplayLog::open(device.replay_log, device.robot_id));
  unknown("wheels", backend);
}

std::unique_ptr<Kicker> open_kicker(std::string_view backend, const Device& device) {
  if (backend == "sim") return std::make_unique<SimKicker>(device.participant, device.robot_id);
  if (backend == "replay") return std::make_unique<ReplayKicker>(ReplayLog::open(device.replay_log, device.robot_id));
  unknown("kicker", backend);
}

}  // namespace trivela::hal
