#include "services/security/certificates.hpp"

#include <openssl/bio.h>
#include <openssl/ec.h>
#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/pkcs7.h>
#include <openssl/rand.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>

#include <array>

namespace lockstep {
namespace {

template <auto Free>
struct Freed {
    template <typename T>
    void operator()(T* thing) const {
        Free(thing);
    }
};
using Certificate = std::unique_ptr<X509, Freed<X509_free>>;
using Key = std::unique_ptr<EVP_PKEY, Freed<EVP_PKEY_free>>;
using Bio = std::unique_ptr<BIO, Freed<BIO_free_all>>;
using Extension = std::unique_ptr<X509_EXTENSION, Freed<X509_EXTENSION_free>>;
using Pkcs7 = std::unique_ptr<PKCS7, Freed<PKCS7_free>>;
using Store = std::unique_ptr<X509_STORE, Freed<X509_STORE_free>>;

constexpr int kVersion3 = 2;  // X.509 counts versions from 0
constexpr int kSigning = PKCS7_DETACHED | PKCS7_TEXT | PKCS7_STREAM;

std::unexpected<std::string> failed(const char* what) {
    std::array<char, 256> why{};
    ERR_error_string_n(ERR_get_error(), why.data(), why.size());
    ERR_clear_error();
    return std::unexpected(std::string(what) + ": " + why.data());
}

Bio reader_of(const std::string& text) { return Bio(BIO_new_mem_buf(text.data(), static_cast<int>(text.size()))); }
Bio writer() { return Bio(BIO_new(BIO_s_mem())); }

std::string text_of(const Bio& bio) {
    char* data = nullptr;
    const long size = BIO_get_mem_data(bio.get(), &data);
    return {data, static_cast<std::size_t>(size)};
}

Certificate certificate_of(const std::string& pem) {
    return Certificate(PEM_read_bio_X509(reader_of(pem).get(), nullptr, nullptr, nullptr));
}

bool add_name(X509_NAME* name, const char* field, const std::string& value) {
    const auto* text = reinterpret_cast<const unsigned char*>(value.c_str());
    return X509_NAME_add_entry_by_txt(name, field, MBSTRING_UTF8, text, -1, -1, 0) == 1;
}

bool add_extension(X509* certificate, X509* issuer, int kind, const char* value) {
    X509V3_CTX context;
    X509V3_set_ctx_nodb(&context);
    X509V3_set_ctx(&context, issuer, certificate, nullptr, nullptr, 0);
    const Extension extension(X509V3_EXT_conf_nid(nullptr, &context, kind, value));
    return extension && X509_add_ext(certificate, extension.get(), -1) == 1;
}

/// Sets a serial number of 127 random bits, so that no two certificates of an authority have the same one.
bool set_serial(X509* certificate) {
    std::array<unsigned char, 16> bytes{};
    if (RAND_bytes(bytes.data(), bytes.size()) != 1) { return false; }
    bytes[0] &= 0x7F;
    const std::unique_ptr<BIGNUM, Freed<BN_free>> number(BN_bin2bn(bytes.data(), bytes.size(), nullptr));
    return number && BN_to_ASN1_INTEGER(number.get(), X509_get_serialNumber(certificate)) != nullptr;
}

bool set_time(ASN1_TIME* time, std::chrono::sys_seconds to) {
    return ASN1_TIME_set(time, to.time_since_epoch().count()) != nullptr;
}

bool fill(X509* certificate, const Subject& subject, EVP_PKEY* key, X509* issuer, const Period& valid) {
    X509_NAME* name = X509_get_subject_name(certificate);
    return X509_set_version(certificate, kVersion3) == 1 && set_serial(certificate) &&
           set_time(X509_getm_notBefore(certificate), valid.from) &&
           set_time(X509_getm_notAfter(certificate), valid.until) && add_name(name, "O", subject.organization) &&
           add_name(name, "CN", subject.name) &&
           X509_set_issuer_name(certificate, X509_get_subject_name(issuer)) == 1 &&
           X509_set_pubkey(certificate, key) == 1;
}

bool add_purpose(X509* certificate, X509* issuer, bool is_authority) {
    return add_extension(certificate, issuer, NID_basic_constraints,
                         is_authority ? "critical,CA:TRUE" : "critical,CA:FALSE") &&
           add_extension(
               certificate, issuer, NID_key_usage,
               is_authority ? "critical,keyCertSign,cRLSign,digitalSignature" : "critical,digitalSignature") &&
           add_extension(certificate, issuer, NID_subject_key_identifier, "hash");
}

std::chrono::sys_seconds time_of(const ASN1_TIME* time) {
    std::tm parts{};
    ASN1_TIME_to_tm(time, &parts);
    return std::chrono::sys_seconds(std::chrono::seconds(timegm(&parts)));
}

std::string subject_of(const X509* certificate) {
    const Bio out = writer();
    X509_NAME_print_ex(out.get(), X509_get_subject_name(certificate), 0, XN_FLAG_RFC2253);
    return text_of(out);
}

std::string fingerprint_of(const X509* certificate) {
    std::array<unsigned char, EVP_MAX_MD_SIZE> bytes{};
    unsigned size = 0;
    X509_digest(certificate, EVP_sha256(), bytes.data(), &size);
    const std::unique_ptr<char, decltype([](char* text) { OPENSSL_free(text); })> hex(
        OPENSSL_buf2hexstr(bytes.data(), size));
    return hex.get();
}

}  // namespace

struct Signer::Parts {
    Key key;
    Certificate certificate;
};

namespace {

/// `authority` is null for a self-signed certificate.
std::expected<Signer, std::string> make(const Subject& subject, const Signer* authority, const Period& valid) {
    auto parts = std::make_shared<Signer::Parts>();
    parts->key.reset(EVP_EC_gen("P-256"));
    parts->certificate.reset(X509_new());
    if (!parts->key || !parts->certificate) { return failed("cannot create a key"); }
    X509* certificate = parts->certificate.get();
    X509* issuer = authority == nullptr ? certificate : authority->parts().certificate.get();
    EVP_PKEY* signing = authority == nullptr ? parts->key.get() : authority->parts().key.get();
    if (!fill(certificate, subject, parts->key.get(), issuer, valid) ||
        !add_purpose(certificate, issuer, authority == nullptr) || X509_sign(certificate, signing, EVP_sha256()) == 0) {
        return failed("cannot create a certificate");
    }
    return Signer(std::move(parts));
}

}  // namespace

std::string Signer::certificate_pem() const {
    const Bio out = writer();
    PEM_write_bio_X509(out.get(), parts_->certificate.get());
    return text_of(out);
}

std::string Signer::key_pem() const {
    const Bio out = writer();
    PEM_write_bio_PrivateKey(out.get(), parts_->key.get(), nullptr, nullptr, 0, nullptr, nullptr);
    return text_of(out);
}

Period valid_for(std::chrono::days days) {
    const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
    return {now - std::chrono::days(1), now + days};
}

std::expected<Signer, std::string> make_authority(const Subject& subject, const Period& valid) {
    return make(subject, nullptr, valid);
}

std::expected<Signer, std::string> issue(const Subject& subject, const Signer& authority, const Period& valid) {
    return make(subject, &authority, valid);
}

std::expected<std::string, std::string> sign(const std::string& document, const Signer& signer) {
    const Bio in = reader_of(document);
    const Bio out = writer();
    const Pkcs7 signature(
        PKCS7_sign(signer.parts().certificate.get(), signer.parts().key.get(), nullptr, in.get(), kSigning));
    if (!signature || SMIME_write_PKCS7(out.get(), signature.get(), in.get(), kSigning) != 1) {
        return failed("cannot sign");
    }
    return text_of(out);
}

std::expected<std::string, std::string> signed_content(const std::string& signed_document,
                                                       const std::string& authority_pem) {
    BIO* content = nullptr;
    const Pkcs7 signature(SMIME_read_PKCS7(reader_of(signed_document).get(), &content));
    const Bio owned(content);
    const Certificate authority = certificate_of(authority_pem);
    const Store store(X509_STORE_new());
    if (!signature || !authority || !store || X509_STORE_add_cert(store.get(), authority.get()) != 1) {
        return failed("is not a signed document");
    }
    X509_STORE_set_flags(store.get(), X509_V_FLAG_NO_CHECK_TIME);
    const Bio out = writer();
    if (PKCS7_verify(signature.get(), nullptr, store.get(), content, out.get(), PKCS7_TEXT) != 1) {
        return failed("the signature is not valid");
    }
    std::string text = text_of(out);
    std::erase(text, '\r');  // S/MIME uses its own line endings
    return text;
}

std::expected<CertificateFacts, std::string> read_certificate(const std::string& pem) {
    const Certificate certificate = certificate_of(pem);
    if (!certificate) { return failed("is not a certificate in PEM"); }
    return CertificateFacts{
        .subject = subject_of(certificate.get()),
        .fingerprint = fingerprint_of(certificate.get()),
        .valid = {time_of(X509_get0_notBefore(certificate.get())), time_of(X509_get0_notAfter(certificate.get()))}};
}

std::expected<void, std::string> check_certificate(const std::string& pem, const std::string& authority_pem) {
    const Certificate certificate = certificate_of(pem);
    const Certificate authority = certificate_of(authority_pem);
    if (!certificate || !authority) { return failed("is not a certificate in PEM"); }
    if (X509_verify(certificate.get(), X509_get0_pubkey(authority.get())) != 1) {
        return failed("was not issued by this authority");
    }
    return {};
}

std::expected<void, std::string> check_key(const std::string& certificate_pem, const std::string& key_pem) {
    const Certificate certificate = certificate_of(certificate_pem);
    const Key key(PEM_read_bio_PrivateKey(reader_of(key_pem).get(), nullptr, nullptr, nullptr));
    if (!certificate || !key) { return failed("is not a private key in PEM"); }
    if (X509_check_private_key(certificate.get(), key.get()) != 1) {
        return failed("is not the key of the certificate");
    }
    return {};
}

}  // namespace lockstep
