#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace trivela::hal::refbox {

/// An object of the stream; the league allows less than 100 kB (RoboCup-MSL/RefBox, mslrb2015/Comms.pde).
struct Framed {
  std::string text;       ///< without its NUL; of an overlong one nothing
  bool overlong = false;  ///< it was longer than kLongestObject_B and is left out
};

inline constexpr std::size_t kLongestObject_B = 100'000;

/// Cuts a stream of bytes into the objects that a NUL ends: however many or few of them a read brings. It holds no more
/// than kLongestObject_B of an object, whatever comes. What is empty or blank between two NULs is no object.
class Framing {
 public:
  /// The objects that these bytes end, in their order.
  std::vector<Framed> add(std::string_view bytes);

  /// Bytes of an object that has not ended.
  std::size_t pending_bytes() const { return pending_.size(); }

 private:
  void extend(std::string_view part);

  std::string pending_;
  bool overlong_ = false;  // the object under way; its bytes are left out up to its NUL
};

}  // namespace trivela::hal::refbox
