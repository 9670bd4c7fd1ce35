#pragma once

#include <stdlib.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include "security/key_folder.hpp"
#include "tests/support/folder.hpp"

namespace trivela::security {

/// A temporary folder with the keys of a team, which go with the object.
class TeamKeys {
 public:
  explicit TeamKeys(const Validity& validity = days_from(this_second(), 9)) { keys().init(validity); }

  KeyFolder keys() const { return KeyFolder{path_}; }
  std::filesystem::path robot(std::uint32_t robot_id) const { return keys().robot_folder(robot_id); }
  std::filesystem::path authority() const { return path_ / "authority"; }

 private:
  tests::Folder path_;
};

}  // namespace trivela::security
