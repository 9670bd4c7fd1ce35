// `trivela top` beside nodes of a match in real time.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <stdexcept>

#include "tests/e2e/program.hpp"
#include "tests/support/folder.hpp"

namespace trivela::e2e {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::Contains;
using testing::Gt;
using testing::HasSubstr;
using testing::Lt;

/// A robot's nodes and its simulator in real time, in a folder.
class Robot {
 public:
  /// `keys`: a folder of the team's, in its own; empty: in clear.
  explicit Robot(const std::string& keys = "") {
    if (!keys.empty()) make_keys(keys);
    const std::string shipped = (std::filesystem::path{TRIVELA_SOURCE_DIR} / "config/default.toml").string();
    for (const char* const name : {"odometry", "world_state", "kick_decision", "kicker_driver", "simulator"})
      nodes[name] = std::make_unique<Program>(std::string{"trivela-"} + name,
                                              secured({"--config", shipped, "--set", "domain.domain_id=" + domain_,
                                                       "--set", fmt::format("domain.tag=\"{}\"", tag_)},
                                                      keys),
                                              folder.path());
  }

  /// A team of which this robot is the first: team.toml in the folder.
  void describe_team() const {
    std::ofstream{folder / "team.toml"} << fmt::format(
        "[team]\nname = \"{}\"\nnumber = 39\nnetwork = \"127.0.0.0/8\"\ninterface = \"lo\"\nlogs = "
        "\"/var/lib/trivela\"\n[domains]\nrobot = {}\nteam = {}\n[[robot]]\nnumber = 1\n"
        "address = \"127.0.0.1\"\nrobot = \"{}/config/robots/cambada_1.toml\"\n[base]\naddress = \"127.0.0.2\"\n",
        team_, domain_, domain_ == "7" ? 8 : 7, TRIVELA_SOURCE_DIR);
  }

  std::unique_ptr<Program> top_of_team(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{"top", "--team", "team.toml", "--json", "--interval", "0.5"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return std::make_unique<Program>("trivela", arguments, folder.path());
  }

  std::unique_ptr<Program> top(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{"top", "--domain", domain_, "--tag", tag_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return std::make_unique<Program>("trivela", arguments, folder.path());
  }

  tests::Folder folder;
  std::map<std::string, std::unique_ptr<Program>> nodes;

 private:
  static std::vector<std::string> secured(std::vector<std::string> arguments, const std::string& keys) {
    if (!keys.empty()) arguments.insert(arguments.end(), {"--secure", keys});
    return arguments;
  }

  void make_keys(const std::string& keys) const {
    for (const std::vector<std::string>& more : {std::vector<std::string>{"init"}, {"issue", "--node", "simulator"}}) {
      std::vector<std::string> arguments{"keys", more[0], "--dir", keys, "--robot", "1"};
      arguments.insert(arguments.end(), more.begin() + 1, more.end());
      Program program{"trivela", arguments, folder.path()};
      if (program.wait() != 0) throw std::runtime_error{program.errors()};
    }
  }

  std::string domain_ = std::to_string(1 + std::random_device{}() % 100);
  std::string team_ = fmt::format("top-{}-{:08x}", getpid(), std::random_device{}());
  std::string tag_ = team_ + "-1";  // as trivela team configure has it
};

/// The last whole line that was printed; null: there is none.
json last_picture(const Program& top) {
  const std::string text = top.output();
  const std::size_t end = text.rfind('\n');
  if (end == std::string::npos) return {};
  const std::size_t before = end == 0 ? std::string::npos : text.rfind('\n', end - 1);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  return json::parse(text.substr(begin, end - begin));
}

json topic_of(const json& picture, const std::string& name) {
  if (picture.is_null()) return {};
  for (const json& topic : picture["topics"])
    if (topic["topic"] == name) return topic;
  return {};
}

std::set<std::string> nodes_writing(const json& topic, bool gone) {
  std::set<std::string> nodes;
  for (const json& writer : topic["writers"])
    if (writer["gone"] == gone) nodes.insert(writer["node"]);
  return nodes;
}

std::int64_t received(const Program& top, const std::string& name) {
  const json topic = topic_of(last_picture(top), name);
  return topic.is_null() || topic["robots"].empty() ? 0 : topic["robots"][0]["received"].get<std::int64_t>();
}

TEST(Top, ShowsRatesWritersAndProcessesAndThatAWriterWasKilled) {
  Robot robot;
  const auto top = robot.top({"--json", "--interval", "0.5"});
  ASSERT_TRUE(wait_for_change(robot.folder.path(), top->watch(), [&] { return received(*top, "drive") > 100; }))
      << top->errors();
  const json picture = last_picture(*top);
  for (const char* const name : {"odometry", "world_state", "drive", "kicker_status", "device/wheels"}) {
    const json topic = topic_of(picture, name);
    EXPECT_THAT(topic["robots"][0]["rate_hz"].get<double>(), AllOf(Gt(25.0), Lt(75.0))) << topic;
  }
  const json drive = topic_of(picture, "drive");
  EXPECT_THAT(nodes_writing(drive, false), Contains("kick_decision/1"));
  EXPECT_THAT(drive["readers"].get<std::vector<std::string>>(),
              testing::UnorderedElementsAre("kicker_driver", "odometry"));
  EXPECT_EQ(picture["processes"].size(), robot.nodes.size());
  EXPECT_THAT(picture["processes"][0]["memory_bytes"].get<std::int64_t>(), Gt(1'000'000));

  robot.nodes["kick_decision"]->signal(SIGKILL);
  EXPECT_TRUE(wait_for_change(robot.folder.path(), top->watch(), [&] {
    return nodes_writing(topic_of(last_picture(*top), "drive"), true).contains("kick_decision/1");
  }));
  top->signal(SIGINT);
  EXPECT_EQ(top->wait(), 0) << top->errors();
}

TEST(Top, ShowsOneTableAndEnds) {
  const Robot robot;
  const auto top = robot.top({"--once", "--robot", "2"});
  EXPECT_EQ(top->wait(), 0) << top->errors();
  EXPECT_THAT(top->output(),
              AllOf(HasSubstr("writers -> readers"), HasSubstr("nobody writes: "), HasSubstr("memory MB")));
  EXPECT_THAT(top->output(), testing::Not(HasSubstr("odometry/1"))) << "that is robot 1's";
}

/// Whether `top` hears world states before it gives up.
bool hears_robot(const Robot& robot, const Program& top) {
  return wait_for_change(robot.folder.path(), top.watch(), [&] { return received(top, "world_state") > 10; });
}

TEST(Top, FindsTheBusOfARobotByItsTeamsFile) {
  const Robot robot;
  robot.describe_team();
  const auto top = robot.top_of_team({"--robot", "1"});
  EXPECT_TRUE(hears_robot(robot, *top)) << top->errors();
  const auto base = robot.top_of_team({"--once"});
  EXPECT_EQ(base->wait(), 0) << base->errors();
  EXPECT_EQ(received(*base, "world_state"), 0) << "that is not the base's bus";
}

TEST(Top, LooksOnAtASecuredBusWithAMonitorsKeysAlone) {
  const Robot robot{"keys"};
  const auto without = robot.top({"--json", "--interval", "0.5"});
  const auto top = robot.top({"--json", "--interval", "0.5", "--robot", "1", "--secure", "keys"});
  EXPECT_TRUE(hears_robot(robot, *top)) << top->errors();
  const json picture = last_picture(*top);
  EXPECT_THAT(nodes_writing(topic_of(picture, "world_state"), false), Contains("world_state/1"));
  EXPECT_EQ(received(*without, "world_state"), 0);
}

TEST(Top, ListensBetweenTheMachinesWithCyclonesFileOfTheTeam) {
  const Robot robot;  // of which nothing is heard there
  robot.describe_team();
  Program configured{
      "trivela", {"team", "configure", "team.toml", "--robot", "1", "--out", "own"}, robot.folder.path()};
  ASSERT_EQ(configured.wait(), 0) << configured.errors();
  const Program link{
      "trivela-team_link", {"--config", "own/settings.toml", "--set", "team_link.referee=false"}, robot.folder.path()};
  const auto top = robot.top_of_team({"--dds", "own/team_bus.xml"});
  EXPECT_TRUE(wait_for_change(robot.folder.path(), top->watch(), [&] { return received(*top, "team_state") > 10; }))
      << top->errors() << link.errors();
  EXPECT_EQ(received(*top, "world_state"), 0) << "that stays on the robot";
}

TEST(Top, RefusesARobotThatTheTeamHasNotAndKeysBetweenTheMachines) {
  const tests::Folder folder;
  const std::string team = TRIVELA_SOURCE_DIR "/config/teams/example.toml";
  Program nobody{"trivela", {"top", "--team", team, "--robot", "9"}, folder.path()};
  EXPECT_EQ(nobody.wait(), 2);
  EXPECT_THAT(nobody.errors(), HasSubstr("has no such robot"));
  Program secured{"trivela", {"top", "--dds", team, "--secure", "keys"}, folder.path()};
  EXPECT_EQ(secured.wait(), 2);
  EXPECT_THAT(secured.errors(), HasSubstr("nobody can look on"));
}

TEST(Top, RefusesADomainThatThereCannotBe) {
  const tests::Folder folder;
  Program top("trivela", {"top", "--domain", "101"}, folder.path());
  EXPECT_EQ(top.wait(), 2);
  EXPECT_THAT(top.errors(), HasSubstr("--domain"));
}

}  // namespace
}  // namespace trivela::e2e
