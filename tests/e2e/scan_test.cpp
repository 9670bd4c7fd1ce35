// `trivela scan` and `trivela lob`: made, emulated and recorded scans, and what is said when something is wrong.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "log/write/scan_log.hpp"
#include "tests/e2e/program.hpp"
#include "tests/support/folder.hpp"

namespace trivela::e2e {
namespace {

using log::ScanReader;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

struct Said {
  int code;
  std::string output;
  std::string errors;
};

class Scan : public testing::Test {
 protected:
  Said run(const std::vector<std::string>& arguments) const {
    Program program("trivela", arguments, folder_.path());
    const int code = program.wait();
    return {code, program.output(), program.errors()};
  }

  /// Waits for the program's first line.
  std::string first_line(const Program& program) const {
    const auto whole = [&] { return program.output().find('\n') != std::string::npos; };
    if (!wait_for_change(folder_.path(), program.watch(), whole)) return "nothing: " + program.errors();
    return program.output().substr(0, program.output().find('\n'));
  }

  tests::Folder folder_;
};

TEST_F(Scan, SyntheticScansHoldWhatWasKickedAndSayThatTheyAreSynthetic) {
  const Said made =
      run({"scan", "--synthesize", "a.db", "--exit-speed-mps", "6,8", "--lobs", "1", "--truth", "truth.csv"});
  EXPECT_EQ(made.code, 0) << made.errors;
  EXPECT_THAT(made.output, HasSubstr("no public laser scan of a flying ball exists"));
  EXPECT_THAT(text_of(folder_ / "truth.csv"),
              AllOf(HasSubstr("launch_t_ns,power,exit_speed_mps"), HasSubstr(",6.000000,"),
                    HasSubstr(",8.000000,36.780000,0.250000")));
  const Said info = run({"scan", "--info", "a.db", "--json"});
  EXPECT_EQ(info.code, 0) << info.errors;
  const json found = json::parse(info.output);
  EXPECT_EQ(found["synthetic"], true);
  EXPECT_EQ(found["geometry"]["beams"], 1081);
  ASSERT_EQ(found["lobs"].size(), 2u);
  EXPECT_EQ(found["lobs"][0]["accepted"], true);
  // Effective values of a flight with drag: slower and steeper (by 1.9 to 5.3 % and 0.4 to 1.3 degrees at C_d 0.25).
  EXPECT_NEAR(found["lobs"][1]["effective"]["exit_speed_mps"], 8.0, 0.43);
  EXPECT_NEAR(found["lobs"][1]["effective"]["exit_angle_deg"], 37.6, 0.5);
  EXPECT_LT(found["bytes"].get<double>(), 2.0 * found["scans"].get<double>() * 1081);
  EXPECT_THAT(run({"scan", "--info", "a.db"}).output, HasSubstr("no public laser scan of a flying ball exists"));
}

TEST_F(Scan, TheSameSeedMakesTheSameScans) {
  for (const char* const out : {"a.db", "b.db"}) {
    ASSERT_EQ(run({"scan", "--synthesize", out, "--exit-speed-mps", "7", "--lobs", "1", "--seed", "5"}).code, 0);
  }
  ASSERT_EQ(run({"scan", "--synthesize", "c.db", "--exit-speed-mps", "7", "--lobs", "1", "--seed", "6"}).code, 0);
  const ScanReader a(folder_ / "a.db");
  const ScanReader b(folder_ / "b.db");
  const ScanReader c(folder_ / "c.db");
  ASSERT_EQ(a.size(), b.size());
  bool other = false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a.scan(i).range_mm, b.scan(i).range_mm);
    other = other || a.scan(i).range_mm != c.scan(i).range_mm;
  }
  EXPECT_TRUE(other);
}

TEST_F(Scan, AnEmulatedScannerIsRecordedUntilCtrlC) {
  ASSERT_EQ(run({"scan", "--synthesize", "a.db", "--lobs", "1", "--exit-speed-mps", "7"}).code, 0);
  for (const std::string port : {"--pty", "--tcp=0"}) {
    Program scanner("trivela", {"scan", "--emulate", "a.db", "--loop", port}, folder_.path());
    const std::string device = first_line(scanner);
    const std::string out = port + ".db";
    Program recorder("trivela", {"scan", "--record", out, "--device", device}, folder_.path());
    const auto some = [&] {
      return std::filesystem::exists(folder_ / out) && log::is_scan_log(folder_ / out) &&
             ScanReader(folder_ / out).size() >= 20;
    };
    ASSERT_TRUE(wait_for_change(folder_.path(), recorder.watch(), some)) << recorder.errors();
    recorder.signal(SIGINT);
    EXPECT_EQ(recorder.wait(), 0) << recorder.errors();
    EXPECT_THAT(recorder.output(), HasSubstr("scans of Trivela SCIP emulator"));
    const ScanReader record(folder_ / out);
    EXPECT_TRUE(record.warnings().empty());
    EXPECT_EQ(record.session().source, device);
    EXPECT_EQ(record.scan(0).range_mm, ScanReader(folder_ / "a.db").scan(0).range_mm);
    scanner.signal(SIGINT);
    EXPECT_EQ(scanner.wait(), 0);
  }
}

TEST_F(Scan, ARecordingMayBeOfSomeSeconds) {
  Program scanner("trivela", {"scan", "--emulate", "synthetic", "--tcp", "0"}, folder_.path());
  const Said said =
      run({"scan", "--record", "b.db", "--device", first_line(scanner), "--seconds", "0.5", "--power", "25"});
  EXPECT_EQ(said.code, 0) << said.errors;
  const ScanReader record(folder_ / "b.db");
  EXPECT_GE(record.size(), 10u);
  EXPECT_LE(record.size(), 25u);
  ASSERT_EQ(record.set_points().size(), 1u);
  EXPECT_EQ(record.set_points()[0].power, 25.0);
}

TEST_F(Scan, WhatIsThereIsNeverOverwritten) {
  ASSERT_EQ(run({"scan", "--synthesize", "a.db", "--lobs", "0"}).code, 0);
  const std::string before = text_of(folder_ / "a.db");
  const std::vector<std::vector<std::string>> attempts{{"scan", "--synthesize", "a.db"},
                                                       {"scan", "--record", "a.db", "--device", "/dev/null"},
                                                       {"lob", "--live", "/dev/null", "--record", "a.db"}};
  for (const auto& attempt : attempts) {
    const Said said = run(attempt);
    EXPECT_EQ(said.code, 2);
    EXPECT_THAT(said.errors, HasSubstr("a.db exists already; a recorded scan is never overwritten"));
  }
  EXPECT_EQ(text_of(folder_ / "a.db"), before);
}

TEST_F(Scan, MistakesAreNamed) {
  ASSERT_EQ(run({"scan", "--synthesize", "a.db", "--lobs", "0"}).code, 0);
  const auto expect = [&](const std::vector<std::string>& arguments, int code, const std::string& sentence) {
    const Said said = run(arguments);
    EXPECT_EQ(said.code, code) << sentence;
    EXPECT_THAT(said.errors + said.output, HasSubstr(sentence));
  };
  expect({"scan"}, 2, "Exactly 1 option");
  expect({"scan", "--info", "a.db", "--synthesize", "b.db"}, 2, "Exactly 1 option");
  expect({"scan", "--info", "none.db"}, 1, "there is no scan record none.db");
  expect({"scan", "--emulate", "none.db"}, 1, "there is no scan record none.db");
  expect({"scan", "--record", "b.db"}, 2, "--record needs --device");
  expect({"scan", "--record", "b.db", "--device", "tcp://nowhere"}, 1, "tcp://nowhere");
  expect({"scan", "--synthesize", "b.db", "--exit-speed-mps", "-3"}, 2, "--exit-speed-mps");
  expect({"scan", "--synthesize", "b.db", "--set-points", "none.toml"}, 1, "none.toml");
  expect({"lob"}, 2, "lob needs --live, --replay or --points");
  expect({"lob", "--replay", "none.db"}, 1, "there is no scan record none.db");
  expect({"lob", "--replay", "a.db", "--plan", "15,x"}, 2, "'x' is no power");
  expect({"lob", "--replay", "a.db", "--listen", "127.0.0.1:x"}, 2, "'x' is no port");
  expect({"lob", "--replay", "a.db", "--listen", "203.0.113.1"}, 1, "cannot listen on 203.0.113.1");
}

TEST_F(Scan, APageEndsWithCtrlCAndASecondOneNamesThePort) {
  ASSERT_EQ(run({"scan", "--synthesize", "a.db", "--lobs", "1", "--exit-speed-mps", "7"}).code, 0);
  Program page("trivela", {"lob", "--replay", "a.db"}, folder_.path());
  const std::string url = first_line(page);
  ASSERT_THAT(url, testing::StartsWith("http://127.0.0.1:"));
  const std::string port = url.substr(17, url.size() - 18);
  const Said second = run({"lob", "--replay", "a.db", "--port", port});
  EXPECT_EQ(second.code, 1);
  EXPECT_THAT(second.errors, HasSubstr("cannot listen on 127.0.0.1:" + port + ": Address already in use"));
  page.signal(SIGINT);
  EXPECT_EQ(page.wait(), 0) << page.errors();
}

}  // namespace
}  // namespace trivela::e2e
