#pragma once

#include <optional>
#include <string>

#include "hal/scip/messages.hpp"
#include "hal/scip/reply.hpp"
#include "kicking/lob/scan.hpp"

namespace trivela::hal::scip {

/// How scans are asked for: one MD without an end, or a GD for each.
enum class Asking { kContinuous, kOneByOne };

/// The conversation from an open line to a scanner that measures: QT, and RS where that stays unanswered, end what an
/// earlier host began; then SCIP2.0, VV, PP, II, BM and MD. One request is open at a time. No clock, no line: the
/// caller sends request() and says what came.
class StartUp {
 public:
  explicit StartUp(Asking asking) : asking_(asking) {}

  enum class Progress {
    kWaiting,  ///< for the answer to request()
    kNext,     ///< request() is another one, or has to be sent again
    kDone,
    kFailed,  ///< why() says it
  };

  /// Without its line feed.
  std::string request() const;
  Progress take(const Reply& reply);
  /// The answer did not come: the request is repeated once, passed over if the rest works without, or given up.
  Progress timed_out();

  /// Known once done.
  const kicking::lob::ScannerIdentity& identity() const { return identity_; }
  const Parameters& parameters() const { return parameters_; }
  const std::string& why() const { return why_; }

 private:
  enum class Step { kQuit, kReset, kScip2, kVersion, kParameters, kState, kLaserOn, kMeasure, kDone };

  Progress go(Step step);
  Progress fail(const std::string& why);
  Progress take_answer(const Reply& reply);

  Asking asking_;
  Step step_ = Step::kQuit;
  bool repeated_ = false;
  kicking::lob::ScannerIdentity identity_;
  Parameters parameters_;
  std::string condition_;  // by II
  std::string why_;
};

}  // namespace trivela::hal::scip
