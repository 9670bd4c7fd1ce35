#pragma once

#include <cstdint>
#include <stdexcept>
#include <string_view>

namespace trivela::bus {

/// The bus cannot go on: names the call, the topic or thing, and the reason.
class Error : public std::runtime_error {
 public:
  Error(std::string_view call, std::string_view about, std::string_view reason);
};

/// Returns a result of Cyclone's API as it is, or throws Error with Cyclone's text if it is negative.
std::int32_t checked(std::int32_t result, std::string_view call, std::string_view about);

}  // namespace trivela::bus
