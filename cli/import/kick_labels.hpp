#pragma once

#include <istream>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "idl/messages.hpp"

namespace trivela::cli {

/// A kick as somebody saw it on a video.
struct KickLabel {
  std::optional<double> time_s;  ///< of the kick on the video; none: not noted
  msg::Policy policy{};
  msg::Outcome outcome{};       ///< OUTCOME_UNKNOWN of one that was outside without a reason, too
  bool outside = false;         ///< it was outside, for whatever reason
  std::optional<bool> saved{};  ///< on target: a keeper stopped it; none: not noted
  std::string by;
  int half = 1;
  int robot_id = 0;  ///< 0: not noted
};

/// The labels of a file.
struct KickLabels {
  std::string file;
  std::string text;  ///< the file as it is
  std::vector<KickLabel> kicks;

  /// Who labelled, by the alphabet.
  std::set<std::string> labellers() const;
  std::int64_t timed() const;
};

/// Reads columns `time` (seconds such as 83.5, or m:ss, h:mm:ss; empty: not noted), `policy` (stopped, moving or
/// another one that plays), `outcome` (goal, saved, inside, outside, unknown, or why it missed: wide_left,
/// wide_right, over, short, post, bar, blocked), `by`, and if wanted `half` (1, 2; overtime 3, 4) and `robot` (1 to
/// 255). Throws std::runtime_error naming file, line, column and value where a cell is none of these, a column is
/// unknown or missing, or no row is there.
KickLabels read_kick_labels(std::istream& in, const std::string& file);

}  // namespace trivela::cli
