#include "evaluator/sessions/recording_gaps.hpp"

#include <fmt/format.h>

#include "evaluator/metrics/silences.sql.hpp"
#include "evaluator/metrics/unrecorded_orders.sql.hpp"
#include "kicking/geometry/time.hpp"

namespace trivela::evaluator {
namespace {

constexpr std::size_t kMostLines = 8;

std::string sentence(const RecordedSilence& silence) {
  const std::string what =
      fmt::format("{} of robot {} silent from {:.2f} s to ", silence.stream, silence.robot_id, silence.from_s());
  if (const auto to_s = silence.to_s())
    return what + fmt::format("{:.2f} s ({:.2f} s)", *to_s, *to_s - silence.from_s());
  return what + (silence.counts ? "the end" : "the end, as all of that robot");
}

std::string counted(std::int64_t orders, std::int64_t kicks) {
  return fmt::format("{} {}, {} of them {}", orders, orders == 1 ? "order" : "orders", kicks,
                     kicks == 1 ? "a kick" : "kicks");
}

std::string before(const UnrecordedOrders& o) {
  const std::string what = counted(o.orders_before, o.kicks_before);
  if (!o.continues) return fmt::format("robot {}: before this log began its driver had handled {}", o.robot_id, what);
  return fmt::format(
      "robot {}: between the session that this one continues and this one its driver handled {}{}: in no log{}",
      o.robot_id, o.restarted_before ? "at least " : "", what,
      o.restarted_before ? "; it was started again meanwhile" : "");
}

}  // namespace

std::optional<double> RecordedSilence::to_s() const {
  if (!to_t_ns) return std::nullopt;
  return kicking::seconds(*to_t_ns - started_t_ns);
}

std::vector<RecordedSilence> silences_of(const log::Reader& reader) {
  using S = RecordedSilence;
  return reader.rows<S>(kSilencesSql, &S::session_id, &S::stream, &S::robot_id, &S::from_t_ns, &S::to_t_ns,
                        &S::started_t_ns, &S::counts);
}

std::vector<UnrecordedOrders> unrecorded_orders_of(const log::Reader& reader) {
  using U = UnrecordedOrders;
  return reader.rows<U>(kUnrecordedOrdersSql, &U::session_id, &U::robot_id, &U::continues, &U::restarted_before,
                        &U::orders_before, &U::kicks_before, &U::orders_within, &U::kicks_within);
}

std::vector<std::string> silence_lines(const std::vector<RecordedSilence>& silences) {
  std::vector<std::string> lines;
  for (const RecordedSilence& silence : silences) {
    if (lines.size() == kMostLines) {
      lines.push_back(fmt::format("and {} more silences (JSON has them all)", silences.size() - kMostLines));
      break;
    }
    lines.push_back(sentence(silence));
  }
  return lines;
}

std::vector<std::string> order_lines(const std::vector<UnrecordedOrders>& orders) {
  std::vector<std::string> lines;
  for (const UnrecordedOrders& o : orders) {
    if (o.orders_before > 0 || o.kicks_before > 0 || o.restarted_before) lines.push_back(before(o));
    if (o.orders_within == 0 && o.kicks_within == 0) continue;
    lines.push_back(
        fmt::format("robot {}: while this log was recorded its driver handled {} that the log has no receipt of",
                    o.robot_id, counted(o.orders_within, o.kicks_within)));
  }
  return lines;
}

}  // namespace trivela::evaluator
