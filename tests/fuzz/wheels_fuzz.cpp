// Whatever drives, a gyro or their lines say: no crash, a next instant that is not over, samples that are finite, in
// time order and of the past; and no drive is told to turn but by PDO while every drive is in operation. The first byte
// picks the device; each step is a byte of how many ms later it is, one of what happens, and what is said: noise, or a
// frame that is put together so that the drives come up.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>

#include "hal/cia402/cia402_wheels.hpp"
#include "hal/mti/mti.hpp"
#include "tests/fuzz/script.hpp"
#include "tests/hal/scripted_line.hpp"

namespace {

using namespace trivela;
using namespace trivela::hal::cia402;
using trivela::tests::require, trivela::tests::Script;

constexpr std::int64_t kMs = 1'000'000;

/// What drives answer that mean it well, to what was written since; `spoilt`: some of it is not so.
void answer(tests::ScriptedEnd& end, std::uint8_t spoilt) {
  for (const std::string& written : end.written) {
    for (const hal::can::Frame& frame : hal::can::decode(written)) {
      for (const std::uint8_t node : {1, 2, 3}) {
        if (frame == nmt(Nmt::kReset, node)) end.incoming += hal::can::encode(heartbeat(node, NodeState::kBootUp));
        if (frame == hal::cia402::sync())
          end.incoming += hal::can::encode(
              frame_of({spoilt * 1000, 0, statusword_of(static_cast<DriveState>((4 + spoilt) % 9))}, node));
        const auto request = sdo_request_of(frame, node);
        if (!request) continue;
        const hal::can::Frame value = sdo_value(node, request->object, 0x007F00C8U ^ spoilt, 4);
        end.incoming += hal::can::encode(request->write ? sdo_written(node, request->object) : value);
      }
    }
  }
}

bool turns(const std::string& written) {
  const hal::can::Frame frame = hal::can::decode(written).at(0);
  return (frame.id & 0x780U) == kRxPdo1 && number_at(frame, 0, 4) != 0;
}

void play_drives(Script& script) {
  tests::ScriptedEnd end;
  Drives drives{std::make_unique<tests::ScriptedLine>(end), {.gear = 12.0, .rpm_per_unit = 1.0}, kicking::WheelBase{}};
  drives.drive({0.5, 1.0, 2.0});
  std::int64_t now_ns = 0, last_ns = -1;
  while (!script.over()) {
    now_ns += (1 + script.byte() % 64) * kMs;
    const std::uint8_t what = script.byte();
    end.plugged = what % 32 != 0;
    end.takes_bytes = what % 32 != 1;
    if (what % 2 == 0) answer(end, what < 128 ? 0 : script.byte());
    if (what % 8 == 3) end.incoming += script.take(16);
    end.written.clear();
    drives.step(now_ns);
    for (const std::string& written : end.written) require(drives.up() || !turns(written));
    require(drives.next_ns() > now_ns);
    require(!drives.status().empty());
    if (const auto sample = drives.take_sample()) {
      require(sample->t_ns <= now_ns && sample->t_ns > last_ns && std::isfinite(sample->wheel_radps[0]));
      last_ns = sample->t_ns;
    }
  }
  drives.stop();
}

void play_gyro(Script& script) {
  tests::ScriptedEnd end;
  hal::mti::Mti gyro{std::make_unique<tests::ScriptedLine>(end), {}};
  std::int64_t now_ns = 0;
  while (!script.over()) {
    now_ns += (1 + script.byte()) * kMs;
    const std::uint8_t what = script.byte();
    end.plugged = what % 16 != 0;
    if (what % 2 == 1) {  // data of any kind in a message that is whole
      end.incoming += hal::mti::encode({hal::mti::kMtData2, script.take(what / 2)});
    } else {
      end.incoming += script.take(what / 2);
    }
    gyro.step(now_ns);
    require(gyro.next_ns() > now_ns);
    if (gyro.newest()) require(gyro.newest()->t_ns <= now_ns && std::isfinite(gyro.newest()->gyro_radps));
  }
  require(end.written.empty());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Script script{{reinterpret_cast<const char*>(data), size}};
  script.byte() % 2 == 0 ? play_drives(script) : play_gyro(script);
  return 0;
}
