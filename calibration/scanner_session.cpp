#include "calibration/scanner_session.hpp"

#include <fmt/core.h>

#include <chrono>

#include "config/text/error.hpp"
#include "config/text/installation.hpp"

namespace trivela::calibration {

log::ScanSession scanner_session(const hal::RangeFinder& finder, const kicking::lob::LaserMount& mount,
                                 const std::string& device) {
  const auto since = [](auto instant) {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(instant.time_since_epoch()).count();
  };
  const std::int64_t steady_ns = since(std::chrono::steady_clock::now());
  const kicking::lob::ScannerIdentity identity = finder.identity();
  return {.identity = identity,
          .geometry = finder.geometry(),
          .mount = mount,
          .started_t_ns = steady_ns,
          .realtime_offset_ns = since(std::chrono::system_clock::now()) - steady_ns,
          .simulated = is_emulated(identity) || identity.vendor == "synthetic",
          .source = device,
          .software_version = config::software_version()};
}

void refuse_existing(const std::filesystem::path& record) {
  if (!std::filesystem::exists(record)) return;
  throw config::BadArgument{
      fmt::format("{} exists already; a recorded scan is never overwritten, choose another file", record.string())};
}

}  // namespace trivela::calibration
