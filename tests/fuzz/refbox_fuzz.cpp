// Whatever a referee box sends, in whatever pieces: no crash, the same words as in one piece, and no more kept of an
// object that never ends than the league allows. The first byte picks protocol and colour, the second the pieces.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "hal/refbox/words.hpp"
#include "tests/fuzz/script.hpp"

namespace {

using namespace trivela::hal::refbox;
using trivela::tests::require;

std::vector<ParsedCommand> words_of(const TeamMarks& team, std::string_view bytes, std::size_t piece) {
  CommandStream stream(team);
  std::vector<ParsedCommand> words;
  while (!bytes.empty()) {
    for (ParsedCommand& word : stream.add(bytes.substr(0, piece))) words.push_back(std::move(word));
    bytes.remove_prefix(std::min(piece, bytes.size()));
  }
  return words;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 2, size - 2);
  const TeamMarks team{data[0] % 2 == 0 ? Protocol::kJson : Protocol::kLetters, "224.16.32.39",
                       data[0] % 4 < 2 ? Colour::kCyan : Colour::kMagenta};
  const std::vector<ParsedCommand> whole = words_of(team, bytes, bytes.size() + 1);
  require(whole == words_of(team, bytes, std::size_t{1} + data[1] % 64));
  for (const ParsedCommand& word : whole) {
    if (const auto* const none = std::get_if<NoCommand>(&word)) require(!none->why.empty());
  }
  Framing framing;
  framing.add(bytes);
  require(framing.pending_bytes() <= kLongestObject_B);
  return 0;
}
