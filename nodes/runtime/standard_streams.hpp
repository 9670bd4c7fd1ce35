#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

namespace trivela::nodes {

/// First thing in a main: whoever closed standard input, output or error must not have what this process opens next in
/// their place: a log line would go into a socket or a database. What is written to a stream that was closed fails as
/// before.
inline void secure_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) >= 0 || errno != EBADF) continue;
    // The lowest free number, which is this one. The wrong way round, so that its use is an error still.
    [[maybe_unused]] const int nowhere = open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

}  // namespace trivela::nodes
