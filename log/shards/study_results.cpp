#include "log/shards/study_results.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "log/file/new_file.hpp"
#include "log/schema/digest.hpp"

namespace trivela::log {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kResultsGroup{500};  // of matches that are written together
constexpr std::size_t kArmLetters = 16;

std::runtime_error failed(const fs::path& path, const char* what) {
  return std::runtime_error(fmt::format("{}: {}: {}", path.string(), what, std::generic_category().message(errno)));
}

/// What the whole lines of a file say. A last line that was cut off says nothing.
struct Kept {
  std::string text;
  std::string arguments{};
  std::map<std::string, MatchesByNumber> arms{};

  explicit Kept(const fs::path& path) {
    std::ifstream file{path, std::ios::binary};
    if (!file) throw failed(path, "results cannot be read");
    text.resize(kStudyResultsBegin.size());
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(file.gcount()));
    if (text != kStudyResultsBegin) return;  // a match log may be large
    text.append(std::istreambuf_iterator<char>{file}, {});
    std::istringstream lines{text.substr(0, text.rfind('\n') + 1)};
    std::string line;
    for (std::getline(lines, line); std::getline(lines, line);) {
      if (line.starts_with("= ")) {
        arguments += line.substr(2) + '\n';
        continue;
      }
      std::istringstream words{line};
      std::string arm;
      std::uint32_t match_id = 0;
      MatchTally tally;
      words >> arm >> match_id >> tally.calibration;
      for (const TallyField& count : kTallyFields) words >> tally.*count.field;
      if (!words || !words.eof()) throw std::runtime_error(fmt::format("{}: is damaged: {:.99}", path.string(), line));
      arms[arm][match_id] = tally;
    }
  }
};

}  // namespace

StudyResults::StudyResults(const fs::path& path, const std::string& arguments) : arguments_(arguments) {
  if (!path.empty()) save(path);
}

StudyResults::~StudyResults() {
  if (file_ >= 0) ::close(file_);
}

void StudyResults::save(const fs::path& path) {
  path_ = path;
  file_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (file_ < 0) throw failed(path, "results cannot be written");
  const auto taken = [&](const char* why) { return FileTaken(fmt::format("{}: {}", path.string(), why)); };
  if (!fs::is_regular_file(path)) throw taken("is no file");
  if (::flock(file_, LOCK_EX | LOCK_NB) != 0) {
    if (errno == EWOULDBLOCK) throw taken("another run writes to it");
    throw failed(path, "results cannot be locked");
  }
  std::string head{kStudyResultsBegin};
  std::istringstream lines{arguments_};
  for (std::string line; std::getline(lines, line);) head += "= " + line + '\n';
  Kept kept{path};
  const bool begins = head.starts_with(kept.text);  // it is new, or was cut off when it began
  if (!begins && !kept.text.starts_with(kStudyResultsBegin))
    throw taken("is there already and has no study results of this version; choose another file");
  if (!begins && kept.arguments != arguments_) throw other_arguments(path, "a study", kept.arguments, arguments_);
  const std::size_t whole_bytes = begins ? 0 : kept.text.rfind('\n') + 1;
  if (::ftruncate(file_, static_cast<off_t>(whole_bytes)) != 0) throw failed(path, "results cannot be written");
  if (begins) unwritten_.insert(0, head);
  arms_.merge(kept.arms);
  commit();
}

void StudyResults::take_over(const fs::path& path) {
  const auto refused = [&](const std::string& why) { return std::runtime_error(path.string() + ": " + why); };
  const Kept other{path};
  if (!other.text.starts_with(kStudyResultsBegin)) throw refused("has no study results of this version");
  if (other.arguments != arguments_) throw refused("has results of another study");
  for (const auto& [arm, matches] : other.arms)
    for (const auto& [match_id, tally] : matches)
      if (const auto known = arms_[arm].find(match_id); known != arms_[arm].end() && known->second != tally)
        throw refused(fmt::format("says something else of match {} than the other results", match_id));
  for (const auto& [arm, matches] : other.arms)
    for (const auto& [match_id, tally] : matches)
      if (!arms_[arm].contains(match_id)) add(arm, match_id, tally);
  commit();
}

std::string StudyResults::arm(const std::string& text) { return sha256(text).substr(0, kArmLetters); }

void StudyResults::add(const std::string& arm, std::uint32_t match_id, const MatchTally& tally) {
  arms_[arm][match_id] = tally;
  unwritten_ += fmt::format("{} {} {}", arm, match_id, tally.calibration);
  for (const TallyField& count : kTallyFields) unwritten_ += fmt::format(" {}", tally.*count.field);
  unwritten_ += '\n';
  if (std::chrono::steady_clock::now() - written_at_ >= kResultsGroup) commit();
}

std::size_t StudyResults::size() const {
  std::size_t matches = 0;
  for (const auto& [arm, played] : arms_) matches += played.size();
  return matches;
}

void StudyResults::commit() {
  written_at_ = std::chrono::steady_clock::now();
  if (file_ < 0) return;
  while (!unwritten_.empty()) {
    const ssize_t written_bytes = ::write(file_, unwritten_.data(), unwritten_.size());
    if (written_bytes < 0) throw failed(path_, "results could not be written");
    unwritten_.erase(0, static_cast<std::size_t>(written_bytes));
  }
  if (::fdatasync(file_) != 0) throw failed(path_, "results could not be written");
}

}  // namespace trivela::log
