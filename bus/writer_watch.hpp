#pragma once

#include <cstdint>

namespace trivela::bus {

/// Whether several programs write one stream of one robot. One that takes another's place is no second one; one that
/// comes back within kWindow_ns after another has written is.
class WriterWatch {
 public:
  static constexpr std::int64_t kWindow_ns = 1'000'000'000;

  /// A sample of `writer` came at `now_ns`. True: from here on several write, which was not so before.
  bool see(std::uint64_t writer, std::int64_t now_ns) {
    if (writer == last_) return false;
    const bool back = writer == before_ && now_ns - changed_ns_ < kWindow_ns;
    const bool begins = back && !contested(now_ns);
    if (back) contested_until_ns_ = now_ns + kWindow_ns;
    before_ = last_;
    last_ = writer;
    changed_ns_ = now_ns;
    return begins;
  }

  bool contested(std::int64_t now_ns) const { return now_ns < contested_until_ns_; }

  /// Who wrote last; 0: nobody yet.
  std::uint64_t last() const { return last_; }

 private:
  std::uint64_t last_ = 0;
  std::uint64_t before_ = 0;
  std::int64_t changed_ns_ = 0;
  std::int64_t contested_until_ns_ = 0;
};

}  // namespace trivela::bus
