#include "bus/entity.hpp"

#include <dds/dds.h>

#include <utility>

namespace trivela::bus {

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
