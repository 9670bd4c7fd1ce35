#include "hal/bus/bridge.hpp"

#include <gtest/gtest.h>

#include "bus/writer.hpp"
#include "idl/messages.hpp"
#include "tests/bus/test_domain.hpp"

namespace trivela::hal {
namespace {

TEST(ReadNewer, ASampleFromTheFarFutureDoesNotSilenceThoseThatFollow) {
  const bus::Participant participant{bus::fresh_domain(), bus::RealTime{}};
  bus::Writer<msg::DeviceWheels> writer{participant};
  bus::Reader<msg::DeviceWheels> reader{participant};
  std::optional<std::int64_t> after_t_ns;
  const auto say = [&](std::int64_t t_ns) {
    msg::DeviceWheels sample{};
    sample.robot_id = 1;
    sample.t_ns = t_ns;
    writer.write(sample);
    return read_newer(reader, 1, after_t_ns, std::chrono::milliseconds{100});
  };
  EXPECT_TRUE(say(1000));
  EXPECT_FALSE(say(std::numeric_limits<std::int64_t>::max()));
  const auto next = say(2000);
  ASSERT_TRUE(next);
  EXPECT_EQ(next->t_ns, 2000);
}

}  // namespace
}  // namespace trivela::hal
