#include "cli/launch/match_run.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <stdexcept>
#include <vector>

#include "cli/launch/child_process.hpp"
#include "cli/launch/progress_bar.hpp"

namespace trivela::cli {
namespace {

constexpr std::array kNodes{"recorder", "odometry", "world_state", "kick_decision", "kicker_driver", "shot_observer"};
constexpr std::chrono::seconds kPatience{10};

/// The feeder's "t_s total_s" lines; the last one says "end".
class ProgressPipe {
 public:
  ProgressPipe() {
    if (pipe2(ends_.data(), O_CLOEXEC) != 0)
      throw std::runtime_error{fmt::format("no pipe for the progress: {}", std::strerror(errno))};
    fcntl(ends_[0], F_SETFL, O_NONBLOCK);
  }
  ProgressPipe(const ProgressPipe&) = delete;
  ProgressPipe& operator=(const ProgressPipe&) = delete;
  ~ProgressPipe() {
    close(ends_[0]);
    close_write_end();
  }
  int read_end() const { return ends_[0]; }
  int write_end() const { return ends_[1]; }
  void close_write_end() {
    if (ends_[1] >= 0) close(ends_[1]);
    ends_[1] = -1;
  }

  /// Takes what has come; true at the end of the stream.
  bool take(double& played_s, double& total_s) {
    std::array<char, 4096> chunk{};
    ssize_t n = 0;
    while ((n = read(ends_[0], chunk.data(), chunk.size())) > 0)
      text_.append(chunk.data(), static_cast<std::size_t>(n));
    for (auto end = text_.find('\n'); end != std::string::npos; end = text_.find('\n')) {
      char* rest = nullptr;
      played_s = std::strtod(text_.c_str(), &rest);
      total_s = std::strtod(rest, &rest);
      whole_ = whole_ || std::strncmp(rest, " end", 4) == 0;
      text_.erase(0, end + 1);
    }
    return n == 0;
  }

  /// Whether the feeder has said that all was played.
  bool whole() const { return whole_; }

 private:
  std::array<int, 2> ends_{-1, -1};
  std::string text_;
  bool whole_ = false;
};

/// Where nobody reads.
class Nowhere {
 public:
  Nowhere() : descriptor_(open("/dev/null", O_WRONLY | O_CLOEXEC)) {
    if (descriptor_ < 0) throw std::runtime_error{fmt::format("cannot open /dev/null: {}", std::strerror(errno))};
  }
  Nowhere(const Nowhere&) = delete;
  Nowhere& operator=(const Nowhere&) = delete;
  ~Nowhere() { close(descriptor_); }
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

/// The end of a node before the match is over, as a sentence; empty if all run.
std::string casualty(std::deque<ChildProcess>& children) {
  for (ChildProcess& child : children) {
    if (child.ended()) return fmt::format("{} died ({})", child.name(), child.how_it_ended());
  }
  return {};
}

void stop_all(std::deque<ChildProcess>& children, std::string& trouble) {
  const auto complain = [&](const std::string& sentence) { trouble += (trouble.empty() ? "" : "; ") + sentence; };
  std::vector<bool> ran;
  ran.reserve(children.size());
  for (ChildProcess& child : children) ran.push_back(!child.ended());
  // Each is asked once, since a second signal would hit one that has stopped listening. The recorder is first in the
  // list and stops last: it hears what the others say on their way out.
  for (std::size_t i = 1; i < children.size(); ++i) children[i].terminate();
  for (; !children.empty(); children.pop_back()) {
    ChildProcess& last = children.back();
    if (children.size() == 1) last.terminate();
    if (!last.wait(kPatience)) {
      complain(fmt::format("{} did not stop within 10 s", last.name()));
    } else if (ran[children.size() - 1] && !last.succeeded()) {
      complain(fmt::format("{} failed on stopping ({})", last.name(), last.how_it_ended()));
    }
  }
}

}  // namespace

MatchResult run_match(const std::string& feeder, const std::filesystem::path& config_file, SignalInbox& signals,
                      const std::vector<std::string>& more_nodes, bool quiet) {
  const std::filesystem::path programs = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  MatchResult result;
  ProgressPipe progress;
  std::deque<ChildProcess> children;
  const auto started = std::chrono::steady_clock::now();
  const std::vector<std::string> arguments{"--config", config_file.string()};
  std::vector<std::string> nodes{kNodes.begin(), kNodes.end()};
  nodes.insert(nodes.end(), more_nodes.begin(), more_nodes.end());
  const Nowhere nowhere;
  for (const std::string& node : nodes) {
    children.emplace_back(node, programs / ("trivela-" + node), arguments, quiet ? nowhere.descriptor() : -1);
  }
  children.emplace_back(feeder, programs / ("trivela-" + feeder), arguments, progress.write_end());
  progress.close_write_end();
  ProgressBar bar;
  double total_s = 0.0;
  for (;;) {
    std::array<pollfd, 2> sources{pollfd{progress.read_end(), POLLIN, 0}, pollfd{signals.file_descriptor(), POLLIN, 0}};
    poll(sources.data(), sources.size(), 1000);
    const bool over = progress.take(result.played_s, total_s);
    bar.show(result.played_s, total_s, fmt::format("{:.0f} s played", result.played_s));
    if (signals.stop_requested()) {
      result.trouble = "interrupted";
      break;
    }
    if (over && children.back().wait(kPatience) && children.back().succeeded()) {
      children.pop_back();
      if (!progress.whole()) result.trouble = fmt::format("{} was stopped before the end", feeder);
      break;
    }
    if (result.trouble = casualty(children); !result.trouble.empty()) break;
  }
  result.wall_s = std::chrono::duration<double>{std::chrono::steady_clock::now() - started}.count();
  stop_all(children, result.trouble);
  return result;
}

}  // namespace trivela::cli
