#pragma once

#include <fmt/core.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace trivela::cli {

/// A configuration in a file of its own, gone with the object.
class ConfigFile {
 public:
  /// Throws std::runtime_error naming the file that cannot be written.
  explicit ConfigFile(const std::string& text) {
    std::string name = (std::filesystem::temp_directory_path() / "trivela-XXXXXX.toml").string();
    const int descriptor = mkstemps(name.data(), 5);
    if (descriptor < 0) throw std::runtime_error{fmt::format("cannot write the configuration to {}", name)};
    close(descriptor);
    path_ = name;
    std::ofstream out{path_};
    if (!(out << text) || !out.flush())
      throw std::runtime_error{fmt::format("cannot write the configuration to {}", name)};
  }
  ConfigFile(const ConfigFile&) = delete;
  ConfigFile& operator=(const ConfigFile&) = delete;
  ~ConfigFile() { std::filesystem::remove(path_); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace trivela::cli
