#include "cli/team/generated_files.hpp"

#include <fmt/core.h>

#include <fstream>
#include <optional>
#include <sstream>

#include "evaluator/render/write_file.hpp"
#include "log/schema/digest.hpp"

namespace trivela::cli {
namespace {

constexpr std::string_view kSeal = "written by trivela team configure, sha256 of what follows: ";

/// None: there is no such file, or it does not read.
std::optional<std::string> written_text(const std::filesystem::path& path) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) return std::nullopt;
  std::ifstream in{path, std::ios::binary};
  std::ostringstream text;
  if (!in || !(text << in.rdbuf())) return std::nullopt;
  return text.str();
}

}  // namespace

std::string sealed(const config::TeamFile& file) {
  const bool xml = file.name.ends_with(".xml");
  return fmt::format("{} {}{}{}\n{}", xml ? "<!--" : "#", kSeal, log::sha256(file.text), xml ? " -->" : "", file.text);
}

bool is_sealed(const std::string& text) {
  const auto line = text.find('\n');
  const auto seal = text.find(kSeal);
  if (line == std::string::npos || seal == std::string::npos || seal > line) return false;
  const auto digest = seal + kSeal.size();
  return text.substr(0, line).substr(digest, 64) == log::sha256(std::string_view{text}.substr(line + 1));
}

std::vector<std::filesystem::path> edited_files(const std::vector<config::TeamFile>& files,
                                                const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> edited;
  for (const config::TeamFile& file : files) {
    std::error_code unknown;
    const std::filesystem::path path = folder / file.name;
    if (!std::filesystem::exists(std::filesystem::symlink_status(path, unknown))) continue;
    const auto text = written_text(path);
    if (!text || !is_sealed(*text)) edited.push_back(path);
  }
  return edited;
}

std::vector<std::filesystem::path> write_sealed(const std::vector<config::TeamFile>& files,
                                                const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> written;
  for (const config::TeamFile& file : files) {
    const std::filesystem::path path = folder / file.name;
    const std::string text = sealed(file);
    if (written_text(path) == text) continue;
    evaluator::replace_file(path, text, "the configuration");
    written.push_back(path);
  }
  return written;
}

}  // namespace trivela::cli
