#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

namespace trivela::tests {

/// What a fuzzer must find true.
inline void require(bool holds) {
  if (!holds) std::abort();
}

/// Bytes one after the other; none left: zeros.
class Script {
 public:
  explicit Script(std::string_view bytes) : bytes_(bytes) {}
  bool over() const { return bytes_.empty(); }
  std::uint8_t byte() {
    const std::string one = take(1);
    return one.empty() ? std::uint8_t{0} : static_cast<std::uint8_t>(one[0]);
  }
  std::string take(std::size_t count) {
    std::string taken{bytes_.substr(0, count)};
    bytes_.remove_prefix(taken.size());
    return taken;
  }

 private:
  std::string_view bytes_;
};

}  // namespace trivela::tests
