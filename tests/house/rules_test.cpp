// The dependency rule of docs/architecture.md and the names that say nothing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using ::testing::IsEmpty;

const fs::path kRoot = TRIVELA_SOURCE_DIR;

struct Include {
  std::string file;    // from the root
  std::string target;  // as written, without brackets
};

std::vector<fs::path> sources(const std::string& folder) {
  std::vector<fs::path> found;
  const std::set<std::string> kinds{".hpp", ".cpp", ".h", ".c"};
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
    if (entry.is_regular_file() && kinds.contains(entry.path().extension().string())) found.push_back(entry.path());
  }
  return found;
}

std::vector<Include> includes(const std::string& folder) {
  static const std::regex pattern{R"(^\s*#include\s*[<"]([^>"]+)[>"])"};
  std::vector<Include> found;
  for (const fs::path& path : sources(folder)) {
    std::ifstream in{path};
    for (std::string line; std::getline(in, line);) {
      if (std::smatch match; std::regex_search(line, match, pattern)) {
        found.push_back({fs::relative(path, kRoot).string(), match[1]});
      }
    }
  }
  return found;
}

bool starts_with_any(const std::string& text, const std::vector<std::string>& prefixes) {
  return std::any_of(prefixes.begin(), prefixes.end(), [&](const auto& prefix) { return text.starts_with(prefix); });
}

/// Who may include whom, besides itself. An entry that is longer than a room's name is for the files below it as well.
const std::map<std::string, std::vector<std::string>> kMayInclude{
    {"include", {"kicking/"}},
    {"kicking", {}},
    {"idl", {}},
    {"sim", {"kicking/"}},
    {"config", {"kicking/"}},
    {"config/scenario", {"sim/"}},
    {"refbox", {}},
    {"evaluator", {"kicking/", "refbox/"}},
    {"bus", {"idl/"}},
    {"hal", {"kicking/", "refbox/", "idl/", "config/devices.hpp"}},
    {"hal/bus", {"bus/"}},
    {"emulators", {"kicking/", "refbox/", "sim/", "idl/", "hal/", "config/devices.hpp"}},
    {"robot",
     {"kicking/", "config/", "idl/", "hal/kicker.hpp", "hal/wheels.hpp", "hal/range_finder.hpp",
      "hal/refbox/command.hpp"}},
    {"robot/recording", {"evaluator/log/"}},
    {"monitor", {"idl/", "bus/", "robot/watch/"}},
    {"nodes", {"kicking/", "config/", "idl/", "bus/", "hal/", "robot/"}},
    {"nodes/kicker_drift", {"evaluator/drift/"}},
    {"nodes/recorder", {"evaluator/log/"}},
    {"nodes/scan_recorder", {"evaluator/log/"}},
    {"nodes/simulator", {"sim/", "emulators/"}},
    {"security", {"idl/", "nodes/runtime/readers.hpp"}},
    {"calibration", {"kicking/", "config/", "evaluator/", "hal/"}},
    {"experiment",
     {"kicking/", "idl/", "sim/", "config/", "evaluator/", "robot/", "emulators/sim/", "hal/wheels.hpp",
      "calibration/"}},
    {"pages", {"kicking/", "idl/", "bus/", "config/", "evaluator/", "hal/", "calibration/"}},
    {"pages/monitor", {"monitor/", "robot/watch/"}},
};

const std::vector<std::string> kRooms{"kicking",   "refbox",  "idl",         "sim",        "config",
                                      "evaluator", "bus",     "hal",         "emulators",  "robot",
                                      "monitor",   "nodes",   "calibration", "experiment", "pages",
                                      "cli",       "include", "examples",    "security"};

std::string room_of(const std::string& path) {
  const auto slash = path.find('/');
  return slash == std::string::npos ? "" : path.substr(0, slash);
}

bool may_include(const std::string& file, const std::string& target) {
  return std::ranges::any_of(kMayInclude, [&](const auto& entry) {
    return file.starts_with(entry.first + "/") && starts_with_any(target, entry.second);
  });
}

TEST(House, RoomsIncludeOnlyWhatTheArchitectureAllows) {
  std::vector<std::string> broken;
  for (const std::string& room : kRooms) {
    if (room == "cli" || room == "examples") continue;
    for (const Include& include : includes(room)) {
      const std::string other = room_of(include.target);
      const bool ours = std::ranges::find(kRooms, other) != kRooms.end();
      if (ours && other != room && !may_include(include.file, include.target))
        broken.push_back(include.file + " includes " + include.target);
    }
  }
  EXPECT_THAT(broken, IsEmpty());
}

TEST(House, StoreysOfKickingRestOnThoseBelow) {
  const std::vector<std::string> storeys{"text",      "geometry", "random", "ballistics", "model",
                                         "alignment", "outcome",  "lob",    "fit",        "policy"};
  // What lies in kicking/ itself is below them all.
  const auto storey = [&](const std::string& path) {
    const auto begin = path.find('/') + 1, end = path.find('/', begin);
    if (end == std::string::npos) return std::ptrdiff_t{-1};
    return std::find(storeys.begin(), storeys.end(), path.substr(begin, end - begin)) - storeys.begin();
  };
  std::vector<std::string> broken;
  for (const Include& include : includes("kicking")) {
    if (storey(include.file) == std::ssize(storeys)) broken.push_back(include.file + " is in no storey");
    if (include.target.starts_with("kicking/") && storey(include.target) > storey(include.file))
      broken.push_back(include.file + " includes " + include.target);
  }
  EXPECT_THAT(broken, IsEmpty());
}

TEST(House, EveryOuterLibraryHasOneDoor) {
  const std::map<std::string, std::vector<std::string>> doors{
      {"dds/", {"bus/", "idl/", "examples/bridge/", "examples/ros2/", "examples/vision/"}},
      {"SQLiteCpp/", {"evaluator/log/"}},
      {"sqlite3.h", {"evaluator/log/"}},
      {"toml++/", {"config/"}},
      {"CLI/", {"cli/", "nodes/runtime/"}},
      {"httplib.h", {"pages/serve/", "pages/labels/"}},
      {"zlib.h", {"evaluator/imports/", "evaluator/mcap/"}},
      {"openssl/", {"security/", "evaluator/log/"}},
  };
  std::vector<std::string> broken;
  for (const std::string& folder : kRooms) {
    for (const Include& include : includes(folder)) {
      for (const auto& [library, users] : doors) {
        if (include.target.starts_with(library) && !starts_with_any(include.file, users)) {
          broken.push_back(include.file + " includes " + include.target);
        }
      }
    }
  }
  EXPECT_THAT(broken, IsEmpty());
}

TEST(House, PureCodeKnowsNoClockThreadOrFile) {
  std::vector<std::string> broken;
  for (const std::string folder : {"kicking", "sim"}) {
    for (const Include& include : includes(folder)) {
      for (const std::string banned :
           {"chrono", "thread", "mutex", "fstream", "filesystem", "iostream", "random", "ctime"}) {
        if (include.target == banned) broken.push_back(include.file + " includes <" + banned + ">");
      }
    }
  }
  EXPECT_THAT(broken, IsEmpty());
}

TEST(House, FileNamesSayWhatIsInside) {
  static const std::regex empty_words{R"((^|_)(utils?|common|misc|helpers?|manager|base)(_|\.|$))"};
  std::vector<std::string> broken;
  std::vector<std::string> folders = kRooms;
  folders.emplace_back("tests");
  for (const std::string& folder : folders) {
    for (const fs::path& path : sources(folder)) {
      if (std::regex_search(path.filename().string(), empty_words))
        broken.push_back(fs::relative(path, kRoot).string());
    }
  }
  EXPECT_THAT(broken, IsEmpty());
}

TEST(House, TheReadmeIsReadAtOneSitting) {
  std::ifstream in{kRoot / "README.md"};
  EXPECT_LT(std::count(std::istreambuf_iterator<char>{in}, {}, '\n'), 120);
}

TEST(House, NoTestSleeps) {
  static const std::regex sleep{R"(sleep_for|sleep_until|usleep|nanosleep)"};
  std::vector<std::string> broken;
  for (const fs::path& path : sources("tests")) {
    // A benchmark keeps a pace by the clock; it asserts nothing.
    if (path.filename() == "rules_test.cpp" || fs::relative(path, kRoot).string().starts_with("tests/bench/")) continue;
    std::ifstream in{path};
    for (std::string line; std::getline(in, line);) {
      if (std::regex_search(line, sleep)) broken.push_back(fs::relative(path, kRoot).string() + ": " + line);
    }
  }
  EXPECT_THAT(broken, IsEmpty());
}

}  // namespace
