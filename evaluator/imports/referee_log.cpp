#include "evaluator/imports/referee_log.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <deque>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "kicking/text/bounded_text.hpp"

namespace trivela::evaluator::imports {
namespace {

using Text = std::string_view;

constexpr std::int64_t kLatest_ms = 4'102'444'800'000;  // 2100: beyond it is no UTC in milliseconds

template <class T>
bool take_number(Text& text, T& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || number < 0) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

bool take(Text& text, char c) {
  if (!text.starts_with(c)) return false;
  text.remove_prefix(1);
  return true;
}

/// "06:53" is minutes and seconds; minutes may be more than 59.
bool take_clock(Text& text, std::int64_t& ms) {
  int minutes = 0, seconds = 0;
  if (!take_number(text, minutes) || !take(text, ':') || !take_number(text, seconds) || seconds > 59) return false;
  ms = (minutes * std::int64_t{60} + seconds) * 1000;
  return true;
}

/// Which side a team has: by its network "172.16.N" or "224.16.32.N", as lines such as "Connection from 172.16.74.27
/// accepted - Magenta" tell it, or by its name, which the box welcomes in the order of the connections. The box's left
/// team is cyan, its right one magenta.
class SidesOfTeams {
 public:
  void accepted(Text line) {
    const bool magenta = line.ends_with("Magenta") || line.ends_with("Right");
    const BoxSide side = magenta ? BoxSide::kMagenta : BoxSide::kCyan;
    if (const auto group = number_behind(line, "172.16.")) sides_[*group] = side;
    unwelcomed_.push_back(side);
  }
  BoxSide of(Text team) const {
    const auto group = number_behind(team, "224.16.32.");
    const auto known = group ? sides_.find(*group) : sides_.end();
    return known == sides_.end() ? BoxSide::kBoth : known->second;
  }
  /// A name that no connection explains is of the side that the other name has not, the first one of the left.
  BoxSide of_name(Text name, bool welcomed) {
    if (name.empty()) return BoxSide::kBoth;
    const auto known = names_.find(std::string(name));
    if (known != names_.end() && !welcomed) return known->second;
    BoxSide side = known != names_.end() ? known->second : free_side();
    if (welcomed && !unwelcomed_.empty()) {
      side = unwelcomed_.front();
      unwelcomed_.pop_front();
    }
    return names_[std::string(name)] = side;
  }

 private:
  BoxSide free_side() const {
    const auto has_cyan = [](const auto& name) { return name.second == BoxSide::kCyan; };
    return std::ranges::any_of(names_, has_cyan) ? BoxSide::kMagenta : BoxSide::kCyan;
  }
  static std::optional<int> number_behind(Text text, Text prefix) {
    const auto place = text.find(prefix);
    if (place == Text::npos) return std::nullopt;
    text.remove_prefix(place + prefix.size());
    int number = 0;
    return take_number(text, number) ? std::optional(number) : std::nullopt;
  }

  std::map<int, BoxSide> sides_;
  std::map<std::string, BoxSide> names_;
  std::deque<BoxSide> unwelcomed_;
};

/// The box's clock against its own game time: each line has both. One that was set during the match is put right.
class BoxClock {
 public:
  /// By how much the clock was set between the line before and this one [ms]. None: it was not.
  std::optional<std::int64_t> set_before(const RefereeLine& line) {
    const std::optional<RefereeLine> before = std::exchange(last_, line);
    if (!before) return std::nullopt;
    const std::int64_t by_clock_ms = line.t_ms - before->t_ms, by_game_ms = line.game_ms - before->game_ms;
    const bool same_part = by_game_ms >= 0;  // the game time starts over with each part
    // To a whole second, as the game time is known.
    const std::int64_t off_ms =
        1000 * std::llround(1e-3 * static_cast<double>(by_clock_ms - (same_part ? by_game_ms : 0)));
    const bool runs = same_part && by_game_ms > 0;
    const bool is_set = off_ms < -kTolerance_ms || (runs && off_ms > kTolerance_ms);
    if (!is_set) return std::nullopt;
    offset_ms_ += off_ms;
    return off_ms;
  }
  /// UTC as if nobody had set the clock [ms].
  std::int64_t right_ms(std::int64_t t_ms) const { return t_ms - offset_ms_; }

 private:
  static constexpr std::int64_t kTolerance_ms = 3000;  // the game time has whole seconds, and stops within none

  std::optional<RefereeLine> last_;
  std::int64_t offset_ms_ = 0;
};

class RefereeLogReading {
 public:
  explicit RefereeLogReading(const std::string& file) : log_{.file = file, .lines = {}, .faults = {file, "line"}} {}

  void read(Text text, std::int64_t line) {
    if (text.empty() || note_connection(text)) return;
    RefereeLine read{.line = line};
    Text rest = text;
    if (!take_number(rest, read.t_ms) || !take(rest, ',') || !take_clock(rest, read.game_ms) || !take(rest, '(') ||
        !take_clock(rest, read.run_ms) || !take(rest, ')') || !take(rest, ',') || read.t_ms > kLatest_ms)
      return log_.faults.note("line of another form", line, "line", text);
    const auto comma = rest.find(',');
    if (comma == Text::npos) return log_.faults.note("line breaks off", line, "line", text);
    read.state = rest.substr(0, comma);
    rest.remove_prefix(comma + 1);
    const auto end = rest.starts_with('{') ? std::min(rest.rfind('}'), rest.size() - 1) + 1 : rest.find(',');
    if (end == Text::npos) return log_.faults.note("line breaks off", line, "line", text);
    read.text = rest.substr(std::min(end + 1, rest.size()));
    const auto word = word_of(rest.substr(0, end), read.text, line);
    if (!word) return;
    read.command = word->command;
    read.side = word->side;
    add(std::move(read));
  }

  RefereeLog finish() && {
    if (log_.lines.empty()) log_.faults.note("no command in it", 0);
    return std::move(log_);
  }

 private:
  bool note_connection(Text text) {
    if (text.starts_with("New BaseStation @ ")) return true;
    if (text.starts_with("Connection from ")) {
      ++log_.accepted;
      sides_.accepted(text);
      return true;
    }
    if (text.starts_with("Team ") && text.ends_with(" dropped")) {
      ++log_.dropped;
      return true;
    }
    if (!text.starts_with("ERR ")) return false;
    ++log_.refused;
    return true;
  }

  /// `behind`: of a box before 2020 its own words, else the team's name, with "robotID:N," before it where it is of
  /// one.
  std::optional<SidedCommand> word_of(Text code, Text behind, std::int64_t line) {
    if (code.starts_with('{')) return word_of_json(code, line);
    std::optional<SidedCommand> word;
    if (code.size() == 1) {
      if (const auto letter = refbox::word_of_letter(code.front()))
        word = SidedCommand{letter->kind, side_of(letter->team)};
    }
    if (const auto command = refbox::kind_of(code)) {
      const Text name = refbox::name(*command) == code ? Text{} : behind.substr(behind.rfind(',') + 1);
      word = SidedCommand{*command, sides_.of_name(name, *command == BoxCommand::kWelcome)};
    }
    if (!word) log_.faults.note("unknown command", line, "code", code);
    return word;
  }

  std::optional<SidedCommand> word_of_json(Text code, std::int64_t line) {
    const auto json = nlohmann::json::parse(code, nullptr, false);
    const auto text_of = [&](const char* key) {
      const auto value = json.is_object() ? json.find(key) : json.end();
      return value != json.end() && value->is_string() ? value->get<std::string>() : std::string();
    };
    if (!json.is_object()) {
      log_.faults.note("command is not JSON", line, "code", code);
      return std::nullopt;
    }
    const auto command = refbox::kind_of(text_of("command"));
    if (command) return SidedCommand{*command, sides_.of(text_of("targetTeam"))};
    log_.faults.note(json.contains("command") ? "unknown command" : "object without command", line, "code", code);
    return std::nullopt;
  }

  void add(RefereeLine read) {
    if (const auto set_ms = clock_.set_before(read)) log_.faults.note("clock set", read.line, "s", *set_ms / 1000);
    read.t_ms = clock_.right_ms(read.t_ms);
    if (!log_.lines.empty() && read.t_ms < log_.lines.back().t_ms) {
      log_.faults.note("time goes back", read.line, "ms", read.t_ms);
      read.t_ms = log_.lines.back().t_ms;
    }
    log_.lines.push_back(std::move(read));
  }

  RefereeLog log_;
  SidesOfTeams sides_;
  BoxClock clock_;
};

}  // namespace

RefereeLog read_referee_log(std::istream& in, const std::string& file) {
  RefereeLogReading reading(file);
  std::size_t line = 0;
  for (std::string text; kicking::get_line(in, text, file, line + 1);) {
    if (line == 0 && text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);  // a byte order mark
    if (text.ends_with('\r')) text.pop_back();
    reading.read(text, static_cast<std::int64_t>(++line));
  }
  return std::move(reading).finish();
}

}  // namespace trivela::evaluator::imports
