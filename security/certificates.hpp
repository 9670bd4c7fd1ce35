#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace trivela::security {

/// From when to when something holds, UTC.
struct Validity {
  std::chrono::sys_seconds from;
  std::chrono::sys_seconds to;

  bool operator==(const Validity&) const = default;
  bool holds(std::chrono::sys_seconds now) const { return from <= now && now < to; }
};

inline std::chrono::sys_seconds this_second() {
  return std::chrono::time_point_cast<std::chrono::seconds>(std::chrono::system_clock::now());
}

/// From an hour ago, for robots whose clocks are behind, for so many days.
inline Validity days_from(std::chrono::sys_seconds now, int days) {
  return {now - std::chrono::hours{1}, now + std::chrono::days{days}};
}

}  // namespace trivela::security

struct evp_pkey_st;
struct x509_st;

namespace trivela::security {

struct CryptoFree {
  void operator()(evp_pkey_st* key) const noexcept;
  void operator()(x509_st* certificate) const noexcept;
};
using Key = std::unique_ptr<evp_pkey_st, CryptoFree>;
using Certificate = std::unique_ptr<x509_st, CryptoFree>;

// All of these throw std::runtime_error with OpenSSL's reason where it refuses.

/// A new private key on the curve P-256.
Key new_key();

/// A certificate authority: signed by its own key; may sign identities, and no further authority.
Certificate new_authority(const Key& key, std::string_view name, const Validity& validity);

/// An identity "O=Trivela,CN=name" signed by the authority, of the public half of `key`.
Certificate new_identity(const Key& key, std::string_view name, const Validity& validity, const Certificate& authority,
                         const Key& authority_key);

std::string pem_of(const Key& key);
std::string pem_of(const Certificate& certificate);
/// Throw std::runtime_error naming the file that cannot be read or holds none.
Key read_key(const std::filesystem::path& file);
Certificate read_certificate(const std::filesystem::path& file);

/// The text as an S/MIME document that the authority's own key signed.
std::string signed_document(const std::string& text, const Certificate& authority, const Key& authority_key);

/// The text of such a document; none: it is not signed by the authority's own key. Stricter than Cyclone 0.10.2, which
/// takes the signature of whatever certificate the authority issued (CVE-2023-24011).
std::optional<std::string> verified_text(const std::string& document, const Certificate& authority);

/// "O=Trivela,CN=kick_decision.1".
std::string subject_of(const Certificate& certificate);
Validity validity_of(const Certificate& certificate);
bool belongs(const Key& key, const Certificate& certificate);
bool is_signed_by(const Certificate& certificate, const Certificate& authority);
bool same_public_key(const Certificate& a, const Certificate& b);

}  // namespace trivela::security
