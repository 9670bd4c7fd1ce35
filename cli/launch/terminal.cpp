#include "cli/launch/terminal.hpp"

#include <fmt/core.h>
#include <poll.h>
#include <termios.h>

#include <array>
#include <cstdio>

#include "cli/options/output.hpp"

namespace trivela::cli {

bool Operator::is_there() { return ::isatty(STDIN_FILENO) != 0; }

std::optional<std::string> Operator::ask(std::string_view question) {
  ::tcflush(STDIN_FILENO, TCIFLUSH);
  say(question);
  std::fflush(stdout);
  std::string line;
  for (;;) {
    std::array<pollfd, 2> sources{pollfd{signals_.file_descriptor(), POLLIN, 0}, pollfd{STDIN_FILENO, POLLIN, 0}};
    ::poll(sources.data(), sources.size(), -1);
    if (sources[0].revents != 0 && signals_.stop_requested()) return std::nullopt;
    if (sources[1].revents == 0) continue;
    char typed = 0;
    if (::read(STDIN_FILENO, &typed, 1) != 1) return std::nullopt;
    if (typed == '\n') return line;
    line += typed;
  }
}

bool Operator::confirms(std::string_view word) {
  const auto answer = ask(fmt::format("Type {} and press Enter to go on: ", word));
  return answer && *answer == word;
}

}  // namespace trivela::cli
