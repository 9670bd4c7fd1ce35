#include "bus/domain/cyclone.hpp"

#include <dds/dds.h>
#include <fmt/core.h>

#include <utility>

namespace trivela::bus {

Error::Error(std::string_view call, std::string_view about, std::string_view reason)
    : std::runtime_error(fmt::format("bus: {} ({}): {}", call, about, reason)) {}

void refuse(std::int32_t result, std::string_view call, std::string_view about) {
  throw Error(call, about, dds_strretcode(-result));
}

Entity& Entity::operator=(Entity&& other) noexcept {
  if (this != &other) {
    reset();
    handle_ = other.release();
  }
  return *this;
}

void Entity::reset() noexcept {
  if (handle_ != 0) dds_delete(release());
}

std::int32_t Entity::release() noexcept { return std::exchange(handle_, 0); }

}  // namespace trivela::bus
