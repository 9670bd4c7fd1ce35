#include <fmt/chrono.h>
#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include <ctime>
#include <memory>
#include <string>

#include "calibration/scanner_session.hpp"
#include "cli/launch/signals.hpp"
#include "cli/lob_points.hpp"
#include "cli/options/match_mode.hpp"
#include "cli/options/number_checks.hpp"
#include "cli/scan/verb_parts.hpp"
#include "cli/verbs.hpp"
#include "config/robot.hpp"
#include "config/settings.hpp"
#include "config/text/installation.hpp"
#include "hal/open.hpp"
#include "kicking/lob/analyzer.hpp"
#include "pages/lob/live_scene.hpp"
#include "pages/lob/lob_page.hpp"
#include "pages/lob/replay_scene.hpp"
#include "pages/serve/page_server.hpp"

namespace trivela::cli {
namespace {

/// Flags of `trivela lob --live` and `trivela lob --replay`.
struct PageFlags {
  std::string live;
  std::string replay;
  std::string record;  ///< empty: lobs-<date>.db
  std::string listen = "127.0.0.1";
  int port = 0;
  std::string plan;
  std::string robot;
  int trials = 2;
  std::string config = config::shipped("default.toml").string();

  bool asked_for() const { return !live.empty() || !replay.empty(); }
};

constexpr int kCheck_ms = 200;  // how often the scene is asked whether it still runs

pages::CalibrationPlan plan_of(const PageFlags& flags) {
  pages::CalibrationPlan plan{.powers = {}, .trials = flags.trials};
  if (!flags.plan.empty()) plan.powers = pages::parse_powers(flags.plan, "--plan");
  if (!flags.robot.empty()) {
    const config::Robot robot = config::load_robot(flags.robot);
    for (const kicking::SetPoint& point : robot.model.table.set_points()) plan.powers.push_back(point.power);
  }
  return plan;
}

std::unique_ptr<pages::Scene> open_scene(const PageFlags& flags, const kicking::lob::LaserMount& mount,
                                         const kicking::lob::AnalyzerConfig& config, pages::Broadcast& broadcast) {
  const pages::CalibrationPlan plan = plan_of(flags);
  if (!flags.replay.empty()) return std::make_unique<pages::ReplayScene>(flags.replay, config, plan, broadcast);
  const std::string record = !flags.record.empty()
                                 ? flags.record
                                 : fmt::format("lobs-{:%Y-%m-%d-%H%M%S}.db", fmt::localtime(std::time(nullptr)));
  calibration::refuse_existing(record);
  return std::make_unique<pages::LiveScene>(
      hal::open_range_finder(flags.live),
      pages::LiveOptions{.device = flags.live, .record = record, .mount = mount, .analyzer = config, .plan = plan},
      broadcast);
}

void add_page_flags(CLI::App& verb, PageFlags& flags) {
  auto* live = verb.add_option("--live", flags.live, "page: this scanner, /dev/ttyACM0 or tcp://HOST:PORT");
  auto* replay = verb.add_option("--replay", flags.replay,
                                 "page: this scan record, which is not changed; verdicts go to FILE.verdicts.json")
                     ->excludes(live);
  verb.add_option("--record", flags.record, "page, live: record, must not exist; default: lobs-<date>.db here")
      ->excludes(replay);
  add_default(verb, "--listen", flags.listen, "page: ADDRESS[:PORT] to serve it on; 0.0.0.0 opens it to the network");
  add_default(verb, "--port", flags.port, "page: port, 0: any free one", CLI::Range(0, 65535));
  auto* plan = verb.add_option("--plan", flags.plan, "page: powers to calibrate, e.g. 15,20,...,50");
  verb.add_option("--robot", flags.robot, "page: powers of this robot file's table as the plan")->excludes(plan);
  add_default(verb, "--trials", flags.trials, "page: kicks of each power", CLI::Range(1, 1000));
  add_default(verb, "--config", flags.config, "page: settings whose run.match_mode refuses it", readable_file());
}

/// Serves the page until Ctrl-C; returns the exit code. The mount is that of a live scanner; a record knows its own.
/// Throws std::runtime_error where a match is on: the page takes verdicts and powers.
int serve_lobs(const PageFlags& flags, const kicking::lob::LaserMount& mount,
               const kicking::lob::AnalyzerConfig& config) {
  refuse_in_a_match(config::load_settings(flags.config), "the page of trivela lob");
  const pages::ListenAddress address = pages::parse_listen(flags.listen, flags.port, "--listen");
  SignalInbox signals;  // before all threads, which must not take them
  pages::Broadcast broadcast{pages::lob_channels()};
  const auto scene = open_scene(flags, mount, config, broadcast);
  {
    const pages::PageServer server(pages::lob_page(*scene), broadcast, address);
    fmt::print("{}\n", server.url());
    std::fflush(stdout);
    do {
      scene->check();
    } while (!signals.stop_requested_within(kCheck_ms));
  }  // the server ends first: a verdict that was answered is in the record
  scene->finish();
  return kDone;
}

struct LobFlags {
  PageFlags page;
  PointsFlags points;
  MountFlags mount;
};

int run(const LobFlags& flags, bool place_given) {
  if (!flags.points.points.empty()) {
    if (flags.page.asked_for()) throw UsageError{"--points goes without --live and --replay"};
    if (!place_given)
      throw UsageError{"--points needs --laser-x-m and --laser-z-m: no return says where the laser stood"};
    return run_lob_points(flags.points, {flags.mount.laser_x_m, flags.mount.laser_z_m});
  }
  if (!flags.page.asked_for()) throw UsageError{"lob needs --live, --replay or --points"};
  kicking::lob::AnalyzerConfig config;
  if (flags.points.centre == "middle") config.centre = kicking::lob::CentreMethod::kMiddleOfLimits;
  config.drag_coefficient = flags.points.cd;
  return serve_lobs(flags.page, flags.mount.mount(), config);
}

}  // namespace

void add_lob(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand("lob", "Find lobs in the scans of a laser range finder and fit them");
  auto flags = std::make_shared<LobFlags>();
  add_page_flags(*verb, flags->page);
  add_points_flags(*verb, flags->points);
  add_mount_flags(*verb, flags->mount);
  verb->callback([flags, verb, &exit_code] {
    exit_code = run(*flags, verb->count("--laser-x-m") > 0 && verb->count("--laser-z-m") > 0);
  });
}

}  // namespace trivela::cli
