#include "cli/collect/fetch.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "cli/verbs.hpp"
#include "log/read/reader.hpp"
#include "log/write/scan_log.hpp"

namespace trivela::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kFresh_s = 60;  // a write-ahead log that changed since is somebody's at work

struct RemoteFile {
  std::int64_t size_B = 0;
  std::int64_t age_s = 0;  // since it changed, by the machine's own clock
};
using RemoteFiles = std::map<std::string, RemoteFile>;  // by path

/// A program that ended.
struct Ran {
  bool succeeded = false;
  std::string output;  // standard output
  std::string said;    // standard error as one line, or how it ended
};

constexpr const char* kQuietSsh = " -o BatchMode=yes -o ConnectTimeout=10";

std::string as_one_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  std::string line;
  for (const char c : text) line += c == '\n' ? std::string("; ") : c == '\r' ? std::string() : std::string(1, c);
  return line;
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
  for (std::size_t n = 0; (n = std::fread(piece.data(), 1, piece.size(), file)) > 0;) text.append(piece.data(), n);
  return text;
}

/// A word as a shell takes it back.
std::string shell_quoted(const std::string& word) {
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

/// Its standard error goes to a file, which never fills up while nobody reads.
Ran run_program(const std::vector<std::string>& words) {
  const TemporaryFile err = temporary_file();
  std::string command = fmt::format("command -v {} >/dev/null || exit 127; exec", shell_quoted(words.front()));
  for (const std::string& word : words) command += ' ' + shell_quoted(word);
  std::FILE* const out = ::popen(fmt::format("{} 2>/dev/fd/{}", command, ::fileno(err.get())).c_str(), "re");
  if (out == nullptr) throw std::runtime_error{fmt::format("cannot start {}: {}", words.front(), std::strerror(errno))};
  Ran ran;
  ran.output = content_of(out);
  const int status = ::pclose(out);
  ran.succeeded = status == 0;
  ran.said = as_one_line(content_of(err.get()));
  if (!ran.succeeded && ran.said.empty())
    ran.said = WIFEXITED(status) ? fmt::format("{} ended with exit code {}", words.front(), WEXITSTATUS(status))
                                 : fmt::format("{} was ended by signal {}", words.front(), WTERMSIG(status));
  return ran;
}

/// rsync of files from a host into a folder: what is there already is compared by size and time, what came in part goes
/// on, nothing is changed there.
Ran fetch_files(const std::string& host, const std::vector<std::string>& paths, const std::filesystem::path& folder,
                const std::string& ssh) {
  std::vector<std::string> words{"rsync", "--times", "--partial", "--protect-args", "--rsh=" + ssh + kQuietSsh};
  for (const std::string& path : paths) words.push_back(fmt::format("{}:{}", host, path));
  words.push_back(folder.string() + "/");
  return run_program(words);
}

/// Sizes, ages and paths of logs and what lies beside them.
RemoteFiles files_of(const std::string& listing) {
  RemoteFiles files;
  std::istringstream lines(listing);
  std::int64_t now_s = 0;
  lines >> now_s;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::int64_t bytes = 0;
    double changed_s = 0.0;
    std::string path;
    if (!(words >> bytes >> changed_s) || !std::getline(words >> std::ws, path)) continue;
    files[path] = {bytes, now_s - static_cast<std::int64_t>(changed_s)};
  }
  return files;
}

std::string listing_command(const std::string& path) {
  const std::string quoted = shell_quoted(path);
  return fmt::format(
      "date +%s; find -L {} -maxdepth 1 -type f \\( -name '*.db' -o -name '*.db-wal' \\) -printf '%s %T@ %p\\n'",
      quoted);
}

/// A host without its user.
std::string machine_of(const std::string& host) { return host.substr(host.find('@') + 1); }

/// What is wrong with a fetched log; empty: nothing.
std::string wrong_with(const fs::path& log, const RemoteFile& there) {
  std::error_code error;
  const auto bytes = fs::file_size(log, error);
  if (error) return "it did not come";
  if (static_cast<std::int64_t>(bytes) != there.size_B) return fmt::format("{} of {} bytes came", bytes, there.size_B);
  std::string why;
  try {
    const log::Reader reader(log, log::Check::kQuick);
    return "";
  } catch (const std::exception& not_read) {
    why = not_read.what();
  }
  try {
    const log::ScanReader scans(log);
    return "";
  } catch (const std::exception&) {
    return why;
  }
}

void fetch_log(const LogHost& host, const std::string& path, const RemoteFiles& files, const fs::path& folder,
               const std::string& ssh, Fetched& fetched) {
  const std::string name = fs::path(path).filename().string();
  const auto wal = files.find(path + "-wal");
  if (wal != files.end() && wal->second.age_s < kFresh_s) {
    fetched.being_written.push_back(name);
    return;
  }
  std::vector<std::string> paths{path};
  if (wal != files.end()) {
    paths.push_back(wal->first);
  } else {
    // One that came along before belongs to what the log was then, and would be read into it.
    for (const char* const suffix : {"-wal", "-shm"}) fs::remove(folder / (name + suffix));
  }
  const Ran ran = fetch_files(host.host, paths, folder, ssh);
  const std::string wrong = ran.succeeded ? wrong_with(folder / name, files.at(path)) : ran.said;
  if (wrong.empty()) {
    ++fetched.here;
  } else {
    fetched.missing.push_back(fmt::format("{}: {}", name, wrong));
  }
}

}  // namespace

LogHost log_host(const std::string& text, const std::string& folder) {
  const auto colon = text.find(':');
  LogHost host{text.substr(0, colon), colon == std::string::npos ? folder : text.substr(colon + 1)};
  const std::string machine = machine_of(host.host);
  if (machine.empty() || host.path.empty() || text.front() == '-' || machine.front() == '-' ||
      host.host.find('/') != std::string::npos)
    throw UsageError{fmt::format("\"{}\" is no [USER@]HOST[:PATH] of a robot", text)};
  if (host.path.front() == '-') host.path.insert(0, "./");
  return host;
}

void require_program(const std::string& name, const std::string& how) {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (::access((fs::path(folder) / name).c_str(), X_OK) == 0) return;
  }
  throw std::runtime_error{fmt::format("trivela collect needs {}, which is not there: {}", name, how)};
}

Fetched fetch_logs(const LogHost& host, const fs::path& to, const std::string& ssh) {
  Fetched fetched;
  const Ran listed = run_program(  // without asking anybody for a password
      {ssh, "-o", "BatchMode=yes", "-o", "ConnectTimeout=10", host.host, listing_command(host.path)});
  if (!listed.succeeded) {
    fetched.missing.push_back(fmt::format("its logs in {}: {}", host.path, listed.said));
    return fetched;
  }
  const RemoteFiles files = files_of(listed.output);
  const fs::path folder = to / machine_of(host.host);
  std::error_code error;
  fs::create_directories(folder, error);
  for (const auto& [path, file] : files) {
    if (!path.ends_with(".db") || file.size_B == 0) continue;
    ++fetched.logs;
    fetch_log(host, path, files, folder, ssh, fetched);
  }
  if (fetched.logs == 0) fetched.missing.push_back(fmt::format("there is no log in {}", host.path));
  return fetched;
}

}  // namespace trivela::cli
