#include "hal/can/frame.hpp"

#include <linux/can.h>
#include <linux/can/error.h>

#include <algorithm>
#include <cstring>
#include <utility>

namespace trivela::hal::can {

Frame standard_frame(std::uint32_t id, std::initializer_list<std::uint8_t> data) {
  Frame frame{.id = id, .extended = false, .error = false, .size = static_cast<std::uint8_t>(data.size()), .data = {}};
  std::ranges::copy(data, frame.data.begin());
  return frame;
}

Frame extended_frame(std::uint32_t id, std::initializer_list<std::uint8_t> data) {
  Frame frame{.id = id, .extended = true, .error = false, .size = static_cast<std::uint8_t>(data.size()), .data = {}};
  std::ranges::copy(data, frame.data.begin());
  return frame;
}

std::string encode(const Frame& frame) {
  can_frame raw{};
  raw.can_id = frame.id | (frame.extended ? CAN_EFF_FLAG : 0U) | (frame.error ? CAN_ERR_FLAG : 0U);
  raw.can_dlc = frame.size;
  std::memcpy(raw.data, frame.data.data(), frame.data.size());
  return {reinterpret_cast<const char*>(&raw), sizeof raw};
}

std::vector<Frame> decode(std::string_view bytes) {
  std::vector<Frame> frames;
  for (; bytes.size() >= sizeof(can_frame); bytes.remove_prefix(sizeof(can_frame))) {
    can_frame raw{};
    std::memcpy(&raw, bytes.data(), sizeof raw);
    if (raw.can_dlc > CAN_MAX_DLEN || (raw.can_id & CAN_RTR_FLAG) != 0) continue;
    Frame frame;
    frame.extended = (raw.can_id & CAN_EFF_FLAG) != 0;
    frame.error = (raw.can_id & CAN_ERR_FLAG) != 0;
    frame.id = raw.can_id & (frame.extended || frame.error ? CAN_EFF_MASK : CAN_SFF_MASK);
    frame.size = raw.can_dlc;
    std::memcpy(frame.data.data(), raw.data, frame.size);
    frames.push_back(frame);
  }
  return frames;
}

bool is_bus_off(const Frame& frame) { return frame.error && (frame.id & CAN_ERR_BUSOFF) != 0; }

std::string describe_error(const Frame& frame) {
  constexpr std::pair<std::uint32_t, const char*> kWords[] = {{CAN_ERR_BUSOFF, "bus off"},
                                                              {CAN_ERR_ACK, "no acknowledgement"},
                                                              {CAN_ERR_TX_TIMEOUT, "sending timed out"},
                                                              {CAN_ERR_CRTL, "controller problem"},
                                                              {CAN_ERR_PROT, "protocol violation"},
                                                              {CAN_ERR_TRX, "transceiver problem"},
                                                              {CAN_ERR_BUSERROR, "bus error"},
                                                              {CAN_ERR_RESTARTED, "restarted"},
                                                              {CAN_ERR_LOSTARB, "arbitration lost"}};
  std::string text;
  for (const auto& [bit, words] : kWords) {
    if ((frame.id & bit) != 0) text += (text.empty() ? "" : ", ") + std::string{words};
  }
  return text.empty() ? "unknown error" : text;
}

}  // namespace trivela::hal::can
