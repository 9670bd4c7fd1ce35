#include "nodes/runtime/log_sinks.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <spdlog/logger.h>

#include <array>
#include <string>

namespace trivela::nodes {
namespace {

/// A pipe that nobody reads, and what somebody finds in it later.
struct Pipe {
  Pipe() { EXPECT_EQ(pipe(ends.data()), 0); }
  ~Pipe() {
    for (const int end : ends) close(end);
  }
  void fill() const {
    fcntl(ends[1], F_SETFL, O_NONBLOCK);
    const std::string page(4096, '.');
    while (write(ends[1], page.data(), page.size()) > 0) {
    }
    fcntl(ends[1], F_SETFL, 0);
  }
  std::string drain() const {
    std::string all;
    std::array<char, 4096> bytes{};
    fcntl(ends[0], F_SETFL, O_NONBLOCK);
    for (ssize_t n = 0; (n = read(ends[0], bytes.data(), bytes.size())) > 0;)
      all.append(bytes.data(), static_cast<std::size_t>(n));
    return all;
  }
  std::array<int, 2> ends{};
};

TEST(ErrorStream, ALineWithoutRoomIsCountedAndHoldsNobodyUp) {
  const Pipe pipe;
  spdlog::logger logger("node", std::make_shared<ErrorStream>(pipe.ends[1]));
  logger.set_pattern("%v");
  logger.warn("first");
  EXPECT_EQ(pipe.drain(), "first\n");
  pipe.fill();
  logger.warn("second");  // would wait here for ever
  logger.warn("third");
  EXPECT_EQ(pipe.drain().find("second"), std::string::npos);
  logger.warn("fourth");
  EXPECT_EQ(pipe.drain(), "2 lines left out: nobody read them\nfourth\n");
}

TEST(ErrorStream, ALastLineWaitsNoLongerThanItMay) {
  const Pipe pipe;
  EXPECT_TRUE(write_line(pipe.ends[1], "why\n", 0));
  EXPECT_EQ(pipe.drain(), "why\n");
  pipe.fill();
  EXPECT_FALSE(write_line(pipe.ends[1], "why\n", 1));
}

}  // namespace
}  // namespace trivela::nodes
