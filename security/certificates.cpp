#include "security/certificates.hpp"

#include <fmt/core.h>
#include <openssl/bio.h>
#include <openssl/ec.h>
#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/pkcs7.h>
#include <openssl/rand.h>
#include <openssl/x509v3.h>

#include <array>
#include <ctime>
#include <stdexcept>

namespace trivela::security {
namespace {

template <auto kFree>
struct Freeing {
  void operator()(auto* thing) const noexcept { kFree(thing); }
};
using Bio = std::unique_ptr<BIO, Freeing<BIO_free_all>>;
using Pkcs7 = std::unique_ptr<PKCS7, Freeing<PKCS7_free>>;
using Store = std::unique_ptr<X509_STORE, Freeing<X509_STORE_free>>;
using Extension = std::unique_ptr<X509_EXTENSION, Freeing<X509_EXTENSION_free>>;

[[noreturn]] void refuse(const char* call) {
  std::array<char, 256> reason{};
  ERR_error_string_n(ERR_get_error(), reason.data(), reason.size());
  throw std::runtime_error{fmt::format("{}: {}", call, reason.data())};
}

template <class T>
T need(T result, const char* call) {
  if (!result) refuse(call);
  return result;
}

Bio memory(const std::string& text) {
  return Bio{need(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())), "BIO_new_mem_buf")};
}

Bio memory() { return Bio{need(BIO_new(BIO_s_mem()), "BIO_new")}; }

std::string text_of(const Bio& bio) {
  char* data = nullptr;
  const long size = BIO_get_mem_data(bio.get(), &data);
  return {data, static_cast<std::size_t>(size)};
}

void extend(X509* certificate, X509* issuer, int kind, const char* value) {
  X509V3_CTX context;
  X509V3_set_ctx(&context, issuer, certificate, nullptr, nullptr, 0);
  const Extension extension{need(X509V3_EXT_conf_nid(nullptr, &context, kind, value), "X509V3_EXT_conf_nid")};
  need(X509_add_ext(certificate, extension.get(), -1), "X509_add_ext");
}

/// Unsigned, with a number that no other certificate has.
Certificate blank(const Key& key, std::string_view name, const Validity& validity) {
  Certificate certificate{need(X509_new(), "X509_new")};
  std::uint64_t number = 0;
  need(RAND_bytes(reinterpret_cast<unsigned char*>(&number), sizeof number) == 1, "RAND_bytes");
  need(X509_set_version(certificate.get(), 2), "X509_set_version");  // the third
  need(ASN1_INTEGER_set_uint64(X509_get_serialNumber(certificate.get()), number >> 1 | 1), "ASN1_INTEGER_set_uint64");
  need(ASN1_TIME_set(X509_getm_notBefore(certificate.get()), std::chrono::system_clock::to_time_t(validity.from)),
       "ASN1_TIME_set");
  need(ASN1_TIME_set(X509_getm_notAfter(certificate.get()), std::chrono::system_clock::to_time_t(validity.to)),
       "ASN1_TIME_set");
  need(X509_set_pubkey(certificate.get(), key.get()), "X509_set_pubkey");
  const auto add = [&](const char* part, std::string_view value) {
    need(X509_NAME_add_entry_by_txt(X509_get_subject_name(certificate.get()), part, MBSTRING_ASC,
                                    reinterpret_cast<const unsigned char*>(value.data()),
                                    static_cast<int>(value.size()), -1, 0),
         "X509_NAME_add_entry_by_txt");
  };
  add("O", "Trivela");
  add("CN", name);
  return certificate;
}

std::chrono::sys_seconds instant_of(const ASN1_TIME* time) {
  std::tm parts{};
  need(ASN1_TIME_to_tm(time, &parts), "ASN1_TIME_to_tm");
  return std::chrono::time_point_cast<std::chrono::seconds>(std::chrono::system_clock::from_time_t(timegm(&parts)));
}

template <class T>
T read_pem(const std::filesystem::path& file, auto* reader) {
  const Bio bio{BIO_new_file(file.c_str(), "r")};
  if (!bio) throw std::runtime_error{fmt::format("{}: cannot be read", file.string())};
  T read{reader(bio.get(), nullptr, nullptr, nullptr)};
  if (!read) throw std::runtime_error{fmt::format("{}: holds no PEM of its kind", file.string())};
  return read;
}

}  // namespace

void CryptoFree::operator()(evp_pkey_st* key) const noexcept { EVP_PKEY_free(key); }
void CryptoFree::operator()(x509_st* certificate) const noexcept { X509_free(certificate); }

Key new_key() { return Key{need(EVP_EC_gen("P-256"), "EVP_EC_gen")}; }

Certificate new_authority(const Key& key, std::string_view name, const Validity& validity) {
  Certificate authority = blank(key, name, validity);
  need(X509_set_issuer_name(authority.get(), X509_get_subject_name(authority.get())), "X509_set_issuer_name");
  extend(authority.get(), authority.get(), NID_basic_constraints, "critical,CA:TRUE,pathlen:0");
  extend(authority.get(), authority.get(), NID_key_usage, "critical,keyCertSign,digitalSignature");
  need(X509_sign(authority.get(), key.get(), EVP_sha256()), "X509_sign");
  return authority;
}

Certificate new_identity(const Key& key, std::string_view name, const Validity& validity, const Certificate& authority,
                         const Key& authority_key) {
  Certificate identity = blank(key, name, validity);
  need(X509_set_issuer_name(identity.get(), X509_get_subject_name(authority.get())), "X509_set_issuer_name");
  extend(identity.get(), authority.get(), NID_basic_constraints, "critical,CA:FALSE");
  extend(identity.get(), authority.get(), NID_key_usage, "critical,digitalSignature,keyAgreement");
  need(X509_sign(identity.get(), authority_key.get(), EVP_sha256()), "X509_sign");
  return identity;
}

std::string pem_of(const Key& key) {
  const Bio bio = memory();
  need(PEM_write_bio_PrivateKey(bio.get(), key.get(), nullptr, nullptr, 0, nullptr, nullptr), "PEM_write_PrivateKey");
  return text_of(bio);
}

std::string pem_of(const Certificate& certificate) {
  const Bio bio = memory();
  need(PEM_write_bio_X509(bio.get(), certificate.get()), "PEM_write_X509");
  return text_of(bio);
}

Key read_key(const std::filesystem::path& file) { return read_pem<Key>(file, PEM_read_bio_PrivateKey); }

Certificate read_certificate(const std::filesystem::path& file) {
  return read_pem<Certificate>(file, PEM_read_bio_X509);
}

std::string signed_document(const std::string& text, const Certificate& authority, const Key& authority_key) {
  constexpr int kFlags = PKCS7_TEXT | PKCS7_DETACHED | PKCS7_STREAM;
  const Bio in = memory(text);
  const Pkcs7 signature{
      need(PKCS7_sign(authority.get(), authority_key.get(), nullptr, in.get(), kFlags), "PKCS7_sign")};
  const Bio out = memory();
  need(SMIME_write_PKCS7(out.get(), signature.get(), in.get(), kFlags), "SMIME_write_PKCS7");
  return text_of(out);
}

std::optional<std::string> verified_text(const std::string& document, const Certificate& authority) {
  const Bio in = memory(document);
  BIO* detached = nullptr;
  const Pkcs7 signature{SMIME_read_PKCS7(in.get(), &detached)};
  const Bio content{detached};
  const Store store{need(X509_STORE_new(), "X509_STORE_new")};
  need(X509_STORE_add_cert(store.get(), authority.get()), "X509_STORE_add_cert");
  // Whether the signature was of its time is asked of the certificates.
  X509_STORE_set_flags(store.get(), X509_V_FLAG_NO_CHECK_TIME);
  const std::unique_ptr<STACK_OF(X509), decltype([](STACK_OF(X509) * stack) { sk_X509_free(stack); })> signers{
      need(sk_X509_new_null(), "sk_X509_new_null")};
  sk_X509_push(signers.get(), authority.get());
  const Bio out = memory();
  const bool good = signature && PKCS7_verify(signature.get(), signers.get(), store.get(), content.get(), out.get(),
                                              PKCS7_TEXT | PKCS7_NOINTERN) == 1;
  ERR_clear_error();
  if (!good) return std::nullopt;
  std::string text = text_of(out);
  std::erase(text, '\r');  // S/MIME ends lines by both
  return text;
}

std::string subject_of(const Certificate& certificate) {
  const Bio out = memory();
  X509_NAME_print_ex(out.get(), X509_get_subject_name(certificate.get()), 0, XN_FLAG_RFC2253 & ~XN_FLAG_DN_REV);
  return text_of(out);
}

Validity validity_of(const Certificate& certificate) {
  return {instant_of(X509_get0_notBefore(certificate.get())), instant_of(X509_get0_notAfter(certificate.get()))};
}

bool belongs(const Key& key, const Certificate& certificate) {
  const bool same = X509_check_private_key(certificate.get(), key.get()) == 1;
  ERR_clear_error();
  return same;
}

bool is_signed_by(const Certificate& certificate, const Certificate& authority) {
  const bool good =
      X509_NAME_cmp(X509_get_issuer_name(certificate.get()), X509_get_subject_name(authority.get())) == 0 &&
      X509_verify(certificate.get(), X509_get0_pubkey(authority.get())) == 1;
  ERR_clear_error();
  return good;
}

bool same_public_key(const Certificate& a, const Certificate& b) {
  return EVP_PKEY_eq(X509_get0_pubkey(a.get()), X509_get0_pubkey(b.get())) == 1;
}

}  // namespace trivela::security
