#include "tests/faults/node_process.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sched.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace trivela::faults {
namespace {

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> out;
  for (std::string& text : texts) out.push_back(text.data());
  out.push_back(nullptr);
  return out;
}

std::vector<std::string> environment_of(const ProcessPlan& plan) {
  std::vector<std::string> out;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text{*entry};
    if (!plan.environment.contains(text.substr(0, text.find('=')))) out.push_back(text);
  }
  for (const auto& [key, value] : plan.environment) out.push_back(fmt::format("{}={}", key, value));
  return out;
}

/// "monotonic SECONDS NANOSECONDS", as /proc/self/timens_offsets takes it.
std::string clock_offset_of(const ProcessPlan& plan) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  const std::int64_t seconds = plan.clock_ahead_ns / kSecond - (plan.clock_ahead_ns % kSecond < 0 ? 1 : 0);
  return plan.clock_ahead_ns == 0 ? ""
                                  : fmt::format("monotonic {} {}\n", seconds, plan.clock_ahead_ns - seconds * kSecond);
}

/// The clock of what is executed next, since Linux 6.1.
bool set_clock(const std::string& offset) {
  constexpr int kNewTime = 0x80;  // CLONE_NEWTIME
  if (unshare(kNewTime) != 0) return false;
  const int file = open("/proc/self/timens_offsets", O_WRONLY | O_CLOEXEC);
  return file >= 0 && write(file, offset.data(), offset.size()) == static_cast<ssize_t>(offset.size());
}

/// What is done between fork and exec, where other threads may have held any lock: system calls alone.
[[noreturn]] void become(const ProcessPlan& plan, const std::string& clock, char* const* arguments,
                         char* const* environment, pid_t launcher) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != launcher) _exit(1);  // it died before the line above
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  if (!clock.empty() && !set_clock(clock)) _exit(125);
  if (plan.network >= 0 && setns(plan.network, CLONE_NEWNET) != 0) _exit(126);
  const int says = open(plan.says.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  dup2(open("/dev/null", O_RDONLY | O_CLOEXEC), STDIN_FILENO);
  dup2(plan.output >= 0 ? plan.output : says, STDOUT_FILENO);
  dup2(says, STDERR_FILENO);
  execve(plan.program.c_str(), arguments, environment);
  _exit(127);
}

}  // namespace

NodeProcess::NodeProcess(const ProcessPlan& plan) {
  if (access(plan.program.c_str(), X_OK) != 0)
    throw std::runtime_error{fmt::format("cannot start {}: {}", plan.program.string(), std::strerror(errno))};
  std::vector<std::string> arguments{plan.program.string()};
  arguments.insert(arguments.end(), plan.arguments.begin(), plan.arguments.end());
  std::vector<std::string> environment = environment_of(plan);
  const std::vector<char*> argv = pointers(arguments), envp = pointers(environment);
  const pid_t launcher = getpid();
  const std::string clock = clock_offset_of(plan);
  pid_ = fork();
  if (pid_ < 0)
    throw std::runtime_error{fmt::format("cannot start {}: {}", plan.program.string(), std::strerror(errno))};
  if (pid_ == 0) become(plan, clock, argv.data(), envp.data(), launcher);
  pid_fd_ = static_cast<int>(syscall(SYS_pidfd_open, pid_, 0));
}

NodeProcess::~NodeProcess() {
  if (!ended()) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  if (pid_fd_ >= 0) close(pid_fd_);
}

void NodeProcess::signal(int number) const {
  if (!status_) kill(pid_, number);
}

void NodeProcess::tell(int value) const {
  if (!status_) sigqueue(pid_, SIGRTMIN, sigval{.sival_int = value});
}

bool NodeProcess::ended() {
  int status = 0;
  if (!status_ && waitpid(pid_, &status, WNOHANG) == pid_) status_ = status;
  return status_.has_value();
}

std::optional<int> NodeProcess::code() {
  if (!ended()) return std::nullopt;
  return WIFSIGNALED(*status_) ? 128 + WTERMSIG(*status_) : WEXITSTATUS(*status_);
}

}  // namespace trivela::faults
