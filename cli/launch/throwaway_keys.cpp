#include "cli/launch/throwaway_keys.hpp"

#include <fmt/core.h>
#include <stdlib.h>

#include <cerrno>
#include <system_error>

#include "cli/verbs.hpp"
#include "nodes/runtime/node_flags.hpp"
#include "security/key_folder.hpp"
#include "security/rights.hpp"

namespace trivela::cli {

ThrowawayKeys::ThrowawayKeys(std::uint32_t robot_id) {
  std::string pattern = (std::filesystem::temp_directory_path() / "trivela_keys_XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw std::system_error{errno, std::generic_category(), pattern};
  folder_ = pattern;
  const security::KeyFolder keys{folder_};
  const security::Validity today = security::days_from(security::this_second(), 1);
  keys.init(today);
  std::vector<std::string> every;
  for (const security::Rights& rights : security::all_rights()) every.push_back(rights.node);
  keys.issue(robot_id, every, today);
}

ThrowawayKeys::~ThrowawayKeys() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

std::unique_ptr<ThrowawayKeys> secure_children(const std::string& folder, std::uint32_t robot_id) {
  if (folder.empty()) {
    auto keys = std::make_unique<ThrowawayKeys>(robot_id);
    setenv(nodes::kKeysVariable, keys->folder().c_str(), 1);
    return keys;
  }
  const auto faults = security::faults_of(security::KeyFolder{folder}, security::this_second());
  if (!faults.empty()) throw UsageError{fmt::format("--secure: {}", faults.front())};
  setenv(nodes::kKeysVariable, std::filesystem::absolute(folder).c_str(), 1);
  return nullptr;
}

}  // namespace trivela::cli
