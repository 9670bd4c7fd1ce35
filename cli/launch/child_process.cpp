#include "cli/launch/child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>

#include <cstdlib>
#include <set>
#include <sstream>

namespace trivela::cli {
namespace {

constexpr std::chrono::seconds kGrace{5};

[[noreturn]] void become(const std::filesystem::path& program, const std::vector<std::string>& arguments, int output,
                         pid_t launcher) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != launcher) _exit(1);  // it died before the line above
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  if (output == ChildProcess::kNobody && (output = open("/dev/null", O_WRONLY | O_CLOEXEC)) < 0) _exit(127);
  if (output >= 0) dup2(output, STDOUT_FILENO);
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  execv(program.c_str(), argv.data());
  _exit(127);
}

namespace fs = std::filesystem;

std::set<std::string, std::less<>>& played_by_this_program() {
  static std::set<std::string, std::less<>> nodes;
  return nodes;
}

/// What is started as a node.
struct NodeProgram {
  fs::path program;
  std::vector<std::string> arguments;  // before those of the node
};

NodeProgram node_program(const std::string& node) {
  const fs::path self = fs::read_symlink("/proc/self/exe");
  if (played_by_this_program().contains(node)) return {self, {node}};
  const std::string name = "trivela-" + node;
  const fs::path beside = self.parent_path() / name;
  const char* const path = std::getenv("PATH");
  if (fs::exists(beside) || path == nullptr) return {beside, {}};
  std::istringstream folders{path};
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path found = fs::path{folder} / name;
    if (found.is_absolute() && access(found.c_str(), X_OK) == 0) return {found, {}};
  }
  return {beside, {}};
}

}  // namespace

ChildProcess::ChildProcess(std::string name, const std::filesystem::path& program,
                           const std::vector<std::string>& arguments, int output)
    : name_(std::move(name)) {
  if (access(program.c_str(), X_OK) != 0) {
    throw std::runtime_error{fmt::format("cannot start {}: {}: {}", name_, program.string(), std::strerror(errno))};
  }
  const pid_t launcher = getpid();
  pid_ = fork();
  if (pid_ < 0) throw std::runtime_error{fmt::format("cannot start {}: {}", name_, std::strerror(errno))};
  if (pid_ == 0) become(program, arguments, output, launcher);
  pid_fd_ = static_cast<int>(syscall(SYS_pidfd_open, pid_, 0));
  if (pid_fd_ >= 0) return;
  const int reason = errno;
  kill(pid_, SIGKILL);
  waitpid(pid_, nullptr, 0);
  throw std::runtime_error{fmt::format("cannot start {}: {}", name_, std::strerror(reason))};
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : name_(std::move(other.name_)), pid_(other.pid_), pid_fd_(other.pid_fd_), status_(other.status_) {
  other.pid_ = other.pid_fd_ = -1;
}

ChildProcess::~ChildProcess() {
  if (pid_ > 0 && !ended()) {
    terminate();
    if (!wait(kGrace)) {
      kill(pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
    }
  }
  if (pid_fd_ >= 0) close(pid_fd_);
}

bool ChildProcess::ended() {
  int status = 0;
  if (!status_ && waitpid(pid_, &status, WNOHANG) == pid_) status_ = status;
  return status_.has_value();
}

std::string ChildProcess::how_it_ended() const {
  if (!status_) return "still running";
  if (WIFSIGNALED(*status_)) return fmt::format("signal {} ({})", WTERMSIG(*status_), strsignal(WTERMSIG(*status_)));
  return fmt::format("exit code {}", WEXITSTATUS(*status_));
}

void ChildProcess::terminate() const {
  if (!status_) kill(pid_, SIGTERM);
}

bool ChildProcess::wait(std::chrono::milliseconds timeout) {
  pollfd handle{pid_fd_, POLLIN, 0};
  if (!ended()) poll(&handle, 1, static_cast<int>(timeout.count()));
  return ended();
}

ChildProcess start_node(const std::string& node, const std::filesystem::path& config_file, int output) {
  NodeProgram started = node_program(node);
  started.arguments.insert(started.arguments.end(), {"--config", config_file.string()});
  return {node, started.program, started.arguments, output};
}

std::string dead_node(std::deque<ChildProcess>& nodes) {
  for (ChildProcess& node : nodes) {
    if (node.ended()) return fmt::format("{} died ({})", node.name(), node.how_it_ended());
  }
  return {};
}

std::vector<std::string> stop_all(std::deque<ChildProcess>& nodes, std::size_t last) {
  constexpr std::chrono::seconds kTimeout{10};
  std::vector<std::string> trouble;
  std::vector<bool> ran;
  ran.reserve(nodes.size());
  for (ChildProcess& node : nodes) ran.push_back(!node.ended());
  for (std::size_t i = last; i < nodes.size(); ++i) nodes[i].terminate();
  for (; !nodes.empty(); nodes.pop_back()) {
    ChildProcess& node = nodes.back();
    if (nodes.size() <= last) node.terminate();
    if (!node.wait(kTimeout)) {
      trouble.push_back(fmt::format("{} did not stop within 10 s", node.name()));
    } else if (ran[nodes.size() - 1] && !node.stopped()) {
      trouble.push_back(fmt::format("{} failed on stopping ({})", node.name(), node.how_it_ended()));
    }
  }
  return trouble;
}

void play_by_this_program(std::string_view node) { played_by_this_program().emplace(node); }

}  // namespace trivela::cli
