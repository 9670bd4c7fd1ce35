#include "pages/monitor/active_alarms.hpp"

namespace trivela::pages {

void ActiveAlarms::update(const std::map<std::string, std::string>& now, std::int64_t now_ns) {
  for (auto alarm = alarms_.begin(); alarm != alarms_.end();) {
    if (now.contains(alarm->first)) {
      ++alarm;
      continue;
    }
    mended_.push_front({alarm->second.text, alarm->second.since_ns, now_ns});
    if (mended_.size() > kMostMended) mended_.pop_back();
    alarm = alarms_.erase(alarm);
  }
  for (const auto& [name, text] : now) {
    Alarm& alarm = alarms_.try_emplace(name, Alarm{text, now_ns}).first->second;
    alarm.text = text;
  }
}

}  // namespace trivela::pages
