#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

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

/// Knows in lockstep when a cycle is recorded: once every stream that has a sample a cycle has brought it. Their
/// writers keep the last sample only, so that the next cycle must not begin before.
class CycleWatch {
 public:
  /// One more stream to wait for; returns its number.
  std::size_t add() {
    latest_t_ns_.push_back(kNothing);
    return latest_t_ns_.size() - 1;
  }

  /// The cycle that is complete with this sample; none if it is not, or was before.
  std::optional<std::int64_t> see(std::size_t stream, std::int64_t t_ns) {
    latest_t_ns_[stream] = std::max(latest_t_ns_[stream], t_ns);
    const std::int64_t complete = *std::min_element(latest_t_ns_.begin(), latest_t_ns_.end());
    if (complete <= reported_t_ns_) return std::nullopt;
    reported_t_ns_ = complete;
    return complete;
  }

 private:
  static constexpr std::int64_t kNothing = -1;
  std::vector<std::int64_t> latest_t_ns_;
  std::int64_t reported_t_ns_ = kNothing;
};

}  // namespace trivela::robot
