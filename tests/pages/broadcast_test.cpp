#include "pages/serve/page_server.hpp"

#include <gmock/gmock.h>

#include <thread>

#include "pages/lob/lob_page.hpp"

namespace trivela::pages {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pointee;

TEST(Broadcast, ANewViewerGetsTheNewestOfEveryChannel) {
  Broadcast broadcast{lob_channels()};
  broadcast.publish(Channel::kFrame, "1");
  broadcast.publish(Channel::kLobs, "[]");
  broadcast.publish(Channel::kFrame, "2");
  Broadcast::Seen seen;
  EXPECT_THAT(broadcast.wait(seen, 10s), ElementsAre(Pointee(std::string("event: lobs\ndata: []\n\n")),
                                                     Pointee(std::string("event: frame\ndata: 2\n\n"))));
  EXPECT_THAT(broadcast.wait(seen, 0s), IsEmpty()) << "nothing twice";
}

TEST(Broadcast, ASlowViewerSkipsFramesAndAllViewersShareOneMessage) {
  Broadcast broadcast{lob_channels()};
  Broadcast::Seen fast{};
  Broadcast::Seen slow{};
  for (int i = 0; i < 100; ++i) {
    broadcast.publish(Channel::kFrame, std::to_string(i));
    ASSERT_EQ(broadcast.wait(fast, 10s).size(), 1u);
  }
  broadcast.publish(Channel::kFrame, "100");
  const auto late = broadcast.wait(slow, 10s);
  ASSERT_EQ(late.size(), 1u);
  EXPECT_EQ(*late[0], "event: frame\ndata: 100\n\n");
  EXPECT_EQ(late[0], broadcast.wait(fast, 10s).at(0)) << "the same bytes in memory";
}

TEST(Broadcast, WakesWhoWaitsWhenSomethingComesAndWhenItCloses) {
  Broadcast broadcast{lob_channels()};
  Broadcast::Seen seen;
  std::thread publisher([&] { broadcast.publish(Channel::kStatus, "{}"); });
  EXPECT_EQ(broadcast.wait(seen, 60s).size(), 1u);
  publisher.join();
  std::thread closer([&] { broadcast.close(); });
  EXPECT_THAT(broadcast.wait(seen, 60s), IsEmpty());
  closer.join();
  EXPECT_TRUE(broadcast.closed());
}

}  // namespace
}  // namespace trivela::pages
