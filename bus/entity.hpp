#pragma once

#include <cstdint>

namespace trivela::bus {

/// Owns one handle of Cyclone's; deleted with its owner. 0: none.
class Entity {
 public:
  Entity() = default;
  explicit Entity(std::int32_t handle) : handle_(handle) {}
  Entity(Entity&& other) noexcept : handle_(other.release()) {}
  Entity& operator=(Entity&& other) noexcept;
  ~Entity() { reset(); }

  std::int32_t handle() const { return handle_; }
  void reset() noexcept;

 private:
  std::int32_t release() noexcept;

  std::int32_t handle_ = 0;
};

}  // namespace trivela::bus
