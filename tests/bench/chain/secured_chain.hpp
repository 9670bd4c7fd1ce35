#pragma once

#include <filesystem>

#include "tests/bench/chain/dds_chain.hpp"

namespace trivela::bench {

/// A folder for keys, which goes with the run.
class TemporaryKeys {
 public:
  TemporaryKeys();
  TemporaryKeys(const TemporaryKeys&) = delete;
  TemporaryKeys& operator=(const TemporaryKeys&) = delete;
  ~TemporaryKeys();
  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

/// What DDS Security protects of every topic, each NONE, SIGN or ENCRYPT: the packet, the parts of a topic in it
/// (samples, heartbeats, acknowledgements), the payload.
struct Protection {
  const char* packet;
  const char* parts;
  const char* payload;
};

/// With keys of this run for the four nodes of robot 1, in that folder of their own. `protection`: in place of what a
/// robot's own bus has; nullptr: that.
DomainOf secured(int index, const std::filesystem::path& folder, const Protection* protection = nullptr);

}  // namespace trivela::bench
