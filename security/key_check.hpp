#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "security/key_folder.hpp"

namespace trivela::security {

/// What is wrong with the keys of every robot in the folder at that time, a sentence each; empty: nothing. Looks at
/// modes, owners of keys, chains, subjects, validity, signatures, authorities that are one, and whether permissions say
/// what the nodes' graph does. Needs no authority/: it works on a robot as it does at home.
std::vector<std::string> faults_of(const KeyFolder& folder, std::chrono::sys_seconds now);

}  // namespace trivela::security
