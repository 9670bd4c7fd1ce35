#pragma once

#include <memory>
#include <new>
#include <type_traits>

namespace trivela::kicking {

/// Makes `object` again, where it is, of what `make` returns, which does not look at it; where that throws, it holds
/// nothing. Who copies some hundred bytes that were just written waits until they are.
template <class T, class Make>
void make_in_place(T& object, const Make& make) {
  static_assert(std::is_trivially_destructible_v<T>, "nothing ends what was there");
  ::new (static_cast<void*>(std::addressof(object))) T(make());
}

}  // namespace trivela::kicking
