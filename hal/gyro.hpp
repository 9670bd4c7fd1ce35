#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace trivela::hal {

/// One reading of a gyro.
struct GyroSample {
  std::int64_t t_ns = 0;    ///< of the sample on the steady clock, as in hal/kicker.hpp
  double gyro_radps = 0.0;  ///< counter-clockwise
};

/// A gyro that is a device of its own. For any thread.
class Gyro {
 public:
  virtual ~Gyro() = default;

  /// The newest sample, however old; none: there was none yet.
  virtual std::optional<GyroSample> newest() const = 0;

  /// One line on the state of the link, for a human; empty: nothing to say.
  virtual std::string status() const = 0;
};

}  // namespace trivela::hal
