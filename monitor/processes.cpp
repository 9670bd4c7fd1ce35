#include "monitor/processes.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <sstream>

namespace trivela::monitor {
namespace {

std::string text_of(const std::string& path) {
  std::ifstream in{path};
  return {std::istreambuf_iterator<char>{in}, {}};
}

}  // namespace

std::optional<ProcessReading> parse_process(std::string_view stat, std::string_view statm, double ticks_per_s,
                                            std::int64_t page_bytes) {
  // The name stands in parentheses and may have any characters, parentheses too.
  const auto end_of_name = stat.rfind(')');
  if (end_of_name == std::string_view::npos) return std::nullopt;
  std::istringstream fields{std::string{stat.substr(end_of_name + 1)}};
  std::string state;
  fields >> state;
  if (state == "Z" || state == "X") return std::nullopt;
  constexpr int kBetweenStateAndTimes = 10;  // proc(5): state is field 3, utime 14, stime 15
  std::string passed_over;
  for (int i = 0; i < kBetweenStateAndTimes; ++i) fields >> passed_over;
  double user_ticks = 0.0, system_ticks = 0.0;
  fields >> user_ticks >> system_ticks;
  std::istringstream pages{std::string{statm}};
  std::int64_t size = 0, resident = 0;
  pages >> size >> resident;
  if (!fields || !pages) return std::nullopt;
  return ProcessReading{resident * page_bytes, (user_ticks + system_ticks) / ticks_per_s};
}

std::optional<ProcessReading> read_process(std::int64_t pid) {
  if (pid <= 0) return std::nullopt;
  return parse_process(text_of(fmt::format("/proc/{}/stat", pid)), text_of(fmt::format("/proc/{}/statm", pid)),
                       static_cast<double>(sysconf(_SC_CLK_TCK)), sysconf(_SC_PAGESIZE));
}

std::optional<ProcessLoad> ProcessLoads::look(std::int64_t pid, const std::optional<ProcessReading>& reading,
                                              Clock::time_point now) {
  if (!reading) {
    before_.erase(pid);
    return std::nullopt;
  }
  ProcessLoad load{reading->memory_bytes, std::nullopt};
  const auto before = before_.find(pid);
  if (before != before_.end() && now > before->second.at && reading->cpu_s >= before->second.cpu_s) {
    const double passed_s = std::chrono::duration<double>(now - before->second.at).count();
    load.cpu_percent = 100.0 * (reading->cpu_s - before->second.cpu_s) / passed_s;
  }
  before_[pid] = {reading->cpu_s, now};
  return load;
}

}  // namespace trivela::monitor
