// What the live page takes of a machine: five robots at 50 Hz on a real bus, and viewers over HTTP, each in a process
// of its own. Prints one line; asserts nothing.
//
//     build/release/tests/monitor_bench --viewers 30 --seconds 20
#include <fmt/core.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <memory>
#include <string>

#include "pages/monitor/match_feed.hpp"
#include "pages/serve/page_server.hpp"
#include "tests/bus/test_domain.hpp"
#include "tests/pages/viewer.hpp"
#include "tests/pages/written_team.hpp"

namespace {

using namespace trivela;

/// A process that does something until it is told to end.
template <class Work>
pid_t process(Work work) {
  const pid_t child = fork();
  if (child != 0) return child;
  work();
  std::_Exit(0);
}

double processor_s() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

double resident_mb() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (word != "VmRSS:") continue;
    double kb = 0.0;
    status >> kb;
    return kb / 1024.0;
  }
  return 0.0;
}

/// Viewers of a page; says how many pictures a second each got, on average.
void watch(int port, int viewers, int seconds, int said) {
  std::vector<std::unique_ptr<pages::Viewer>> all;
  for (int i = 0; i < viewers; ++i) all.push_back(std::make_unique<pages::Viewer>(port));
  std::this_thread::sleep_for(std::chrono::seconds(seconds));
  double pictures = 0.0;
  for (const auto& viewer : all) {
    viewer->wait([&] {
      pictures += viewer->events["pitch"];
      return true;
    });
  }
  const double rate_hz = viewers > 0 ? pictures / viewers / seconds : 0.0;
  if (write(said, &rate_hz, sizeof rate_hz) != sizeof rate_hz) std::perror("write");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"What the live page takes of a machine"};
  int viewers = 30, seconds = 20;
  app.add_option("--viewers", viewers)->check(CLI::Range(0, 48))->capture_default_str();
  app.add_option("--seconds", seconds)->check(CLI::Range(1, 600))->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  const bus::DomainConfig domain = bus::fresh_domain();
  int told[2], said[2];
  if (pipe(told) != 0 || pipe(said) != 0) return 1;
  const pid_t robots = process([&] {
    const pages::WrittenTeam team(domain);
    pause();
  });
  const pid_t watchers = process([&] {
    int port = 0;
    if (read(told[0], &port, sizeof port) == sizeof port) watch(port, viewers, seconds, said[1]);
  });
  pages::Broadcast broadcast{pages::match_channels()};
  pages::MatchFeed feed(domain, false, {.title = "bench"}, broadcast);
  const pages::PageServer server(pages::monitor_page(), broadcast, {});
  const int port = server.port();
  const double before_s = processor_s();
  double rate_hz = 0.0;
  if (write(told[1], &port, sizeof port) != sizeof port || read(said[0], &rate_hz, sizeof rate_hz) != sizeof rate_hz)
    return 1;
  fmt::print("{} robots at 50 Hz, {} viewers: {:.1f} % of a core, {:.1f} MB resident, {:.1f} pictures a second each\n",
             pages::kRobots, viewers, 100.0 * (processor_s() - before_s) / seconds, resident_mb(), rate_hz);
  kill(robots, SIGKILL);
  for (const pid_t child : {robots, watchers}) waitpid(child, nullptr, 0);
}
