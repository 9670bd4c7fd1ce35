#pragma once

#include <string>
#include <string_view>

namespace trivela::hal::scip {

/// What an emulated scanner is told to do wrong. A number counts down as it is done.
struct EmulatedFaults {
  bool silent = false;
  int sums_to_corrupt = 0;
  int lines_to_tear = 0;
  int scans_to_skip = 0;
  int statuses = 0;
  std::string status;

  /// A reply to say instead of the one to a request with this echo; empty: the right one.
  std::string refusal(std::string_view echo);
  /// Takes the reply with a scan and gives what is said; empty: nothing.
  std::string spoil(std::string reply);
};

}  // namespace trivela::hal::scip
