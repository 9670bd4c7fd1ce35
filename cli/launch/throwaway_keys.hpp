#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace trivela::cli {

/// Keys of a robot in a private temporary folder, which goes with the object.
class ThrowawayKeys {
 public:
  /// For every kind of node. Throws std::system_error where no folder can be made.
  explicit ThrowawayKeys(std::uint32_t robot_id);
  ThrowawayKeys(const ThrowawayKeys&) = delete;
  ThrowawayKeys& operator=(const ThrowawayKeys&) = delete;
  ~ThrowawayKeys();

  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

/// From now on the nodes that this process starts join the bus with the keys in the folder. An empty name: with keys
/// made for the purpose, which the result keeps. Throws UsageError naming what is wrong with the folder's keys.
std::unique_ptr<ThrowawayKeys> secure_children(const std::string& folder, std::uint32_t robot_id);

}  // namespace trivela::cli
