#pragma once

#include <stdlib.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include "security/key_folder.hpp"

namespace trivela::security {

/// A temporary folder with the keys of a team, which go with the object.
class TeamKeys {
 public:
  explicit TeamKeys(const Validity& validity = days_from(this_second(), 9)) {
    std::string pattern = (std::filesystem::temp_directory_path() / "trivela_team_keys_XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error{"cannot make the folder " + pattern};
    path_ = pattern;
    keys().init(validity);
  }
  TeamKeys(const TeamKeys&) = delete;
  TeamKeys& operator=(const TeamKeys&) = delete;
  ~TeamKeys() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  KeyFolder keys() const { return KeyFolder{path_}; }
  std::filesystem::path robot(std::uint32_t robot_id) const { return keys().robot_folder(robot_id); }
  std::filesystem::path authority() const { return path_ / "authority"; }

 private:
  std::filesystem::path path_;
};

}  // namespace trivela::security
