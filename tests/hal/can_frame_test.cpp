#include "hal/can/can_line.hpp"

#include <gtest/gtest.h>
#include <linux/can.h>
#include <linux/can/error.h>

#include <cstring>

namespace trivela::hal::can {
namespace {

TEST(CanFrame, IsTheKernelsAndComesBack) {
  const Frame frame = extended_frame(0x00400060, {0x03, 0xE8, 0x03});
  const std::string bytes = encode(frame);
  can_frame raw{};
  ASSERT_EQ(bytes.size(), sizeof raw);
  std::memcpy(&raw, bytes.data(), sizeof raw);
  EXPECT_EQ(raw.can_id, 0x00400060 | CAN_EFF_FLAG);
  EXPECT_EQ(raw.can_dlc, 3);
  EXPECT_EQ(raw.data[1], 0xE8);
  EXPECT_EQ(decode(bytes), std::vector{frame});
  const Frame standard{.id = 0x7FF, .size = 8, .data = {1, 2, 3, 4, 5, 6, 7, 8}};
  EXPECT_EQ(decode(encode(frame) + encode(standard)), (std::vector{frame, standard}));
}

TEST(CanFrame, ThatIsTornTooLongOrARequestIsLeftOut) {
  std::string torn = encode(extended_frame(1, {2}));
  torn.pop_back();
  EXPECT_TRUE(decode(torn).empty());
  can_frame raw{};
  raw.can_dlc = 9;
  EXPECT_TRUE(decode({reinterpret_cast<const char*>(&raw), sizeof raw}).empty());
  raw = {};
  raw.can_id = 5 | CAN_RTR_FLAG;
  EXPECT_TRUE(decode({reinterpret_cast<const char*>(&raw), sizeof raw}).empty());
}

TEST(CanFrame, SaysAnErrorInWords) {
  const Frame bus_off{.id = CAN_ERR_BUSOFF | CAN_ERR_ACK, .error = true};
  EXPECT_TRUE(is_bus_off(decode(encode(bus_off)).at(0)));
  EXPECT_EQ(describe_error(bus_off), "bus off, no acknowledgement");
  EXPECT_FALSE(is_bus_off({.id = CAN_ERR_BUSOFF}));
}

TEST(CanLine, SaysWhatIsNotThere) {
  const auto interface = can_line("can97");
  EXPECT_EQ(interface->open({}), Line::Opening::kFailed);
  EXPECT_NE(interface->why(), "");  // no such device, or a kernel without CAN
  const auto socket = can_line("/nowhere/can");
  EXPECT_EQ(socket->open({}), Line::Opening::kFailed);
  EXPECT_EQ(socket->why(), "no such file or directory");
  EXPECT_EQ(can_line("/" + std::string(200, 'x'))->open({}), Line::Opening::kFailed);
}

}  // namespace
}  // namespace trivela::hal::can
