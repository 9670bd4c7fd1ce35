// The page that labels kicks, asked as a browser asks it.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <httplib.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <thread>

#include "pages/labels/label_server.hpp"
#include "tests/evaluator/match_fixture.hpp"

namespace trivela::pages {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class LabelPage : public evaluator::LogTest {
 protected:
  LabelPage() {
    {
      evaluator::MatchLog match(path(), session(), options());
      match.kicks(1, "on_target", 1);
      match.truth(match.kick(1, "unknown"), "bar");
      match.close();
    }
    controller_.emplace(path());
    server_.emplace(*controller_, 0);
    host_ = "127.0.0.1:" + std::to_string(server_->port());
  }

  json kicks() { return json::parse(httplib::Client("http://" + host_).Get("/api/kicks")->body); }

  json label(int place, const json& outcome, const std::string& who = "Ada") {
    const json kick = kicks()["kicks"][place];
    return {{"session_id", kick["session_id"]},
            {"kick_id", kick["kick_id"]},
            {"robot", kick["robot"]},
            {"outcome", outcome},
            {"who", who},
            {"note", ""}};
  }

  httplib::Headers headers() const { return {{"Origin", "http://" + host_}, {"X-Trivela-Token", server_->token()}}; }

  /// Status and body.
  std::pair<int, std::string> post(const std::string& body, const httplib::Headers& headers,
                                   const std::string& type = "application/json") {
    const auto answer = httplib::Client("http://" + host_).Post("/api/label", headers, body, type);
    return {answer->status, answer->body};
  }

  std::int64_t labels() const { return rows_of(log::Reader(path()), "labels"); }

  std::optional<LabelStore> controller_;
  std::optional<LabelServer> server_;
  std::string host_;
};

TEST_F(LabelPage, WritesARowForWhoHasTheToken) {
  const auto [status, body] = post(label(1, "over").dump(), headers());
  EXPECT_EQ(status, 200) << body;
  EXPECT_EQ(json::parse(body)["kicks"][1]["by_hand"], "over");
  EXPECT_EQ(labels(), 1);
  EXPECT_EQ(post(label(1, nullptr).dump(), headers()).first, 200);
  EXPECT_TRUE(kicks()["kicks"][1]["by_hand"].is_null());
  EXPECT_EQ(labels(), 2) << "withdrawing is a row, too";
}

TEST_F(LabelPage, RefusesWhoHasNotTheTokenOrComesFromElsewhere) {
  const std::string body = label(1, "over").dump();
  httplib::Headers wrong = headers();
  wrong.erase("X-Trivela-Token");
  EXPECT_EQ(post(body, wrong).first, 403);
  wrong.emplace("X-Trivela-Token", "0" + server_->token().substr(1) + "0");
  EXPECT_EQ(post(body, wrong).first, 403);
  wrong = headers();
  wrong.erase("Origin");
  EXPECT_EQ(post(body, wrong).first, 403);
  wrong.emplace("Origin", "http://evil.example");
  EXPECT_EQ(post(body, wrong).first, 403);
  EXPECT_EQ(post(body, headers(), "text/plain").first, 415);
  EXPECT_EQ(labels(), 0);
}

TEST_F(LabelPage, RefusesAnotherHostsName) {
  for (const std::string host : {"evil.example", "127.0.0.1.evil.example:80", "127.0.0.1", "localhost:1"}) {
    for (const char* const path : {"/", "/api/kicks", "/api/timeline?i=0"})
      EXPECT_EQ(httplib::Client("http://" + host_).Get(path, httplib::Headers{{"Host", host}})->status, 403) << host;
  }
  const auto by_name = httplib::Client("http://" + host_)
                           .Get("/", httplib::Headers{{"Host", "localhost:" + std::to_string(server_->port())}});
  EXPECT_EQ(by_name->status, 200);
}

TEST_F(LabelPage, RefusesLabelsThatMakeNoSense) {
  for (const std::string& body :
       std::vector<std::string>{"", "[]", "null", "{}", "{\"kick_id\": 1}", label(1, "in").dump(), label(1, 7).dump(),
                                label(1, "over", " ").dump(), label(1, nullptr).dump(),
                                label(1, "over", std::string(300, 'a')).dump(), std::string(5000, '[')}) {
    const auto [status, said] = post(body, headers());
    EXPECT_EQ(status, 400) << body;
    EXPECT_THAT(said, HasSubstr("error"));
  }
  json other = label(1, "over");
  other["robot"] = 9;
  EXPECT_EQ(post(other.dump(), headers()).first, 400);
  EXPECT_EQ(labels(), 0);
}

TEST_F(LabelPage, TellsTheStoryWithoutTheSimulatorsTruth) {
  const auto timeline = httplib::Client("http://" + host_).Get("/api/timeline?i=1");
  EXPECT_EQ(timeline->status, 200);
  EXPECT_EQ(json::parse(timeline->body)["kick"], "1:2");
  EXPECT_FALSE(json::parse(timeline->body).contains("truth"));
  for (const char* const wrong : {"/api/timeline", "/api/timeline?i=-1", "/api/timeline?i=two", "/api/timeline?i=2"})
    EXPECT_GE(httplib::Client("http://" + host_).Get(wrong)->status, 400) << wrong;
}

TEST_F(LabelPage, RunsNoScriptButItsOwn) {
  const auto page = httplib::Client("http://" + host_).Get("/");
  EXPECT_THAT(page->get_header_value("Content-Security-Policy"), HasSubstr("default-src 'none'; script-src 'self'"));
  EXPECT_THAT(page->body, testing::Not(HasSubstr(server_->token())));
  EXPECT_THAT(server_->url(), testing::EndsWith("/#" + server_->token()));
}

/// Connections that have begun a request and do not go on.
class SlowClients {
 public:
  SlowClients(int port, int count) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<in_port_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    for (int i = 0; i < count; ++i) {
      sockets_.push_back(::socket(AF_INET, SOCK_STREAM, 0));
      EXPECT_EQ(::connect(sockets_.back(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
      EXPECT_EQ(::send(sockets_.back(), "GET", 3, MSG_NOSIGNAL), 3);
    }
  }
  SlowClients(const SlowClients&) = delete;
  SlowClients& operator=(const SlowClients&) = delete;
  ~SlowClients() {
    for (const int socket : sockets_) ::close(socket);
  }

  /// A byte more of each request, which keeps the server waiting.
  void trickle() const {
    for (const int socket : sockets_) ::send(socket, "x", 1, MSG_NOSIGNAL);
  }

 private:
  std::vector<int> sockets_;
};

TEST_F(LabelPage, IsNotHeldUpByConnectionsThatSayNothing) {
  const SlowClients slow{server_->port(), 200};
  httplib::Client client("http://" + host_);
  client.set_read_timeout(std::chrono::milliseconds{1500});  // less than the server waits for each of them
  for (int i = 0; i < 3; ++i) {
    const auto answer = client.Get("/api/kicks");
    ASSERT_TRUE(answer) << i;
    EXPECT_EQ(answer->status, 200);
    slow.trickle();
  }
}

TEST_F(LabelPage, EndsWhileConnectionsTrickle) {
  const SlowClients slow{server_->port(), 20};
  std::atomic<bool> over = false;
  std::thread writer{[&] {
    while (!over) {
      slow.trickle();
      std::this_thread::yield();
    }
  }};
  server_.reset();
  over = true;
  writer.join();
}

TEST_F(LabelPage, OfATakenPortIsRefused) {
  EXPECT_THROW(LabelServer(*controller_, server_->port()), std::runtime_error);
}

}  // namespace
}  // namespace trivela::pages
