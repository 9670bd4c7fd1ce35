#include "tests/e2e/program.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <sys/inotify.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace trivela::e2e {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

int left_ms(Clock::time_point deadline) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
  return static_cast<int>(std::max<std::int64_t>(left.count(), 0));
}

// A file of its own, also for two programs of one name that are started at once.
fs::path fresh(const fs::path& folder, const std::string& name, const char* suffix) {
  for (int n = 0;; ++n) {
    const fs::path path = folder / fmt::format("{}.{}.{}", name, n, suffix);
    const int made = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
    if (made < 0 && errno == EEXIST) continue;
    if (made < 0) throw std::runtime_error{fmt::format("cannot make {}: {}", path.string(), std::strerror(errno))};
    close(made);
    return path;
  }
}

[[noreturn]] void become(const std::string& program, const std::vector<std::string>& arguments, const fs::path& folder,
                         const fs::path& output, const fs::path& errors, const std::function<void()>& prepare) {
  setenv("TMPDIR", folder.c_str(), 1);
  if (chdir(folder.c_str()) != 0) _exit(126);
  dup2(open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644), STDOUT_FILENO);
  dup2(open(errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644), STDERR_FILENO);
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  prepare();
  execv(program.c_str(), argv.data());
  _exit(127);
}

}  // namespace

ProcessWatch::ProcessWatch(pid_t id) : id_(id), descriptor_(static_cast<int>(syscall(SYS_pidfd_open, id, 0))) {
  if (descriptor_ < 0) throw std::runtime_error{fmt::format("no process {}: {}", id, std::strerror(errno))};
}

ProcessWatch::ProcessWatch(ProcessWatch&& other) noexcept : id_(other.id_), descriptor_(other.descriptor_) {
  other.descriptor_ = -1;
}

ProcessWatch::~ProcessWatch() {
  if (descriptor_ >= 0) close(descriptor_);
}

bool ProcessWatch::ended(std::chrono::milliseconds timeout) const {
  pollfd end{descriptor_, POLLIN, 0};
  return poll(&end, 1, static_cast<int>(timeout.count())) == 1;
}

Program::Program(const std::string& name, std::vector<std::string> arguments, const fs::path& folder,
                 const std::function<void()>& prepare)
    : output_(fresh(folder, fs::path{name}.filename(), "out")),
      errors_(fresh(folder, fs::path{name}.filename(), "err")) {
  const std::string program = fs::path{TRIVELA_BINARY_DIR} / name;
  const pid_t id = fork();
  if (id < 0) throw std::runtime_error{fmt::format("cannot start {}: {}", name, std::strerror(errno))};
  if (id == 0) become(program, arguments, folder, output_, errors_, prepare);
  watch_.emplace(id);
}

Program::~Program() {
  if (status_) return;
  signal(SIGKILL);
  waitpid(id(), nullptr, 0);
}

int Program::wait() {
  if (!status_) {
    if (!watch_->ended(kTimeout)) {
      throw std::runtime_error{fmt::format("process {} did not end: {}{}", id(), output(), errors())};
    }
    int status = 0;
    waitpid(id(), &status, 0);
    status_ = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  }
  return *status_;
}

std::string Program::output() const { return text_of(output_); }
std::string Program::errors() const { return text_of(errors_); }

std::vector<pid_t> children_of(pid_t parent) {
  std::vector<pid_t> found;
  std::error_code gone;
  for (const auto& task : fs::directory_iterator{fmt::format("/proc/{}/task", parent), gone}) {
    std::ifstream in{task.path() / "children"};
    for (pid_t child = 0; in >> child;) found.push_back(child);
  }
  return found;
}

std::vector<pid_t> processes_in(const fs::path& folder) {
  std::vector<pid_t> found;
  for (const auto& entry : fs::directory_iterator{"/proc"}) {
    std::error_code gone;
    const pid_t id = std::atoi(entry.path().filename().c_str());
    if (id > 0 && fs::read_symlink(entry.path() / "cwd", gone) == folder) found.push_back(id);
  }
  return found;
}

std::vector<std::string> command_of(pid_t id) {
  std::ifstream in{fmt::format("/proc/{}/cmdline", id)};
  std::vector<std::string> words;
  for (std::string word; std::getline(in, word, '\0');) words.push_back(word);
  return words;
}

std::string program_of(pid_t id) {
  const std::vector<std::string> words = command_of(id);
  return words.empty() ? "" : fs::path{words.front()}.filename().string();
}

bool wait_for_change(const fs::path& folder, const ProcessWatch& process, const std::function<bool()>& condition) {
  const auto deadline = Clock::now() + kTimeout;
  const int changes = inotify_init1(IN_CLOEXEC | IN_NONBLOCK);
  inotify_add_watch(changes, folder.c_str(), IN_CREATE | IN_MODIFY | IN_MOVED_TO | IN_DELETE);
  bool met = condition();
  while (!met && Clock::now() < deadline) {
    std::array<pollfd, 2> sources{pollfd{changes, POLLIN, 0}, pollfd{process.file_descriptor(), POLLIN, 0}};
    poll(sources.data(), sources.size(), left_ms(deadline));
    std::array<char, 8192> events{};
    while (read(changes, events.data(), events.size()) > 0) continue;
    met = condition();
    if (sources[1].revents != 0) break;
  }
  close(changes);
  return met;
}

std::string text_of(const fs::path& file) {
  std::ifstream in{file};
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace trivela::e2e
