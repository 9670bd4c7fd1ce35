// `trivela top` beside nodes of a match in real time.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include "tests/e2e/folder.hpp"
#include "tests/e2e/program.hpp"

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
  Robot() {
    const std::string shipped = (std::filesystem::path{TRIVELA_SOURCE_DIR} / "config/default.toml").string();
    for (const char* const name : {"odometry", "world_state", "kick_decision", "kicker_driver", "simulator"})
      nodes[name] = std::make_unique<Program>(
          std::string{"trivela-"} + name,
          std::vector<std::string>{"--config", shipped, "--set", "domain.domain_id=" + domain_, "--set",
                                   fmt::format("domain.tag=\"{}\"", tag_)},
          folder.path());
  }

  std::unique_ptr<Program> top(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{"top", "--domain", domain_, "--tag", tag_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return std::make_unique<Program>("trivela", arguments, folder.path());
  }

  Folder folder;
  std::map<std::string, std::unique_ptr<Program>> nodes;

 private:
  std::string domain_ = std::to_string(1 + std::random_device{}() % 100);
  std::string tag_ = fmt::format("top-{}-{:08x}", getpid(), std::random_device{}());
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

TEST(Top, RefusesADomainThatThereCannotBe) {
  const Folder folder;
  Program top("trivela", {"top", "--domain", "101"}, folder.path());
  EXPECT_EQ(top.wait(), 2);
  EXPECT_THAT(top.errors(), HasSubstr("--domain"));
}

}  // namespace
}  // namespace trivela::e2e
