// The dependency rule of docs/architecture.md and the names that say nothing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
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

const std::vector<std::string> kFolders{"kicking", "sim", "bus", "evaluator", "config", "hal", "nodes", "cli"};

TEST(House, FoldersIncludeOnlyWhatTheArchitectureAllows) {
  const std::map<std::string, std::vector<std::string>> allowed{
      {"kicking", {"kicking/"}},
      {"sim", {"sim/", "kicking/"}},
      {"bus", {"bus/", "idl/"}},
      {"evaluator", {"evaluator/", "kicking/"}},
      {"config", {"config/", "kicking/", "sim/"}},
      {"hal", {"hal/", "kicking/", "sim/", "bus/", "evaluator/log/"}},
      {"nodes", {"nodes/", "kicking/", "sim/", "bus/", "evaluator/", "config/", "hal/"}},
  };
  std::vector<std::string> broken;
  for (const auto& [folder, prefixes] : allowed) {
    for (const Include& include : includes(folder)) {
      const auto slash = include.target.find('/');
      const std::string top = slash == std::string::npos ? "" : include.target.substr(0, slash);
      const bool ours = std::find(kFolders.begin(), kFolders.end(), top) != kFolders.end();
      if (ours && !starts_with_any(include.target, prefixes))
        broken.push_back(include.file + " includes " + include.target);
    }
  }
  EXPECT_THAT(broken, IsEmpty());
}

TEST(House, EveryOuterLibraryHasOneDoor) {
  const std::map<std::string, std::vector<std::string>> doors{
      {"dds/", {"bus/", "idl/"}},
      {"SQLiteCpp/", {"evaluator/log/"}},
      {"sqlite3.h", {"evaluator/log/"}},
      {"toml++/", {"config/"}},
      {"CLI/", {"cli/", "nodes/runtime/"}},
      {"bus/", {"bus/", "hal/sim/", "nodes/"}},
      {"evaluator/log/", {"evaluator/", "hal/replay/", "nodes/recorder/", "nodes/scan_recorder/", "cli/"}},
      {"httplib.h", {"cli/lob_page/"}},
  };
  std::vector<std::string> broken;
  for (const std::string& folder : kFolders) {
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
  std::vector<std::string> folders = kFolders;
  folders.emplace_back("tests");
  for (const std::string& folder : folders) {
    for (const fs::path& path : sources(folder)) {
      if (std::regex_search(path.filename().string(), empty_words))
        broken.push_back(fs::relative(path, kRoot).string());
    }
  }
  EXPECT_THAT(broken, IsEmpty());
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
