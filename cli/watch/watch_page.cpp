#include "cli/watch/watch_page.hpp"

#include <cstdio>

#include "cli/options/output.hpp"
#include "config/robot.hpp"
#include "nodes/runtime/node_main.hpp"
#include "pages/serve/site.hpp"

namespace trivela::cli {
namespace {

bool is_loopback(const std::string& host) { return host == "localhost" || host == "::1" || host.starts_with("127."); }

std::string token_for(const WatchFlags& flags, const pages::ListenAddress& address) {
  if (!flags.token_file.empty()) return pages::token_of_file(flags.token_file);
  return is_loopback(address.host) ? "" : pages::draw_token();
}

pages::ListenAddress address_of(const WatchFlags& flags) {
  return pages::parse_listen(flags.listen, flags.port, "--listen");
}

}  // namespace

std::vector<CLI::Option*> add_watch_flags(CLI::App& verb, WatchFlags& flags) {
  return {add_default(verb, "--listen", flags.listen,
                      "ADDRESS[:PORT] to serve the page on, such as the base's on the team's network; other than "
                      "loopback it needs a token"),
          add_default(verb, "--port", flags.port, "port of the page, 0: any free one", CLI::Range(0, 65535)),
          verb.add_option("--token-file", flags.token_file,
                          "file with the page's token (chmod 600); without it one is drawn where it is needed")};
}

pages::SceneSettings scene_settings(const config::Settings& settings) {
  const config::Robot robot = config::load_robot(settings.run.robot);
  return {.title = settings.run.team,
          .names = {{static_cast<std::uint8_t>(settings.run.robot_id), robot.name}},
          .goal = settings.goal,
          .side_line_x_m = settings.field.side_line_x_m,
          .cycle_s = settings.run.cycle_s,
          .goal_rules = {.opponents_half_only = settings.policy.rules.opponents_half_only,
                         .carry_limit_m = settings.policy.rules.carry_limit_m,
                         .ball_offset_m = robot.model.ball_offset_m}};
}

WatchPage::WatchPage(const WatchFlags& flags, const config::Settings& settings, const std::string& keys,
                     pages::SceneSettings scene)
    : feed_(nodes::domain_of(settings, keys, "monitor"), settings.run.lockstep, std::move(scene), broadcast_),
      server_(pages::monitor_page(token_for(flags, address_of(flags))), broadcast_, address_of(flags)) {
  say(server_.url() + "\n");
  std::fflush(stdout);
}

}  // namespace trivela::cli
