#pragma once

#include <optional>
#include <string>

#include "cli/launch/progress_bar.hpp"
#include "cli/launch/signal_inbox.hpp"

namespace trivela::cli {

/// Progress of a file that is being written. Until the first call Ctrl-C ends the program, since nothing is there yet;
/// from then on the call says whether to go on.
class StoppableBar {
 public:
  /// ProgressBar::show(). False: somebody asked to stop.
  bool show(double done, double total, const std::string& unit, const std::string& what) {
    if (!signals_) signals_.emplace();
    bar_.show(done, total, unit, what);
    stopped_ = stopped_ || signals_->stop_requested();
    return !stopped_;
  }

 private:
  std::optional<SignalInbox> signals_;
  ProgressBar bar_;
  bool stopped_ = false;
};

}  // namespace trivela::cli
