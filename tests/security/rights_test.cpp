// Who may write and read what, against the contract's page.
#include "security/rights.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "idl/messages.hpp"

namespace trivela::security {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

struct Row {
  std::set<std::string> writers;
  std::set<std::string> readers;
};

std::set<std::string> names(const std::string& cell) {
  static const std::map<std::string, std::string> kNodeOf{{"vision (simulator)", "vision simulator"},
                                                          {"goal camera (simulator)", "goal_camera simulator"},
                                                          {"refbox (simulator)", "refbox simulator"},
                                                          {"a bridge (simulator)", "bridge simulator"},
                                                          {"a bridge", "bridge"},
                                                          {"kick_decision", "kick_decision kick_decision_second"},
                                                          {"the team's own program", "team"},
                                                          {"hal/bus wheels", "odometry"},
                                                          {"hal/bus kicker", "kicker_driver"},
                                                          {"emulators/sim range finder", "scan_recorder"}};
  std::set<std::string> found;
  std::stringstream list(cell);
  for (std::string name; std::getline(list, name, ',');) {
    name.erase(0, name.find_first_not_of(' '));
    name.erase(name.find_last_not_of(' ') + 1);
    const auto known = kNodeOf.find(name);
    std::stringstream nodes(known == kNodeOf.end() ? name : known->second);
    for (std::string node; nodes >> node;) found.insert(node);
  }
  return found;
}

/// The table of idl/README.md by topic.
std::map<std::string, Row> contract() {
  std::ifstream page(TRIVELA_SOURCE_DIR "/idl/README.md");
  std::map<std::string, Row> rows;
  for (std::string line; std::getline(page, line);) {
    if (!line.starts_with("| `")) continue;
    std::vector<std::string> cells;
    std::stringstream text(line.substr(1));
    for (std::string cell; std::getline(text, cell, '|');) cells.push_back(cell);
    if (cells.size() < 7) continue;
    rows[cells[0].substr(2, cells[0].rfind('`') - 2)] = {names(cells[5]), names(cells[6])};
  }
  return rows;
}

TEST(Rights, AreWhatTheContractsTableSays) {
  std::map<std::string, Row> granted;
  for (const Rights& rights : all_rights()) {
    // The live page reads what it likes, and chain is three of them.
    if (rights.node == "monitor" || rights.node == "chain") continue;
    for (const std::string& topic : rights.publish) granted[topic].writers.insert(rights.node);
    for (const std::string& topic : rights.subscribe) granted[topic].readers.insert(rights.node);
  }
  for (const std::uint32_t machine : {0u, 1u}) {
    for (const std::string& topic : rights_on_team_bus(machine).publish) granted[topic].writers.insert("team_link");
    for (const std::string& topic : rights_on_team_bus(machine).subscribe) granted[topic].readers.insert("team_link");
  }
  const auto written = contract();
  ASSERT_GT(written.size(), 20u);
  for (const auto& [topic, row] : written) {
    EXPECT_EQ(granted[topic].writers, row.writers) << topic;
    EXPECT_EQ(granted[topic].readers, row.readers) << topic;
  }
  EXPECT_EQ(granted.size(), written.size());
}

TEST(Rights, EachWriterThatTheContractNamesIsAKindOfNode) {
  bus::for_each_message([]<class T>() {
    for (const std::string_view writer : bus::meta<T>::writers) {
      const bool on_team_bus = writer == "team_bus" || writer == "team_bus.0";
      EXPECT_EQ(std::ranges::count(all_rights(), writer, &Rights::node), on_team_bus ? 0 : 1) << writer;
    }
  });
}

TEST(Rights, TheLivePageReadsWhatIsSaidInAMatchAndWritesNothing) {
  const Rights& monitor = rights_of("monitor");
  EXPECT_THAT(monitor.publish, testing::IsEmpty());
  for (const auto& [topic, row] : contract())
    EXPECT_EQ(std::ranges::count(monitor.subscribe, topic), topic.starts_with("sim/") ? 0 : 1) << topic;
  EXPECT_TRUE(monitor.on_robot);
}

TEST(Rights, AnOrderIsWrittenByTheProcessesOfDecisionNodesAlone) {
  std::vector<std::string> writers;
  for (const Rights& rights : all_rights())
    for (const std::string& topic : rights.publish)
      if (topic == "kick_order") writers.push_back(rights.node);
  EXPECT_THAT(writers, ElementsAre("kick_decision", "kick_decision_second", "chain"));
}

TEST(Rights, TheChainMayWhatItsThreeNodesMayAndIsThereWhereItIsAskedFor) {
  std::set<std::string> writes, reads;
  for (const char* const node : {"odometry", "world_state", "kick_decision"}) {
    writes.insert(rights_of(node).publish.begin(), rights_of(node).publish.end());
    reads.insert(rights_of(node).subscribe.begin(), rights_of(node).subscribe.end());
  }
  EXPECT_THAT(rights_of("chain").publish, testing::ElementsAreArray(writes));
  EXPECT_THAT(rights_of("chain").subscribe, testing::ElementsAreArray(reads));
  EXPECT_FALSE(rights_of("chain").on_robot);
}

TEST(Rights, OnTheTeamsBusTheBaseAloneSaysTheReferee) {
  EXPECT_THAT(rights_on_team_bus(0).publish, ElementsAre("team_state", "referee"));
  for (const std::uint32_t robot_id : {1u, 255u})
    EXPECT_THAT(rights_on_team_bus(robot_id).publish, ElementsAre("team_state"));
  for (const Rights& rights : all_rights())
    EXPECT_NE(rights.node, rights_on_team_bus(1).node) << "permissions of the one bus would hold on the other";
}

TEST(Rights, PermissionsNameTheNodeItsTopicsAndItsWeekAndDenyTheRest) {
  using namespace std::chrono_literals;
  const Validity week{std::chrono::sys_days{2026y / 7 / 1}, std::chrono::sys_days{2026y / 7 / 10}};
  const std::string xml = permissions_xml(rights_of("world_state"), 3, week);
  EXPECT_THAT(xml, HasSubstr("<subject_name>O=Trivela,CN=world_state.3</subject_name>"));
  EXPECT_THAT(xml,
              HasSubstr("<not_before>2026-07-01T00:00:00Z</not_before><not_after>2026-07-10T00:00:00Z</not_after>"));
  EXPECT_THAT(xml, HasSubstr("<publish><topics><topic>world_state</topic></topics></publish>"));
  EXPECT_THAT(xml, HasSubstr("<topic>odometry</topic>"));
  EXPECT_THAT(xml, HasSubstr("<default>DENY</default>"));
  EXPECT_THAT(xml, Not(HasSubstr("kick_order")));
}

TEST(Rights, AKindOfNodeThatIsNoneIsNamedWithThoseThatAre) {
  try {
    rights_of("kick_desicion");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("\"kick_desicion\" is no kind of node; there are odometry, world_state"));
  }
}

}  // namespace
}  // namespace trivela::security
