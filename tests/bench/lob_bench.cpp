#include <benchmark/benchmark.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "hal/scip/messages.hpp"
#include "hal/scip/reply.hpp"
#include "kicking/lob/analyzer.hpp"
#include "sim/laser/laser.hpp"
#include "sim/laser/record.hpp"

// The lob analyzer on synthetic scans of 1081 beams. `--benchmark_repetitions=9` prints the median.
namespace {

using namespace trivela;
using kicking::lob::Analyzer;

/// Half a minute a dozen lobs; the laser stands under the path.
const sim::SyntheticRecord& record() {
  static const sim::SyntheticRecord made = [] {
    sim::RecordPlan plan;
    for (int i = 0; i < 12; ++i) plan.kicks.push_back({6.0 + 0.4 * i, 0.64, 0.25, std::nullopt});
    return sim::synthesize_record({}, plan, {}, 1);
  }();
  return made;
}

Analyzer with_background() {
  Analyzer analyzer({}, record().mount);
  for (std::size_t i = 0; i < 40; ++i) analyzer.add(record().scans[i]);
  return analyzer;
}

void add_scan_of_background(benchmark::State& state) {
  Analyzer analyzer = with_background();
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(analyzer.add(record().scans[40 + i++ % 38]));
}
BENCHMARK(add_scan_of_background);

/// The scans of the first 0.9 s of a flight.
std::vector<kicking::lob::Scan> flight() {
  const auto launch = record().truth[4].launch_t_ns;
  std::vector<kicking::lob::Scan> scans;
  for (const auto& scan : record().scans) {
    if (scan.t_ns > launch && scan.t_ns < launch + 900'000'000) scans.push_back(scan);
  }
  return scans;
}

/// The flight again and again; each time it begins again 1.5 s later.
void add_scan_with_flying_ball(benchmark::State& state) {
  auto scans = flight();
  Analyzer analyzer = with_background();
  std::size_t i = 0;
  std::int64_t centres = 0;
  for (auto _ : state) {
    auto& scan = scans[i++ % scans.size()];
    scan.t_ns += 1'500'000'000;
    benchmark::DoNotOptimize(analyzer.add(scan));
    centres += analyzer.view().centre.has_value();
  }
  state.counters["ball_seen"] = static_cast<double>(centres) / static_cast<double>(state.iterations());
}
BENCHMARK(add_scan_with_flying_ball);

/// The reply of a scanner to MD that holds the scan.
std::string md_reply(const kicking::lob::Scan& scan) {
  namespace scip = hal::scip;
  const auto with_sum = [](const std::string& text) { return text + scip::checksum(text) + '\n'; };
  std::string data;
  for (const std::uint32_t range_mm : scan.range_mm) data += scip::encode(range_mm, 3);
  std::string reply = "MD0000108001000\n99b\n" + with_sum(scip::encode(1234, 4));
  for (std::size_t i = 0; i < data.size(); i += 64) reply += with_sum(data.substr(i, 64));
  return reply + '\n';
}

/// From the bytes on the line to the ball's centre.
void bytes_to_ball_centre(benchmark::State& state) {
  const auto scans = flight();
  std::vector<std::string> replies;
  for (const auto& scan : scans) replies.push_back(md_reply(scan));
  Analyzer analyzer = with_background();
  hal::scip::ReplyParser parser;
  std::size_t i = 0;
  std::int64_t centres = 0, t_ns = 0;
  for (auto _ : state) {
    const std::size_t j = i++ % replies.size();
    t_ns += j == 0 ? 1'500'000'000 : 25'000'000;
    for (const auto& reply : parser.feed(replies[j])) {
      auto ranges = hal::scip::ranges_of(reply, 1081);
      benchmark::DoNotOptimize(analyzer.add({t_ns, std::move(*ranges)}));
    }
    centres += analyzer.view().centre.has_value();
  }
  state.counters["ball_seen"] = static_cast<double>(centres) / static_cast<double>(state.iterations());
}
BENCHMARK(bytes_to_ball_centre);

void analyse_two_minutes(benchmark::State& state) {
  constexpr std::size_t kScans = 4800;
  const auto& scans = record().scans;
  std::int64_t lobs = 0;
  for (auto _ : state) {
    Analyzer analyzer({}, record().mount);
    lobs = 0;
    for (std::size_t i = 0; i < kScans; ++i) {
      kicking::lob::Scan scan = scans[i % scans.size()];
      scan.t_ns = static_cast<std::int64_t>(i) * 25'000'000;
      lobs += analyzer.add(scan).has_value();
    }
  }
  state.counters["lobs"] = static_cast<double>(lobs);
}
BENCHMARK(analyse_two_minutes)->Unit(benchmark::kMillisecond);

void synthesize_scan(benchmark::State& state) {
  sim::ScanBuilder builder({}, 0.11, {1, 1});
  std::int64_t t_ns = 0;
  for (auto _ : state) {
    for (int i = 0; i < 25; ++i) builder.advance(t_ns += 1'000'000, Eigen::Vector3d{3.0, 0.0, 1.0});
    benchmark::DoNotOptimize(builder.take());
  }
}
BENCHMARK(synthesize_scan);

}  // namespace
