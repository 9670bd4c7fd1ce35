#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>

namespace trivela::pages {

/// Something that a person should look after.
struct Alarm {
  std::string text;
  std::int64_t since_ns = 0;
};

/// One that is mended.
struct MendedAlarm {
  std::string text;
  std::int64_t from_ns = 0;
  std::int64_t to_ns = 0;
};

/// Keeps since when each alarm holds, and the last ones that no longer do.
class ActiveAlarms {
 public:
  static constexpr std::size_t kMostMended = 5;

  /// `now`: the text of each alarm that holds at this moment, by a name that stays the same while it does.
  void update(const std::map<std::string, std::string>& now, std::int64_t now_ns);

  const std::map<std::string, Alarm>& alarms() const { return alarms_; }
  const std::deque<MendedAlarm>& mended() const { return mended_; }  ///< the newest first

 private:
  std::map<std::string, Alarm> alarms_;
  std::deque<MendedAlarm> mended_;
};

}  // namespace trivela::pages
