#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <stdexcept>
#include <string>

namespace trivela::faults {

/// What a process says on its standard output, line by line.
class LinePipe {
 public:
  /// Throws std::runtime_error if there is no pipe to be had.
  LinePipe() {
    if (pipe2(ends_.data(), O_CLOEXEC) != 0) throw std::runtime_error{"no pipe to be had"};
    fcntl(ends_[0], F_SETFL, O_NONBLOCK);
    fcntl(ends_[0], F_SETPIPE_SZ, 1 << 20);
  }
  LinePipe(const LinePipe&) = delete;
  LinePipe& operator=(const LinePipe&) = delete;
  ~LinePipe() {
    close(ends_[0]);
    close_write_end();
  }

  /// For the process that says something; close it here once the process has it.
  int write_end() const { return ends_[1]; }
  void close_write_end() {
    if (ends_[1] >= 0) close(ends_[1]);
    ends_[1] = -1;
  }

  /// Readable when there is something to hear.
  int file_descriptor() const { return ends_[0]; }

  /// Hands every whole line that has come to `line`. False: nobody will say anything any more.
  bool receive(auto&& line) {
    std::array<char, 65536> buffer;
    for (;;) {
      const ssize_t size = read(ends_[0], buffer.data(), buffer.size());
      if (size == 0) return false;
      if (size < 0) return true;
      rest_.append(buffer.data(), static_cast<std::size_t>(size));
      std::size_t begin = 0;
      for (std::size_t end; (end = rest_.find('\n', begin)) != std::string::npos; begin = end + 1)
        line(rest_.substr(begin, end - begin));
      rest_.erase(0, begin);
    }
  }

 private:
  std::array<int, 2> ends_{-1, -1};
  std::string rest_;
};

}  // namespace trivela::faults
