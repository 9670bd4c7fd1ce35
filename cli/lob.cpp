#include <memory>

#include "cli/lob/page_verb.hpp"
#include "cli/lob_points.hpp"
#include "cli/scan/verb_parts.hpp"
#include "cli/verbs.hpp"

namespace trivela::cli {
namespace {

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
