// Whatever a board or its line says: no crash, no kick that nobody ordered, none twice, and a next instant that is not
// over. The first byte picks the board; each step is a byte of how many ms later it is, one of what happens, and bytes
// that the board says.
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>

#include "hal/can/can_line.hpp"
#include "hal/ioboard/io_board.hpp"
#include "hal/rekick/rekick.hpp"
#include "tests/fuzz/script.hpp"
#include "tests/hal/scripted_line.hpp"

namespace {

using namespace trivela;
using trivela::tests::require, trivela::tests::Script;

constexpr std::int64_t kMs = 1'000'000;

bool is_kick(const std::string& written, bool over_can) {
  if (!over_can) return written.at(1) == static_cast<char>(hal::ioboard::Command::kShoot);
  return hal::can::decode(written).at(0).data[0] == static_cast<std::uint8_t>(hal::rekick::Command::kKick);
}

void play(hal::KickerBoard& board, tests::ScriptedEnd& end, Script& script, bool over_can) {
  std::int64_t now_ns = 0;
  std::size_t ordered = 0;
  std::int64_t last_sample_ns = -1;
  while (!script.over()) {
    now_ns += script.byte() * kMs;
    const std::uint8_t what = script.byte();
    end.plugged = what % 16 != 0;
    end.takes_bytes = what % 16 != 1;
    if (what % 4 == 2 && board.up() && board.shoot(what, now_ns).empty()) ++ordered;
    end.incoming += script.take(what % 32);
    board.step(now_ns);
    require(board.next_ns() > now_ns);
    if (const auto sample = board.take_sample()) {
      require(sample->t_ns <= now_ns && sample->t_ns >= last_sample_ns && !(sample->charge < 0.0));
      last_sample_ns = sample->t_ns;
    }
  }
  std::size_t kicks = 0;
  for (const std::string& written : end.written) kicks += is_kick(written, over_can) ? 1 : 0;
  require(kicks == ordered);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Script script{{reinterpret_cast<const char*>(data), size}};
  const bool over_can = script.byte() % 2 == 1;
  tests::ScriptedEnd end;
  auto line = std::make_unique<tests::ScriptedLine>(end);
  std::unique_ptr<hal::KickerBoard> board;
  if (over_can) {
    board = std::make_unique<hal::rekick::ReKick>(std::move(line), config::ReKickDevice{});
  } else {
    board = std::make_unique<hal::ioboard::IoBoard>(std::move(line), config::IoBoardDevice{.lever = 120});
  }
  play(*board, end, script, over_can);
  return 0;
}
