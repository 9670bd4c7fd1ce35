#pragma once

#include <filesystem>

namespace trivela::evaluator {

/// A file or folder that is written beside its place, as NAME.PID.new, and gets its name when it is whole: who is
/// stopped leaves nothing by that name, and who is killed leaves the draft.
class Draft {
 public:
  explicit Draft(const std::filesystem::path& place);
  Draft(const Draft&) = delete;
  Draft& operator=(const Draft&) = delete;
  ~Draft();

  const std::filesystem::path& path() const { return draft_; }

  /// Gives it its name. A file takes the place of one that is there; the files of a folder take their places in one
  /// that is there, one after the other. Throws std::runtime_error naming the place.
  void keep();

 private:
  std::filesystem::path place_, draft_;
};

}  // namespace trivela::evaluator
