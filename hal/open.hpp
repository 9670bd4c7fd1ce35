#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>

#include "hal/kicker.hpp"
#include "hal/wheels.hpp"

namespace trivela::bus {
class Participant;
}

namespace trivela::hal {

/// What the backends need to find their device.
struct Device {
  const bus::Participant& participant;  ///< sim
  std::uint8_t robot_id = 1;
  std::filesystem::path replay_log;  ///< replay
};

/// Opens the backend called "sim" or "replay". Throws std::runtime_error naming an unknown one, or what the backend
/// says.
std::unique_ptr<Wheels> open_wheels(std::string_view backend, const Device& device);
std::unique_ptr<Kicker> open_kicker(std::string_view backend, const Device& device);

}  // namespace trivela::hal
