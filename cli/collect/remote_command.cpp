#include "cli/collect/remote_command.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>

namespace trivela::cli {
namespace {

constexpr const char* kQuietSsh = " -o BatchMode=yes -o ConnectTimeout=10";

std::string as_one_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  std::string line;
  for (const char c : text) line += c == '\n' ? std::string("; ") : c == '\r' ? std::string() : std::string(1, c);
  return line;
}

[[noreturn]] void become_program(const std::vector<std::string>& words, int out, int err) {
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  dup2(out, STDOUT_FILENO);
  dup2(err, STDERR_FILENO);
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  execvp(argv.front(), argv.data());
  _exit(127);
}

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using TemporaryFile = std::unique_ptr<std::FILE, CloseFile>;

TemporaryFile temporary_file() {
  TemporaryFile file(std::tmpfile());
  if (!file) throw std::runtime_error{fmt::format("cannot make a temporary file: {}", std::strerror(errno))};
  return file;
}

std::string content_of(std::FILE* file) {
  std::string text;
  std::array<char, 4096> piece{};
  std::rewind(file);
  for (std::size_t n = 0; (n = std::fread(piece.data(), 1, piece.size(), file)) > 0;) text.append(piece.data(), n);
  return text;
}

/// Its output goes to files, which never fill up while nobody reads.
Ran run_program(const std::vector<std::string>& words) {
  const TemporaryFile out = temporary_file(), err = temporary_file();
  const pid_t id = ::fork();
  if (id < 0) throw std::runtime_error{fmt::format("cannot start {}: {}", words.front(), std::strerror(errno))};
  if (id == 0) become_program(words, ::fileno(out.get()), ::fileno(err.get()));
  int status = 0;
  while (::waitpid(id, &status, 0) < 0 && errno == EINTR) {
  }
  Ran ran;
  ran.succeeded = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  ran.output = content_of(out.get());
  ran.said = as_one_line(content_of(err.get()));
  if (!ran.succeeded && ran.said.empty())
    ran.said = WIFEXITED(status) ? fmt::format("{} ended with exit code {}", words.front(), WEXITSTATUS(status))
                                 : fmt::format("{} was ended by signal {}", words.front(), WTERMSIG(status));
  return ran;
}

}  // namespace

std::string shell_quoted(const std::string& word) {
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

Ran run_on(const std::string& host, const std::string& command, const std::string& ssh) {
  return run_program({ssh, "-o", "BatchMode=yes", "-o", "ConnectTimeout=10", host, command});
}

Ran fetch_files(const std::string& host, const std::vector<std::string>& paths, const std::filesystem::path& folder,
                const std::string& ssh) {
  std::vector<std::string> words{"rsync", "--times", "--partial", "--protect-args", "--rsh=" + ssh + kQuietSsh};
  for (const std::string& path : paths) words.push_back(fmt::format("{}:{}", host, path));
  words.push_back(folder.string() + "/");
  return run_program(words);
}

}  // namespace trivela::cli
