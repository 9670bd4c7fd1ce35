#include "evaluator/report/logged_pitch.hpp"

#include <charconv>
#include <map>
#include <string>

namespace trivela::evaluator {

LoggedPitch pitch_of(std::string_view config) {
  LoggedPitch pitch;
  const std::map<std::string, double*, std::less<>> keys{{"[goal]y_m", &pitch.goal.y_m},
                                                         {"[goal]half_width_m", &pitch.goal.half_width_m},
                                                         {"[goal]height_m", &pitch.goal.height_m},
                                                         {"[goal]post_width_m", &pitch.goal.post_width_m},
                                                         {"[field]side_line_x_m", &pitch.side_line_x_m}};
  std::string table;
  while (!config.empty()) {
    const std::string_view line = config.substr(0, config.find('\n'));
    config.remove_prefix(std::min(line.size() + 1, config.size()));
    if (line.starts_with("### ") && !line.starts_with("### settings")) break;  // robots, a scenario
    if (line.starts_with("[")) table = line;
    const auto sign = line.find(" = ");
    if (sign == std::string_view::npos) continue;
    const auto key = keys.find(table + std::string(line.substr(0, sign)));
    if (key == keys.end()) continue;
    const std::string_view value = line.substr(sign + 3);
    std::from_chars(value.data(), value.data() + value.size(), *key->second);
  }
  return pitch;
}

}  // namespace trivela::evaluator
