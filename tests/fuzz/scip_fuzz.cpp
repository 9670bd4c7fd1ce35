// Any bytes into the reading side of the SCIP client: parser, decoding, the conversation, geometry, scans. The first
// byte says how the others are cut into pieces.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <utility>
#include <vector>

#include "hal/scip/messages.hpp"
#include "hal/scip/reply.hpp"
#include "hal/scip/scan_intake.hpp"
#include "hal/scip/start_up.hpp"

namespace {

using namespace trivela::hal::scip;

void require(bool holds) {
  if (!holds) std::abort();
}

std::vector<Reply> read_in_pieces(ReplyParser& parser, std::string_view text, std::size_t size) {
  std::vector<Reply> replies;
  for (; !text.empty(); text.remove_prefix(std::min(size, text.size()))) {
    for (Reply& reply : parser.feed(text.substr(0, size))) replies.push_back(std::move(reply));
  }
  return replies;
}

void check_geometry(const Parameters& parameters) {
  const auto geometry = geometry_of(parameters);
  require(geometry.beams >= 1 && geometry.beams <= 10000);
  require(geometry.step_rad > 0.0 && geometry.beam_period_s > 0.0 && geometry.scan_period_s > 0.0);
  require(static_cast<double>(geometry.beams) * geometry.beam_period_s <= geometry.scan_period_s * (1.0 + 1e-9));
  require(std::isfinite(geometry.first_angle_rad) && geometry.min_range_m < geometry.max_range_m);
  require(measure_request(whole_section(parameters)).size() == 15);
}

void check_scan(const Reply& reply) {
  require(reply.data.size() <= ReplyParser::kLongestReply);
  const auto ranges = ranges_of(reply, reply.data.size() / 3);
  if (!ranges) return;
  for (std::size_t i = 0; i < ranges->size(); ++i) {
    require((*ranges)[i] < 1U << 18U && encode((*ranges)[i], 3) == reply.data.substr(3 * i, 3));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view text{reinterpret_cast<const char*>(bytes) + 1, size - 1};
  ReplyParser whole;
  ReplyParser pieces;
  const auto replies = whole.feed(text);
  const auto same = read_in_pieces(pieces, text, bytes[0] % 97U + 1U);
  const Damages damages = whole.take_damages();
  const Damages same_damages = pieces.take_damages();
  require(replies.size() == same.size());
  require(damages.torn == same_damages.torn && damages.wrong_sums == same_damages.wrong_sums);
  StartUp start_up{bytes[0] % 2 == 0 ? Asking::kContinuous : Asking::kOneByOne};
  ScanIntake intake{bytes[0] % 2 == 0 ? Asking::kContinuous : Asking::kOneByOne, {"", 20, 5600, 1024, 0, 47, 20, 600}};
  trivela::hal::LinkCounters counters;
  std::int64_t arrival_ns = 1;
  for (std::size_t i = 0; i < replies.size(); ++i) {
    const Reply& reply = replies[i];
    require(reply.echo == same[i].echo && reply.data == same[i].data && reply.stamp_ms == same[i].stamp_ms);
    check_scan(reply);
    if (const auto parameters = parameters_of(reply)) check_geometry(*parameters);
    identity_of(reply);
    state_of(reply);
    require(!meaning(reply.echo, reply.status).empty());
    require(start_up.request().size() <= 15);
    if (start_up.take(reply) == StartUp::Progress::kWaiting) start_up.timed_out();
    const auto scan = intake.take(reply, arrival_ns += 25'000'000, counters);
    require(!scan || (scan->t_ns <= arrival_ns && scan->range_mm.size() == intake.geometry().beams));
  }
  require(counters.scans + counters.torn_lines + counters.error_replies <= replies.size());
  return 0;
}
