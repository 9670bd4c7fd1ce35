#include "monitor/bus_picture.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

namespace trivela::monitor {
namespace {

using std::chrono::seconds;
using testing::DoubleEq;
using testing::Gt;

constexpr const char* kStat =
    "7 (a (b) c) S 1 7 7 0 -1 4194304 100 0 0 0 250 50 0 0 20 0 3 0 1000 1000000 500 18446744073709551615";

TEST(Process, IsReadWhateverItsNameIs) {
  const auto reading = parse_process(kStat, "900 300 100 1 0 200 0\n", 100.0, 4096);
  ASSERT_TRUE(reading);
  EXPECT_THAT(reading->cpu_s, DoubleEq(3.0));
  EXPECT_EQ(reading->memory_bytes, 300 * 4096);
}

TEST(Process, ThatHasEndedIsNone) {
  EXPECT_FALSE(parse_process("", "", 100.0, 4096));
  EXPECT_FALSE(parse_process("7 (a) S 1 7", "900 300", 100.0, 4096));
  EXPECT_FALSE(parse_process("7 (a) Z 1 7 7 0 -1 0 0 0 0 0 1 1 0 0 20", "0 0 0 0 0 0 0", 100.0, 4096))
      << "a zombie waits for its parent alone";
}

TEST(Process, OfThisTestTakesMemory) {
  const auto reading = read_process(getpid());
  ASSERT_TRUE(reading);
  EXPECT_THAT(reading->memory_bytes, Gt(1'000'000));
  EXPECT_FALSE(read_process(0));
}

TEST(ProcessLoads, TakeTheProcessorTimeBetweenTwoLooks) {
  ProcessLoads loads;
  const ProcessLoads::Clock::time_point start{seconds{100}};
  EXPECT_EQ(loads.look(7, ProcessReading{4096, 10.0}, start)->cpu_percent, std::nullopt);
  EXPECT_THAT(loads.look(7, ProcessReading{4096, 10.5}, start + seconds{2})->cpu_percent, testing::Optional(25.0));
  EXPECT_FALSE(loads.look(7, std::nullopt, start + seconds{3}));
  EXPECT_EQ(loads.look(7, ProcessReading{4096, 0.1}, start + seconds{4})->cpu_percent, std::nullopt)
      << "another process of the same number";
}

}  // namespace
}  // namespace trivela::monitor
