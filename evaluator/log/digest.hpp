#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace trivela::evaluator::log {

/// SHA-256 of `text` (FIPS 180-4) as 64 lower case hexadecimal digits.
std::string sha256(std::string_view text);

/// sha256() that remembers: for a few long texts that come again and again.
class Digests {
 public:
  const std::string& of(const std::string& text);

 private:
  std::map<std::string, std::string> by_text_;
};

/// A random UUID of version 4 (RFC 4122). Throws std::runtime_error where the system gives no random numbers.
std::string make_uuid();

/// The first 63 bits of a UUID: the key `session_id`, alike on every robot that merges the log.
/// Throws std::runtime_error where `uuid` is not 8-4-4-4-12 hexadecimal digits.
std::int64_t session_id_of(std::string_view uuid);

}  // namespace trivela::evaluator::log
