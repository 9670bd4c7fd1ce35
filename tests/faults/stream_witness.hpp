#pragma once

#include <array>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "bus/domain/participant.hpp"
#include "config/settings.hpp"

namespace trivela::faults {

/// Says of each node whether it hears what it needs, by what it writes. A member of the domain that was not there
/// before: nothing that went wrong earlier is wrong with it.
class StreamWitness {
 public:
  explicit StreamWitness(const config::Settings& settings);
  ~StreamWitness();

  /// Looks for as long; the streams that were not heard in that time, as "writer hears input".
  std::vector<std::string> deaf_within(std::chrono::milliseconds span);

 private:
  struct Subscribers;
  std::unique_ptr<Subscribers> subscribers_;
};

}  // namespace trivela::faults
