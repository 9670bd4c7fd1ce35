#include "log/schema/digest.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>
#include <openssl/rand.h>

#include <array>
#include <charconv>
#include <stdexcept>

namespace trivela::log {
namespace {

const char* const kNone = "SHA-256 is not available in libcrypto";

std::string hexadecimal(std::span<const unsigned char> bytes) {
  std::string text;
  for (const unsigned char byte : bytes) text += fmt::format("{:02x}", byte);
  return text;
}

}  // namespace

std::string sha256(std::string_view text) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  if (EVP_Digest(text.data(), text.size(), digest.data(), &size, EVP_sha256(), nullptr) != 1) {
    throw std::runtime_error(kNone);
  }
  return hexadecimal(std::span(digest).first(size));
}

struct RunningSha256::Context {
  EVP_MD_CTX* handle = EVP_MD_CTX_new();
  ~Context() { EVP_MD_CTX_free(handle); }
};

RunningSha256::RunningSha256() : context_(std::make_unique<Context>()) { begin(); }
RunningSha256::~RunningSha256() = default;

void RunningSha256::begin() {
  if (context_->handle == nullptr || EVP_DigestInit_ex(context_->handle, EVP_sha256(), nullptr) != 1) {
    throw std::runtime_error(kNone);
  }
}

void RunningSha256::add(std::span<const unsigned char> bytes) {
  if (EVP_DigestUpdate(context_->handle, bytes.data(), bytes.size()) != 1) throw std::runtime_error(kNone);
}

std::string RunningSha256::finish() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  if (EVP_DigestFinal_ex(context_->handle, digest.data(), &size) != 1) throw std::runtime_error(kNone);
  begin();
  return hexadecimal(std::span(digest).first(size));
}

const std::string& Digests::of(const std::string& text) {
  const auto found = by_text_.find(text);
  return found != by_text_.end() ? found->second : by_text_.emplace(text, sha256(text)).first->second;
}

std::string base64(std::span<const unsigned char> bytes) {
  std::string text((bytes.size() + 2) / 3 * 4, '\0');
  EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()), bytes.data(), static_cast<int>(bytes.size()));
  return text;
}

std::string make_uuid() {
  std::array<unsigned char, 16> bytes{};
  if (RAND_bytes(bytes.data(), static_cast<int>(bytes.size())) != 1) {
    throw std::runtime_error("no random numbers for the session's UUID");
  }
  bytes[6] = static_cast<unsigned char>((bytes[6] & 0x0F) | 0x40);  // version 4
  bytes[8] = static_cast<unsigned char>((bytes[8] & 0x3F) | 0x80);  // variant of RFC 4122
  std::string text = hexadecimal(bytes);
  for (const std::size_t position : {8, 13, 18, 23}) text.insert(position, 1, '-');
  return text;
}

std::int64_t session_id_of(std::string_view uuid) {
  std::string digits;
  for (std::size_t i = 0; i < uuid.size(); ++i) {
    const bool dash = i == 8 || i == 13 || i == 18 || i == 23;
    if (!dash) digits += uuid[i];
    if (dash && uuid[i] != '-') digits.clear();
  }
  std::uint64_t head = 0;
  std::uint64_t tail = 0;
  const char* const begin = digits.data();
  if (uuid.size() != 36 || digits.size() != 32 || std::from_chars(begin, begin + 16, head, 16).ptr != begin + 16 ||
      std::from_chars(begin + 16, begin + 32, tail, 16).ptr != begin + 32) {
    throw std::runtime_error(fmt::format("'{}' is not a UUID", uuid));
  }
  return static_cast<std::int64_t>(head >> 1);
}

}  // namespace trivela::log
