// A team's log of 45 MB with the faults of real clients, made on the spot and read: how long, and with how much memory.
#include <fmt/core.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <exception>
#include <filesystem>
#include <fstream>

#include "evaluator/imports/play_statistics.hpp"
#include "evaluator/imports/team_log.hpp"
#include "tests/evaluator/team_log_writing.hpp"

namespace {

namespace fs = std::filesystem;
namespace imports = trivela::evaluator::imports;

constexpr std::int64_t kLogBytes = 45'000'000;
constexpr double kGoal_s = 3.0, kGoal_MB = 200.0;

double most_memory_MB() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1e-6 * 1024.0 * static_cast<double>(usage.ru_maxrss);
}

int measure(const fs::path& file) {
  {
    std::ofstream out(file, std::ios::binary);
    imports::write_faulty_log(out, kLogBytes);
  }
  const auto start = std::chrono::steady_clock::now();
  std::ifstream in(file, std::ios::binary);
  const imports::TeamLog log = imports::read_team_log(in, file.filename().string());
  const auto possessions = imports::possessions(log, imports::record_times_ms(log, nullptr));
  const double took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  fmt::print(
      "{:.0f} MB, {} records, {} kinds of faults, {} possessions: {:.2f} s (goal {:.0f}), {:.0f} MB (goal {:.0f})\n",
      1e-6 * static_cast<double>(fs::file_size(file)), log.records, log.faults.all().size(), possessions.size(), took_s,
      kGoal_s, most_memory_MB(), kGoal_MB);
  return took_s < kGoal_s && most_memory_MB() < kGoal_MB ? 0 : 3;
}

}  // namespace

/// Exit codes: 0 both goals met, 1 failed, 3 a goal missed.
int main() {
  const fs::path file = fs::temp_directory_path() / fmt::format("trivela_import_bench_{}.A.msl", getpid());
  int code = 1;
  try {
    code = measure(file);
  } catch (const std::exception& error) {
    fmt::print(stderr, "import_bench: {}\n", error.what());
  }
  std::error_code ignored;
  fs::remove(file, ignored);
  return code;
}
