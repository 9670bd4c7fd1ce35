#pragma once

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>

#include "bus/domain/options.hpp"
#include "bus/node.hpp"
#include "config/settings.hpp"

/// What the campaigns at devices and links have in common: how long each is, and the bus that each has for itself.
namespace trivela::faults {

inline constexpr std::int64_t kMs = 1'000'000;
inline constexpr std::int64_t kRecovery_ns = 2'000 * kMs;  ///< what a robot may need after a fault's end
inline constexpr std::int64_t kBusy_ns = 100 * kMs;        ///< what a busy machine may add to an instant

inline std::int64_t steady_now_ns() { return std::chrono::steady_clock::now().time_since_epoch().count(); }

/// How long the machine stood still in a turn of a test's own loop, which takes turn_ns: time that no robot had.
inline std::int64_t stalled_ns(std::int64_t began_ns, std::int64_t turn_ns) {
  return std::max<std::int64_t>(0, steady_now_ns() - began_ns - turn_ns - kBusy_ns);
}

inline std::uint64_t from_environment(const char* name, std::uint64_t otherwise) {
  const char* const value = std::getenv(name);
  return value != nullptr ? std::stoull(value) : otherwise;
}

/// Who shares the faults out among them.
enum class DeviceCampaigns : std::uint64_t { kIoBoard, kReKick, kDrives, kRefbox, kCount };

/// Faults of one of the campaigns: its share of TRIVELA_DEVICE_FAULTS.
inline std::uint64_t device_rounds(DeviceCampaigns campaign) {
  constexpr auto kCampaigns = static_cast<std::uint64_t>(DeviceCampaigns::kCount);
  const std::uint64_t all = from_environment("TRIVELA_DEVICE_FAULTS", 50);
  return all / kCampaigns + (static_cast<std::uint64_t>(campaign) < all % kCampaigns ? 1 : 0);
}

inline std::mt19937_64 device_draws() { return std::mt19937_64{from_environment("TRIVELA_DEVICE_SEED", 1)}; }

/// The shipped settings in real time, on a domain that nobody else has.
inline config::Settings settings_of_campaign() {
  config::Settings settings = config::load_settings(std::filesystem::path{TRIVELA_SOURCE_DIR} / "config/default.toml");
  std::random_device random;
  settings.run.lockstep = false;
  settings.domain.domain_id = 1 + random() % 100;
  settings.domain.tag = fmt::format("device-{}-{:08x}", getpid(), random());
  return settings;
}

/// As the robot's own decision node.
inline bus::WriterOptions own_decision() {
  return {
      .period = {}, .lease = std::chrono::hours{1}, .strength = 0, .owner = bus::owner_of_robot("kick_decision", 1)};
}

}  // namespace trivela::faults
