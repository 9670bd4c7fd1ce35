#pragma once

#include <stdexcept>
#include <string>

namespace trivela::log {

/// Why a log is refused.
enum class Refused {
  kNoLog,         ///< it is not there, or another file
  kEmpty,         ///< a file of no bytes
  kOtherVersion,  ///< of the schema
  kForeignIndex,  ///< on one of its tables
  kWrongCounts,   ///< what was counted of a session is not what its rows give
  kDamaged,       ///< anything else that is not as it was recorded
};

/// A log that is not read; what() names the file.
class RefusedLog : public std::runtime_error {
 public:
  /// what() is `found` and `advice`.
  RefusedLog(Refused why, const std::string& found, const std::string& advice = "")
      : std::runtime_error(found + advice), why_(why), found_(found) {}

  Refused why() const { return why_; }

  /// what() without its advice.
  const std::string& found() const { return found_; }

 private:
  Refused why_;
  std::string found_;
};

}  // namespace trivela::log
