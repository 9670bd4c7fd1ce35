#pragma once

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <array>
#include <stdexcept>
#include <string>
#include <string_view>

namespace trivela::e2e {

/// A pseudo-terminal for a program's standard input, and whoever types at it.
class TypedTerminal {
 public:
  /// Throws std::runtime_error where the system has none.
  TypedTerminal() : keys_(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
    std::array<char, 128> name{};
    if (keys_ < 0 || ::grantpt(keys_) != 0 || ::unlockpt(keys_) != 0 ||
        ::ptsname_r(keys_, name.data(), name.size()) != 0)
      throw std::runtime_error{"no pseudo-terminal"};
    terminal_ = ::open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  }
  TypedTerminal(const TypedTerminal&) = delete;
  TypedTerminal& operator=(const TypedTerminal&) = delete;
  ~TypedTerminal() {
    ::close(terminal_);
    ::close(keys_);
  }

  /// For Program's `prepare`: standard input is this terminal.
  void become_input() const { ::dup2(terminal_, STDIN_FILENO); }

  void type(std::string_view keys) const {
    if (::write(keys_, keys.data(), keys.size()) != static_cast<ssize_t>(keys.size()))
      throw std::runtime_error{"the terminal takes no keys"};
  }

 private:
  int keys_;
  int terminal_ = -1;
};

}  // namespace trivela::e2e
