#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace trivela::log {

/// SHA-256 of `text` (FIPS 180-4) as 64 lower case hexadecimal digits.
std::string sha256(std::string_view text);

/// SHA-256 of bytes that come piece by piece.
class RunningSha256 {
 public:
  /// Throws std::runtime_error where libcrypto has no SHA-256.
  RunningSha256();
  ~RunningSha256();
  RunningSha256(const RunningSha256&) = delete;
  RunningSha256& operator=(const RunningSha256&) = delete;

  void add(std::span<const unsigned char> bytes);

  /// 64 lower case hexadecimal digits; afterwards it begins again.
  std::string finish();

 private:
  void begin();
  struct Context;
  std::unique_ptr<Context> context_;
};

/// sha256() that remembers: for a few long texts that come again and again.
class Digests {
 public:
  const std::string& of(const std::string& text);

 private:
  std::map<std::string, std::string> by_text_;
};

/// Bytes in base 64 (RFC 4648).
std::string base64(std::span<const unsigned char> bytes);

/// A random UUID of version 4 (RFC 4122). Throws std::runtime_error where the system gives no random numbers.
std::string make_uuid();

/// The first 63 bits of a UUID: the key `session_id`, alike on every robot that merges the log.
/// Throws std::runtime_error where `uuid` is not 8-4-4-4-12 hexadecimal digits.
std::int64_t session_id_of(std::string_view uuid);

}  // namespace trivela::log
