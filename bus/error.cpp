#include "bus/error.hpp"

#include <dds/dds.h>
#include <fmt/core.h>

namespace trivela::bus {

Error::Error(std::string_view call, std::string_view about, std::string_view reason)
    : std::runtime_error(fmt::format("bus: {} ({}): {}", call, about, reason)) {}

std::int32_t checked(std::int32_t result, std::string_view call, std::string_view about) {
  if (result < 0) throw Error(call, about, dds_strretcode(-result));
  return result;
}

}  // namespace trivela::bus
