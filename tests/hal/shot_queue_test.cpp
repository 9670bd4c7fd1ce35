#include "hal/board/board_kicker.hpp"

#include <gtest/gtest.h>

namespace trivela::hal {
namespace {

TEST(ShotQueue, GivesEachShotOnceAndNotBeforeItsInstant) {
  ShotQueue queue;
  EXPECT_EQ(queue.next_ns(), ShotQueue::kNever_ns);
  queue.add({.kick_id = 1, .power = 10.0, .t_ns = 200});
  queue.add({.kick_id = 2, .power = 20.0, .t_ns = 150});
  EXPECT_EQ(queue.next_ns(), 150);
  EXPECT_FALSE(queue.take_due(149));
  EXPECT_EQ(queue.take_due(150)->kick_id, 2);
  EXPECT_FALSE(queue.take_due(199));
  EXPECT_EQ(queue.take_due(5000)->power, 10.0);
  EXPECT_FALSE(queue.take_due(ShotQueue::kNever_ns));
}

TEST(ShotQueue, WithdrawsWhatNobodyHasTakenAlsoWhereItsInstantHasCome) {
  ShotQueue queue;
  queue.add({.kick_id = 1, .power = 10.0, .t_ns = 100});
  queue.add({.kick_id = 2, .power = 20.0, .t_ns = 101});
  queue.withdraw(2);
  queue.withdraw(3);
  EXPECT_EQ(queue.take_due(1000)->kick_id, 1);
  EXPECT_FALSE(queue.take_due(1000));
}

}  // namespace
}  // namespace trivela::hal
