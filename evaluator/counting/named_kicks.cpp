#include "evaluator/counting/named_kicks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <stdexcept>

#include "kicking/geometry/time.hpp"
#include "kicking/text/printable.hpp"

namespace trivela::evaluator {
namespace {

constexpr std::int64_t kFirstKickId = std::int64_t{1} << 40;  // below it is the robot's counter alone
constexpr std::size_t kMostNamed = 4;

std::optional<std::int64_t> whole(std::string_view text) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || text.empty() || number < 0) return std::nullopt;
  return number;
}

/// What a name asks for; none: it is no name of a kick.
struct Wanted {
  std::optional<std::int64_t> robot_id, number, kick_id;

  bool is(const NamedKick& kick) const {
    return (!robot_id || *robot_id == kick.robot_id) && (!number || *number == kick.number) &&
           (!kick_id || *kick_id == kick.kick_id);
  }
};

std::optional<Wanted> wanted(std::string_view name) {
  if (const auto colon = name.find(':'); colon != std::string_view::npos) {
    const auto robot_id = whole(name.substr(0, colon)), number = whole(name.substr(colon + 1));
    if (!robot_id || !number) return std::nullopt;
    return Wanted{robot_id, number, std::nullopt};
  }
  const auto number = whole(name);
  if (!number) return std::nullopt;
  if (*number >= kFirstKickId) return Wanted{std::nullopt, std::nullopt, number};
  return Wanted{std::nullopt, number, std::nullopt};
}

std::string place(const NamedKick& kick) {
  return fmt::format("{} at {:.2f} s of session {}", kick.name(), kick.at_s, kicking::printable(kick.uuid));
}

bool same(const NamedKick& a, const NamedKick& b) {
  return a.robot_id == b.robot_id && a.kick_id == b.kick_id && a.t_ns == b.t_ns;
}

}  // namespace

std::string NamedKick::name() const { return fmt::format("{}:{}", robot_id, number); }

std::vector<NamedKick> named_kicks(const log::Reader& reader) {
  std::vector<NamedKick> kicks;
  reader.query(
      "SELECT k.session_id, s.uuid, k.robot_id, k.kick_id, k.kick_id & 0xffffffffff AS number, k.t_ns, "
      "k.t_ns - s.started_t_ns AS after_ns, k.policy, coalesce(k.observed, '') AS observed, h.label, h.who "
      "FROM counted_kicks AS k JOIN sessions AS s ON s.session_id = k.session_id LEFT JOIN hand_labels AS h ON "
      "h.session_id = k.session_id AND h.robot_id = k.robot_id AND h.kick_id = k.kick_id WHERE k.accepted IS NOT 0 "
      "ORDER BY s.started_t_ns, k.session_id, k.t_ns, k.robot_id",
      [&](const log::NamedCells& row) {
        kicks.push_back({row.get<std::int64_t>("session_id"), row.get<std::string>("uuid"), row.get<int>("robot_id"),
                         row.get<std::int64_t>("kick_id"), row.get<std::int64_t>("number"),
                         row.get<std::int64_t>("t_ns"), kicking::seconds(row.get<std::int64_t>("after_ns")),
                         row.get<std::string>("policy"), row.get<std::string>("observed"),
                         row.find<std::string>("label"), row.find<std::string>("who")});
      });
  return kicks;
}

const NamedKick& kick_called(const std::vector<NamedKick>& kicks, const std::string& name, const std::string& session) {
  const auto what = wanted(name);
  const std::string shown = kicking::printable(name);
  if (!what)
    throw std::runtime_error(
        fmt::format("'{}' is no kick: say ROBOT:NUMBER, such as 1:4, its number alone or its kick_id", shown));
  std::vector<const NamedKick*> found;
  std::vector<std::string> places;
  for (const NamedKick& kick : kicks) {
    if (!what->is(kick) || !kick.uuid.starts_with(session)) continue;
    if (!found.empty() && same(*found.front(), kick)) continue;
    found.push_back(&kick);
    if (places.size() < kMostNamed) places.push_back(place(kick));
  }
  if (found.empty()) {
    if (kicks.empty()) throw std::runtime_error("the log has no kicks");
    throw std::runtime_error(fmt::format("there is no kick {}{}; the first of {} is {}, the last {}", shown,
                                         session.empty() ? "" : " in a session " + kicking::printable(session),
                                         kicks.size(), place(kicks.front()), place(kicks.back())));
  }
  if (found.size() == 1) return *found.front();
  throw std::runtime_error(fmt::format("kick {} may be one of {}: {}{}; say robot and number, --session or the kick_id",
                                       shown, found.size(), fmt::join(places, ", "),
                                       found.size() > places.size() ? " ..." : ""));
}

}  // namespace trivela::evaluator
