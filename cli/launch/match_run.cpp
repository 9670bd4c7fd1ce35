#include "cli/launch/match_run.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <stdexcept>
#include <utility>

#include "cli/launch/child_process.hpp"
#include "cli/launch/progress_bar.hpp"

namespace trivela::cli {

ProgressPipe::ProgressPipe() {
  if (pipe2(ends_.data(), O_CLOEXEC) != 0)
    throw std::runtime_error{fmt::format("no pipe for the progress: {}", std::strerror(errno))};
  fcntl(ends_[0], F_SETFL, O_NONBLOCK);
}

ProgressPipe::~ProgressPipe() {
  close(ends_[0]);
  close_write_end();
}

void ProgressPipe::close_write_end() {
  if (ends_[1] >= 0) close(ends_[1]);
  ends_[1] = -1;
}

bool ProgressPipe::take() {
  std::array<char, 4096> chunk{};
  ssize_t n = 0;
  while ((n = read(ends_[0], chunk.data(), chunk.size())) > 0) text_.append(chunk.data(), static_cast<std::size_t>(n));
  for (auto end = text_.find('\n'); end != std::string::npos; end = text_.find('\n')) {
    take_line(text_.substr(0, end));
    text_.erase(0, end + 1);
  }
  return n == 0;
}

void ProgressPipe::take_line(const std::string& line) {
  if (line.find('=') != std::string::npos) {
    if (!begun_) settings_.push_back(line);
    return;
  }
  char* rest = nullptr;
  played_s_ = std::strtod(line.c_str(), &rest);
  total_s_ = std::strtod(rest, &rest);
  begun_ = true;
  whole_ = whole_ || std::strncmp(rest, " end", 4) == 0;
}

namespace {

constexpr std::chrono::seconds kFeederTimeout{10};

/// Waits for news of the feeder and of signals, and takes the feeder's.
struct Watch {
  ProgressPipe& progress;
  SignalInbox& signals;
  ProgressBar bar{};

  /// True at the end of what the feeder says.
  bool next() {
    std::array<pollfd, 2> sources{pollfd{progress.read_end(), POLLIN, 0}, pollfd{signals.file_descriptor(), POLLIN, 0}};
    poll(sources.data(), sources.size(), 1000);
    const bool over = progress.take();
    bar.show(progress.played_s(), progress.total_s(), "s of play", fmt::format("{:.0f} s played", progress.played_s()));
    return over;
  }
};

using WallClock = std::chrono::steady_clock;

/// Ends all processes and says how it went.
MatchResult end_match(std::deque<ChildProcess>& children, std::size_t last, std::string trouble, double played_s,
                      WallClock::time_point started) {
  MatchResult result{.played_s = played_s,
                     .wall_s = std::chrono::duration<double>{WallClock::now() - started}.count(),
                     .trouble = std::move(trouble)};
  for (const std::string& sentence : stop_all(children, last))
    result.trouble += (result.trouble.empty() ? "" : "; ") + sentence;
  return result;
}

}  // namespace

MatchResult run_match(const std::string& feeder, const std::filesystem::path& config_file, SignalInbox& signals,
                      const std::vector<std::string>& nodes, bool quiet) {
  ProgressPipe progress;
  std::deque<ChildProcess> children;
  const auto started = WallClock::now();
  for (const std::string& node : nodes)
    children.push_back(start_node(node, config_file, quiet ? ChildProcess::kNobody : ChildProcess::kOurs));
  children.push_back(start_node(feeder, config_file, progress.write_end()));
  progress.close_write_end();
  std::string trouble;
  for (Watch watch{progress, signals};;) {
    const bool over = watch.next();
    if (signals.stop_requested()) {
      trouble = "interrupted";
      break;
    }
    if (over && children.back().wait(kFeederTimeout) && children.back().succeeded()) {
      children.pop_back();
      if (!progress.whole()) trouble = fmt::format("{} was stopped before the end", feeder);
      break;
    }
    if (trouble = dead_node(children); !trouble.empty()) break;
  }
  return end_match(children, 1, std::move(trouble), progress.played_s(), started);
}

MatchResult run_emulated_match(const std::filesystem::path& world_config, const NodesConfig& nodes_config,
                               SignalInbox& signals, const std::vector<std::string>& nodes) {
  ProgressPipe progress;
  std::deque<ChildProcess> children;
  const auto started = WallClock::now();
  children.push_back(start_node("simulator", world_config, progress.write_end()));
  progress.close_write_end();
  std::string trouble;
  Watch watch{progress, signals};
  while (trouble.empty() && !progress.begun()) {
    watch.next();
    trouble = signals.stop_requested() ? "interrupted" : dead_node(children);
  }
  if (progress.begun() && trouble.empty()) {
    const std::filesystem::path config_file = nodes_config(progress.settings());
    children.push_front(start_node(nodes.front(), config_file));  // the recorder, before the simulator
    for (std::size_t i = 1; i < nodes.size(); ++i) children.push_back(start_node(nodes[i], config_file));
  }
  while (trouble.empty() && !progress.whole()) {
    watch.next();
    trouble = signals.stop_requested() ? "interrupted" : dead_node(children);
  }
  return end_match(children, 2, std::move(trouble), progress.played_s(), started);
}

}  // namespace trivela::cli
