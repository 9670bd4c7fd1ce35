// The live page over real HTTP, without a bus.

#include <gmock/gmock.h>

#include <memory>

#include "pages/monitor/match_feed.hpp"
#include "pages/serve/page_server.hpp"
#include "tests/pages/stalled_viewer.hpp"
#include "tests/pages/viewer.hpp"

namespace trivela::pages {
namespace {

using testing::HasSubstr;
using testing::Not;

class MonitorPage : public testing::Test {
 protected:
  explicit MonitorPage(const std::string& token = "") : server_(monitor_page(token), broadcast_, {}) {}

  int status_of(const std::string& path, const httplib::Headers& headers = {}) const {
    httplib::Client client("127.0.0.1", server_.port());
    const auto answer = client.Get(path, headers);
    return answer ? answer->status : -1;
  }

  Broadcast broadcast_{match_channels()};
  PageServer server_;
};

TEST_F(MonitorPage, ServesItselfWithoutOtherSites) {
  for (const char* const file : {"/", "/monitor.js", "/pitch.js", "/monitor.css"}) {
    ASSERT_EQ(status_of(file), 200) << file;
    // The namespace of SVG is a name, no address.
    std::string text = get(server_.port(), file);
    if (const auto at = text.find("http://www.w3.org/2000/svg"); at != std::string::npos) text.erase(at, 26);
    EXPECT_THAT(text, Not(HasSubstr("http:/"))) << file;
    EXPECT_THAT(text, Not(HasSubstr("https:/"))) << file;
  }
  httplib::Client client("127.0.0.1", server_.port());
  EXPECT_THAT(client.Get("/")->get_header_value("Content-Security-Policy"), HasSubstr("default-src 'self'"));
}

TEST_F(MonitorPage, RefusesEveryMethodThatCouldOrderSomething) {
  httplib::Client client("127.0.0.1", server_.port());
  for (const char* const path : {"/", "/api/events", "/api/kick", "/api/verdict"}) {
    for (const char* const method : {"POST", "PUT", "DELETE", "PATCH", "OPTIONS"}) {
      httplib::Request request;
      request.method = method;
      request.path = path;
      request.headers = {{"Content-Type", "application/json"}};
      request.body = R"({"power":50})";
      const auto answer = client.send(request);
      ASSERT_TRUE(answer) << method << " " << path;
      EXPECT_EQ(answer->status, 405) << method << " " << path;
      EXPECT_EQ(answer->get_header_value("Allow"), "GET");
    }
  }
  EXPECT_EQ(status_of("/api/kick"), 404);
}

TEST_F(MonitorPage, IsForNoOtherSiteAndNoOtherName) {
  EXPECT_EQ(status_of("/", {{"Host", "evil.example"}}), 403);
  EXPECT_EQ(status_of("/api/events", {{"Host", "evil.example"}}), 403);
  EXPECT_EQ(status_of("/api/events", {{"Origin", "http://evil.example"}}), 403);
}

TEST_F(MonitorPage, SendsTheNewestOfEachChannelAndASignOfLifeWhereNothingComes) {
  broadcast_.publish(kPitch, R"({"n":1})");
  broadcast_.publish(kPitch, R"({"n":2})");
  broadcast_.publish(kMatch, R"({"n":3})");
  Viewer viewer(server_.port());
  ASSERT_TRUE(viewer.wait([&] { return viewer.events["pitch"] > 0 && viewer.events["match"] > 0; }));
  ASSERT_TRUE(viewer.wait([&] { return viewer.events[""] > 0; })) << "a comment, by which a dead line is noticed";
  ASSERT_TRUE(viewer.wait([&] { return viewer.newest["pitch"]["n"] == 2 && viewer.newest["match"]["n"] == 3; }));
  EXPECT_EQ(viewer.events["pitch"], 1) << "the first one was old";
}

TEST_F(MonitorPage, TheFortyNinthViewerIsToldThatTheRestAreHereAlready) {
  broadcast_.publish(kMatch, "{}");
  std::vector<std::unique_ptr<Viewer>> viewers;
  for (int i = 0; i < 48; ++i) viewers.push_back(std::make_unique<Viewer>(server_.port()));
  for (const auto& viewer : viewers) ASSERT_TRUE(viewer->wait([&] { return viewer->events["match"] > 0; }));
  Viewer last(server_.port());
  ASSERT_TRUE(last.wait([&] { return last.ended; }));
  EXPECT_EQ(last.status_code, 503);
  EXPECT_EQ(status_of("/"), 200) << "the page itself still comes";
  viewers.pop_back();
  bool here = false;
  for (const auto end = std::chrono::steady_clock::now() + kTimeout; !here && std::chrono::steady_clock::now() < end;) {
    Viewer next(server_.port());
    ASSERT_TRUE(next.wait([&] { return next.ended || next.events["match"] > 0; }));
    next.wait([&] { return (here = next.events["match"] > 0) || true; });
  }
  EXPECT_TRUE(here) << "who leaves makes room";
}

class MonitorPageWithToken : public MonitorPage {
 protected:
  MonitorPageWithToken() : MonitorPage("0123456789abcdef") {}
};

TEST_F(MonitorPageWithToken, GivesNothingWithoutIt) {
  for (const char* const path : {"/", "/monitor.js", "/pitch.js", "/monitor.css", "/api/events", "/nothing"}) {
    EXPECT_EQ(status_of(path), 401) << path;
    EXPECT_EQ(status_of(path + std::string("?token=0123456789abcdee")), 401) << path;
    EXPECT_EQ(status_of(path, {{"Authorization", "Bearer 0123456789abcde"}}), 401) << path;
    EXPECT_EQ(status_of(path, {{"Cookie", "trivela_1=0123456789abcdef"}}), 401) << "another server's cookie";
  }
}

TEST_F(MonitorPageWithToken, IsShownOnceInTheAddressAndThenByTheCookie) {
  EXPECT_THAT(server_.url(), testing::EndsWith("/?token=0123456789abcdef"));
  httplib::Client client("127.0.0.1", server_.port());
  const auto first = client.Get("/?token=0123456789abcdef");
  ASSERT_TRUE(first);
  EXPECT_EQ(first->status, 200);
  const std::string set = first->get_header_value("Set-Cookie");
  EXPECT_THAT(set, testing::AllOf(HasSubstr("HttpOnly"), HasSubstr("SameSite=")));
  const httplib::Headers cookie{{"Cookie", "other=1; " + set.substr(0, set.find(';'))}};
  EXPECT_EQ(status_of("/monitor.js", cookie), 200);
  EXPECT_EQ(status_of("/", {{"Authorization", "Bearer 0123456789abcdef"}}), 200) << "a program";
  broadcast_.publish(kMatch, "{}");
  Viewer viewer(server_.port(), cookie);
  EXPECT_TRUE(viewer.wait([&] { return viewer.events["match"] > 0; }));
}

}  // namespace
}  // namespace trivela::pages
