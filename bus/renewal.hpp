#pragma once

#include <mutex>

#include "bus/reader.hpp"

namespace trivela::bus {

/// In real time, makes a reader again that has heard nothing for too long; true if it did. `taking` is what who takes
/// holds: it is not held while Cyclone makes and deletes readers, since a listener may wait for it that Cyclone waits
/// for. `attach`, under it, is for who waits for the reader's condition(), which then is another one. Not for
/// listeners.
template <class Mutex, class F>
bool renew_if_silent(AnyReader& reader, Mutex& taking, F&& attach) {
  Entity outlived;
  {
    const std::lock_guard lock(taking);
    outlived = reader.outlived();
    if (!reader.time_to_renew()) return false;
  }
  Entity again = reader.open();
  AnyReader::Retired old;
  {
    const std::lock_guard lock(taking);
    old = reader.replace(std::move(again));
    attach();
  }
  return true;
}

/// The same for a reader that one thread alone uses.
inline bool renew_if_silent(AnyReader& reader) {
  const Entity outlived = reader.outlived();
  if (!reader.time_to_renew()) return false;
  const auto old = reader.replace(reader.open());
  return true;
}

}  // namespace trivela::bus
