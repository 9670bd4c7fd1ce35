#pragma once

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdlib>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "cli/launch/signals.hpp"

namespace trivela::cli {

/// A terminal that obeys escape sequences, so that lines can be drawn over: TERM names one that is not dumb.
inline bool can_be_drawn_over(int descriptor) {
  const char* const term = std::getenv("TERM");
  return isatty(descriptor) != 0 && term != nullptr && *term != '\0' && std::string_view{term} != "dumb";
}

/// The width of a terminal in columns; of a file, or where nobody knows it, no limit.
inline std::size_t columns_of(int descriptor) {
  winsize size{};
  const bool known = ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : std::numeric_limits<std::size_t>::max();
}

/// The line, or as much of it as goes into so many columns, a column for each character of UTF-8.
inline std::string cut_to(std::string_view line, std::size_t columns) {
  std::size_t end = 0;
  for (std::size_t used = 0; end < line.size(); ++end) {
    const bool begins = (static_cast<unsigned char>(line[end]) & 0xC0U) != 0x80U;
    if (begins && used++ == columns) break;
  }
  return std::string{line.substr(0, end)};
}

/// cut_to() of each line of a text.
inline std::string lines_cut_to(std::string_view text, std::size_t columns) {
  std::string lines;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    lines += cut_to(text.substr(0, end), columns);
    if (end == std::string_view::npos) break;
    lines += '\n';
    text.remove_prefix(end + 1);
  }
  return lines;
}

/// Whoever sits at the terminal: reads what this program says on standard output, types on standard input.
class Operator {
 public:
  /// `signals` outlives it.
  explicit Operator(SignalInbox& signals) : signals_(signals) {}

  /// Standard input is a terminal: somebody can answer.
  static bool is_there();

  /// Says the question and waits for a line, which comes without its end. None: somebody asked to stop, or no line will
  /// come any more. What was typed before the question does not count.
  std::optional<std::string> ask(std::string_view question);

  /// Asks for the word, which confirms what was said before; whatever else is typed does not.
  bool confirms(std::string_view word);

 private:
  SignalInbox& signals_;
};

}  // namespace trivela::cli
