#include "log/write/commit_pace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace trivela::log {
namespace {

double seconds(CommitPace::Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

}  // namespace

CommitPace::CommitPace(double span_s)
    : span_(std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(span_s))) {
  recent_[0] = span_ / 2;  // the disk is not known yet
}

CommitPace::Clock::duration CommitPace::wait() const {
  const Clock::duration slowest = *std::ranges::max_element(recent_);
  return span_ - span_ / 10 - std::clamp(slowest, span_ / 4, span_ / 2);
}

std::optional<std::string> CommitPace::committed(Clock::duration commit, Clock::duration age, Clock::time_point now) {
  recent_[next_] = commit;
  next_ = (next_ + 1) % kRecent;
  oldest_ = std::max(oldest_, age);
  if (age <= span_) return std::nullopt;
  latest_ = std::max(latest_, age);
  ++late_;
  if (said_ && now - *said_ < kQuiet) return std::nullopt;
  said_ = now;
  return fmt::format(
      "rows waited up to {:.3f} s for the disk, {:.3g} s are allowed; the last commit took {:.3f} s ({} late)",
      seconds(std::exchange(latest_, {})), seconds(span_), seconds(commit), std::exchange(late_, 0));
}

}  // namespace trivela::log
