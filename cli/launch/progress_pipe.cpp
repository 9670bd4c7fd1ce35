#include "cli/launch/progress_pipe.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

namespace trivela::cli {

ProgressPipe::ProgressPipe() {
  if (pipe2(ends_.data(), O_CLOEXEC) != 0)
    throw std::runtime_error{fmt::format("no pipe for the progress: {}", std::strerror(errno))};
  fcntl(ends_[0], F_SETFL, O_NONBLOCK);
}

ProgressPipe::~ProgressPipe() {
  close(ends_[0]);
  close_write_end();
}

void ProgressPipe::close_write_end() {
  if (ends_[1] >= 0) close(ends_[1]);
  ends_[1] = -1;
}

bool ProgressPipe::take() {
  std::array<char, 4096> chunk{};
  ssize_t n = 0;
  while ((n = read(ends_[0], chunk.data(), chunk.size())) > 0) text_.append(chunk.data(), static_cast<std::size_t>(n));
  for (auto end = text_.find('\n'); end != std::string::npos; end = text_.find('\n')) {
    take_line(text_.substr(0, end));
    text_.erase(0, end + 1);
  }
  return n == 0;
}

void ProgressPipe::take_line(const std::string& line) {
  if (line.find('=') != std::string::npos) {
    if (!begun_) settings_.push_back(line);
    return;
  }
  char* rest = nullptr;
  played_s_ = std::strtod(line.c_str(), &rest);
  total_s_ = std::strtod(rest, &rest);
  begun_ = true;
  whole_ = whole_ || std::strncmp(rest, " end", 4) == 0;
}

}  // namespace trivela::cli
