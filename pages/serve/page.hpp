#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace trivela::pages {

/// A request that cannot be answered, with the status of the HTTP answer.
struct CommandError : std::runtime_error {
  CommandError(int http_status, const std::string& sentence) : std::runtime_error(sentence), status(http_status) {}
  int status;
};

/// A file of the page, built in.
struct Asset {
  std::string path;  ///< "/page.js"
  std::string_view text;
  const char* type;
};

/// What GET answers again each time.
struct Resource {
  using Parameter = std::function<std::string(const char* name)>;  ///< of the request; empty: it has none of the name

  std::string path;
  const char* type;
  std::function<std::string(const Parameter&)> make;  ///< throws CommandError
  std::string file_name{};                            ///< under which a browser keeps it; empty: it shows it
};

/// All that a server serves.
struct Page {
  std::vector<Asset> assets;
  std::vector<Resource> resources;

  /// POST /api/NAME with arguments: throws CommandError, or nlohmann::json::exception for arguments of a wrong type.
  /// None: the page orders nothing, and the server refuses every method but GET.
  std::function<void(const std::string& name, const nlohmann::json& arguments)> command{};

  /// Without it nothing is served; empty: to everybody.
  std::string token{};

  std::size_t most_viewers = 96;  ///< who follow the events at once; one more is refused
};

}  // namespace trivela::pages
