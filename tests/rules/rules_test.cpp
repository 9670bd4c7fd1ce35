// The dependency rule of docs/architecture.md, the size of folders and the names that say nothing.
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

/// Who may include whom, besides itself. An entry that is longer than a module's name is for the files below it as
/// well.
const std::map<std::string, std::vector<std::string>> kMayInclude{
    {"include", {"kicking/"}},
    {"kicking", {}},
    {"idl", {}},
    {"sim", {"kicking/"}},
    {"config", {"kicking/"}},
    {"config/scenario", {"sim/"}},
    {"log", {"kicking/"}},
    {"evaluator", {"kicking/", "idl/refbox/", "log/"}},
    {"bus", {"idl/"}},
    {"hal", {"kicking/", "idl/", "config/devices.hpp"}},
    {"hal/bus", {"bus/"}},
    {"emulators", {"kicking/", "sim/", "idl/", "hal/", "config/devices.hpp"}},
    {"robot",
     {"kicking/", "config/", "idl/", "hal/kicker.hpp", "hal/wheels.hpp", "hal/range_finder.hpp",
      "hal/refbox/command.hpp"}},
    {"robot/recording", {"log/"}},
    {"monitor", {"idl/", "bus/", "robot/watch/"}},
    {"nodes", {"kicking/", "config/", "idl/", "bus/", "hal/", "robot/"}},
    {"nodes/kicker_drift", {"evaluator/drift/"}},
    {"nodes/recorder", {"log/"}},
    {"nodes/scan_recorder", {"log/"}},
    {"nodes/simulator", {"sim/", "emulators/"}},
    {"security", {"idl/", "nodes/runtime/readers.hpp"}},
    {"calibration", {"kicking/", "config/", "log/", "evaluator/", "hal/"}},
    {"experiment",
     {"kicking/", "idl/", "sim/", "config/", "log/", "evaluator/", "robot/", "emulators/sim/", "hal/wheels.hpp",
      "calibration/"}},
    {"python", {"kicking/", "sim/", "config/", "log/", "evaluator/", "calibration/", "experiment/"}},
    {"pages", {"kicking/", "idl/", "bus/", "config/", "log/", "evaluator/", "hal/", "calibration/"}},
    {"pages/monitor", {"monitor/", "robot/watch/"}},
};

const std::vector<std::string> kModules{"kicking",   "idl",     "log",         "sim",        "config",
                                        "evaluator", "bus",     "hal",         "emulators",  "robot",
                                        "monitor",   "nodes",   "calibration", "experiment", "pages",
                                        "cli",       "include", "examples",    "security",   "python"};

std::string module_of(const std::string& path) {
  const auto slash = path.find('/');
  return slash == std::string::npos ? "" : path.substr(0, slash);
}

bool may_include(const std::string& file, const std::string& target) {
  return std::ranges::any_of(kMayInclude, [&](const auto& entry) {
    return file.starts_with(entry.first + "/") && starts_with_any(target, entry.second);
  });
}

TEST(Rules, ModulesIncludeOnlyWhatTheArchitectureAllows) {
  std::vector<std::string> broken;
  for (const std::string& module : kModules) {
    if (module == "cli" || module == "examples") continue;
    for (const Include& include : includes(module)) {
      const std::string other = module_of(include.target);
      const bool ours = std::ranges::find(kModules, other) != kModules.end();
      if (ours && other != module && !may_include(include.file, include.target))
        broken.push_back(include.file + " includes " + include.target);
    }
  }
  EXPECT_THAT(broken, IsEmpty());
}

/// Folders of a module, each of which includes itself and those before it. What lies in the module itself is below all.
const std::map<std::string, std::vector<std::string>> kLayers{
    {"kicking",
     {"text", "geometry", "random", "ballistics", "model", "alignment", "outcome", "lob", "fit", "learning", "policy"}},
    {"log", {"schema", "file", "write", "read", "merge", "shards"}},
    {"evaluator",
     {"stats", "metrics", "render", "sessions", "counting", "drift", "timeline", "table2", "compare", "value",
      "drift_report", "learning", "imports", "mcap", "export", "page"}},
};

TEST(Rules, LayersOfAModuleRestOnThoseBelow) {
  std::vector<std::string> broken;
  for (const auto& entry : kLayers) {
    const std::string& module = entry.first;
    const std::vector<std::string>& layers = entry.second;
    const auto layer = [&](const std::string& path) {
      const auto begin = path.find('/') + 1, end = path.find('/', begin);
      if (end == std::string::npos) return std::ptrdiff_t{-1};
      return std::ranges::find(layers, path.substr(begin, end - begin)) - layers.begin();
    };
    for (const Include& include : includes(module)) {
      if (layer(include.file) == std::ssize(layers)) broken.push_back(include.file + " is in no layer");
      if (include.target.starts_with(module + "/") && layer(include.target) > layer(include.file))
        broken.push_back(include.file + " includes " + include.target);
    }
  }
  EXPECT_THAT(broken, IsEmpty());
}

TEST(Rules, NoFolderHasMoreThan25Files) {
  std::map<std::string, int> files;
  for (const std::string& module : kModules) {
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / module)) {
      if (entry.is_regular_file()) ++files[fs::relative(entry.path().parent_path(), kRoot).string()];
    }
  }
  std::erase_if(files, [](const auto& folder) { return folder.second <= 25; });
  EXPECT_THAT(files, IsEmpty());
}

TEST(Rules, NamesUseTheTermsOfTheField) {
  static const std::regex retired{
      R"(\b\w*(Evening|evening|Glance|Patience|OrderDesk|LabelDesk|RefereeVoice|AnyEar|Twin|Story|Stories|Casualty)\w*|\b(story|stories|desk_?|ears?_?|voices?_?|heard_\w*|Maybe)\b)"};
  std::vector<std::string> broken;
  for (const std::string& module : kModules) {
    for (const fs::path& path : sources(module)) {
      std::ifstream in{path};
      for (std::string line; std::getline(in, line);) {
        if (std::smatch word; std::regex_search(line, word, retired))
          broken.push_back(fs::relative(path, kRoot).string() + ": " + word.str());
      }
    }
  }
  EXPECT_THAT(broken, IsEmpty());
}

TEST(Rules, EveryOuterLibraryHasItsUsers) {
  const std::map<std::string, std::vector<std::string>> users_of{
      {"dds/", {"bus/", "idl/", "examples/bridge/", "examples/ros2/", "examples/vision/"}},
      {"SQLiteCpp/", {"log/"}},
      {"sqlite3.h", {"log/"}},
      {"toml++/", {"config/"}},
      {"CLI/", {"cli/", "nodes/runtime/"}},
      {"httplib.h", {"pages/serve/", "pages/labels/"}},
      {"zlib.h", {"evaluator/imports/", "evaluator/mcap/"}},
      {"openssl/", {"security/", "log/"}},
      {"pybind11/", {"python/"}},
  };
  std::vector<std::string> broken;
  for (const std::string& folder : kModules) {
    for (const Include& include : includes(folder)) {
      for (const auto& [library, users] : users_of) {
        if (include.target.starts_with(library) && !starts_with_any(include.file, users)) {
          broken.push_back(include.file + " includes " + include.target);
        }
      }
    }
  }
  EXPECT_THAT(broken, IsEmpty());
}

TEST(Rules, PureCodeKnowsNoClockThreadOrFile) {
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

TEST(Rules, FileNamesSayWhatIsInside) {
  static const std::regex empty_words{R"((^|_)(utils?|common|misc|helpers?|manager|base)(_|\.|$))"};
  std::vector<std::string> broken;
  std::vector<std::string> folders = kModules;
  folders.emplace_back("tests");
  for (const std::string& folder : folders) {
    for (const fs::path& path : sources(folder)) {
      if (std::regex_search(path.filename().string(), empty_words))
        broken.push_back(fs::relative(path, kRoot).string());
    }
  }
  EXPECT_THAT(broken, IsEmpty());
}

TEST(Rules, TheReadmeIsReadAtOneSitting) {
  std::ifstream in{kRoot / "README.md"};
  EXPECT_LT(std::count(std::istreambuf_iterator<char>{in}, {}, '\n'), 120);
}

TEST(Rules, NoTestSleeps) {
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
