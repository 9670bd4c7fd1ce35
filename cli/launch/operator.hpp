#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "cli/launch/signal_inbox.hpp"

namespace trivela::cli {

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
