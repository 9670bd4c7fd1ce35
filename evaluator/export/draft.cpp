#include "evaluator/export/draft.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <stdexcept>

namespace trivela::evaluator {
namespace {

namespace fs = std::filesystem;

/// "out/csv/" names the folder "out/csv".
fs::path without_slash(const fs::path& path) {
  return path.has_filename() || !path.has_parent_path() ? path : path.parent_path();
}

}  // namespace

Draft::Draft(const fs::path& place) : place_(without_slash(place)), draft_(place_) {
  draft_ += fmt::format(".{}.new", getpid());
}

Draft::~Draft() {
  std::error_code ignored;
  fs::remove_all(draft_, ignored);
}

void Draft::keep() {
  std::error_code failed;
  if (fs::is_directory(draft_) && fs::is_directory(place_)) {
    for (const auto& entry : fs::directory_iterator(draft_)) {
      if (!failed) fs::rename(entry.path(), place_ / entry.path().filename(), failed);
    }
  } else {
    fs::rename(draft_, place_, failed);
  }
  if (failed) throw std::runtime_error(fmt::format("cannot write {}: {}", place_.string(), failed.message()));
}

}  // namespace trivela::evaluator
