#pragma once

#include <chrono>

namespace trivela::security {

/// From when to when something holds, UTC.
struct Validity {
  std::chrono::sys_seconds from;
  std::chrono::sys_seconds to;

  bool operator==(const Validity&) const = default;
  bool holds(std::chrono::sys_seconds now) const { return from <= now && now < to; }
};

inline std::chrono::sys_seconds this_second() {
  return std::chrono::time_point_cast<std::chrono::seconds>(std::chrono::system_clock::now());
}

/// From an hour ago, for robots whose clocks are behind, for so many days.
inline Validity days_from(std::chrono::sys_seconds now, int days) {
  return {now - std::chrono::hours{1}, now + std::chrono::days{days}};
}

}  // namespace trivela::security
