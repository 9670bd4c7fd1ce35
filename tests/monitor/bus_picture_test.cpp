#include "monitor/bus_picture.hpp"

#include <gmock/gmock.h>

#include <set>

namespace trivela::monitor {
namespace {

using testing::ElementsAre;
using testing::Field;
using testing::IsEmpty;
using testing::SizeIs;

constexpr std::int64_t kSecond = 1'000'000'000;

bus::End writer(const std::string& topic, const std::string& owner, const bus::Member& member, int strength = 0) {
  return {topic, owner, strength, false, member};
}

/// Three processes: two of this machine, of which one decides, and a base station's.
class Board : public testing::Test {
 protected:
  Board() {
    census.members = {decision, standby, base};
    census.writers = {writer("kick_order", "kick_decision/1", decision, 5),
                      writer("kick_order", "kick_decision/2", standby, 3), writer("referee", "refbox", base)};
    census.readers = {
        {"kick_order", "", 0, false, base}, {"kick_order", "", 0, false, base}, {"kick_order", "", 0, true, standby}};
  }
  BusSnapshot board(std::optional<std::uint8_t> only = {}) const {
    BusSnapshot made{"robot", only};
    made.add("kick_order", "order", 0.0);
    made.add("referee", "state", 0.1);
    return made;
  }
  BusPicture look(BusSnapshot& at, std::int64_t now_ns = kSecond) const {
    return at.look(census, now_ns, [this](std::int64_t pid) -> std::optional<ProcessReading> {
      if (ended.contains(pid)) return std::nullopt;
      return ProcessReading{pid * 4096, 1.0};
    });
  }
  static std::vector<bool> gone(const TopicPicture& topic) {
    std::vector<bool> states;
    for (const auto& one : topic.writers) states.push_back(one.state == WriterState::kStopped);
    return states;
  }

  bus::Member decision{"robot", "trivela-kick_decision", 11, ""};
  bus::Member standby{"robot", "trivela-kick_decision", 12, ""};
  bus::Member base{"base", "trivela-refbox", 11, ""};
  bus::Census census;
  std::set<std::int64_t> ended;
};

TEST_F(Board, HasEveryTopicOfTheListInItsOrder) {
  BusSnapshot empty = board();
  const BusPicture picture = empty.look({}, 0, [](std::int64_t) { return std::nullopt; });
  EXPECT_THAT(picture.topics,
              ElementsAre(Field(&TopicPicture::topic, "kick_order"), Field(&TopicPicture::topic, "referee")));
  EXPECT_THAT(picture.processes, IsEmpty());
}

TEST_F(Board, NamesWritersWithStrengthAndReadersOnceWithoutThoseThatLookOn) {
  BusSnapshot full = board();
  const BusPicture picture = look(full);
  EXPECT_THAT(picture.topics[0].writers,
              ElementsAre(WriterPicture{"kick_decision/1", "robot", 11, 5, WriterState::kThere},
                          WriterPicture{"kick_decision/2", "robot", 12, 3, WriterState::kThere}));
  EXPECT_THAT(picture.topics[0].readers, ElementsAre("refbox"));
}

TEST_F(Board, NamesAWriterWithoutOwnerByItsProgram) {
  census.writers = {writer("referee", "", base)};
  BusSnapshot full = board();
  EXPECT_EQ(look(full).topics[1].writers[0].owner, "refbox");
}

TEST_F(Board, SeesThatAWriterWasKilledBeforeTheDomainForgetsIt) {
  BusSnapshot full = board();
  look(full);
  ended = {11};
  const BusPicture picture = look(full);
  EXPECT_THAT(gone(picture.topics[0]), ElementsAre(true, false));
  EXPECT_THAT(gone(picture.topics[1]), ElementsAre(false)) << "11 on another machine is another process";
}

TEST_F(Board, StillNamesAWriterThatLeftAndOneThatCameInItsPlace) {
  BusSnapshot full = board();
  look(full);
  census.writers = {writer("kick_order", "kick_decision/1", {"robot", "trivela-kick_decision", 13, ""}, 5)};
  const BusPicture picture = look(full);
  EXPECT_THAT(gone(picture.topics[0]), ElementsAre(false, true, true));
  EXPECT_EQ(picture.topics[0].writers[0].pid, 13);
}

TEST_F(Board, KeepsFewOfManyThatLeft) {
  BusSnapshot full = board();
  for (std::int64_t pid = 100; pid < 200; ++pid) {
    census.writers = {writer("referee", "refbox", {"base", "trivela-refbox", pid, ""})};
    look(full);
  }
  EXPECT_THAT(look(full).topics[1].writers, SizeIs(9));
}

TEST_F(Board, ShowsOneRobotOfATeam) {
  BusSnapshot second = board(2);
  second.receive("kick_order", 1, {1, 1, 0, 0, kSecond, kSecond});
  second.receive("kick_order", 2, {2, 1, 0, 0, kSecond, kSecond});
  const BusPicture picture = look(second);
  EXPECT_THAT(picture.topics[0].robots, SizeIs(1));
  EXPECT_TRUE(picture.topics[0].robots.contains(2));
  EXPECT_THAT(picture.topics[0].writers, ElementsAre(Field(&WriterPicture::owner, "kick_decision/2")));
  EXPECT_THAT(picture.topics[1].writers, SizeIs(1)) << "refbox writes for all";
}

TEST_F(Board, DoesNotGrowWithUnknownNumbersAndTopics) {
  BusSnapshot full = board();
  for (int robot = 0; robot < 256; ++robot)
    full.receive("referee", static_cast<std::uint8_t>(robot), {1, 1, 0, 0, kSecond, kSecond});
  full.receive("no_such_topic", 1, {1, 1, 0, 0, kSecond, kSecond});
  EXPECT_THAT(look(full).topics[1].robots, SizeIs(32));
}

TEST_F(Board, HasTheMemoryOfThisMachinesProcessesAlone) {
  BusSnapshot full = board();
  const BusPicture picture = look(full);
  ASSERT_THAT(picture.processes, SizeIs(3));
  EXPECT_EQ(picture.processes[0].load->memory_bytes, 11 * 4096);
  EXPECT_EQ(picture.processes[0].name, "kick_decision");
  EXPECT_FALSE(picture.processes[2].load);
}

}  // namespace
}  // namespace trivela::monitor
