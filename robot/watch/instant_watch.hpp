#pragma once

#include <cstdint>
#include <map>
#include <optional>

namespace trivela::robot {

/// Tells instants that cannot be true from the others: one more than a minute from its predecessor by the same writer
/// is not believed before the next one of that writer is near it.
class InstantWatch {
 public:
  bool believes(std::uint64_t writer, std::int64_t t_ns) {
    Stream& stream = streams_[writer];
    if (stream.last_ns && !near(*stream.last_ns, t_ns) && !(stream.doubted_ns && near(*stream.doubted_ns, t_ns))) {
      stream.doubted_ns = t_ns;
      return false;
    }
    stream = {t_ns, std::nullopt};
    return true;
  }

 private:
  static constexpr std::uint64_t kFarthest_ns = 60'000'000'000;

  static bool near(std::int64_t a_ns, std::int64_t b_ns) {
    const auto a = static_cast<std::uint64_t>(a_ns);
    const auto b = static_cast<std::uint64_t>(b_ns);
    return (a_ns > b_ns ? a - b : b - a) <= kFarthest_ns;
  }

  struct Stream {
    std::optional<std::int64_t> last_ns;
    std::optional<std::int64_t> doubted_ns;
  };
  std::map<std::uint64_t, Stream> streams_;
};

}  // namespace trivela::robot
