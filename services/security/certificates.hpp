// Makes and checks certificates, keys and signed documents with OpenSSL: EC keys on P-256 and X.509 certificates in
// PEM, and S/MIME signatures.
#pragma once

#include <chrono>
#include <expected>
#include <memory>
#include <string>

namespace lockstep {

/// A certificate and its private key. Copies share them.
class Signer {
public:
    struct Parts;
    explicit Signer(std::shared_ptr<const Parts> parts) : parts_(std::move(parts)) {}

    std::string certificate_pem() const;
    std::string key_pem() const;
    const Parts& parts() const { return *parts_; }

private:
    std::shared_ptr<const Parts> parts_;
};

struct Subject {
    std::string organization;  // the machine's name
    std::string name;
};

/// The time in which a certificate is valid: from `from` until just before `until`.
struct Period {
    std::chrono::sys_seconds from;
    std::chrono::sys_seconds until;
};

/// From one day ago, since hosts' clocks differ.
Period valid_for(std::chrono::days days);

/// Makes a self-signed certificate that may sign others.
std::expected<Signer, std::string> make_authority(const Subject& subject, const Period& valid);

/// Makes a certificate signed by `authority`.
std::expected<Signer, std::string> issue(const Subject& subject, const Signer& authority, const Period& valid);

/// Returns the document with its signature, as S/MIME text.
std::expected<std::string, std::string> sign(const std::string& document, const Signer& signer);

/// Returns the document that was signed. Error: `authority_pem` did not sign exactly this content. Whether the
/// authority's certificate has expired does not matter.
std::expected<std::string, std::string> signed_content(const std::string& signed_document,
                                                       const std::string& authority_pem);

struct CertificateFacts {
    std::string subject;      // in the format of RFC 2253
    std::string fingerprint;  // SHA-256, in hex with colons
    Period valid;
};
std::expected<CertificateFacts, std::string> read_certificate(const std::string& pem);

/// Check that `authority_pem` signed the certificate, and that the key belongs to the certificate. Error: which check
/// failed.
std::expected<void, std::string> check_certificate(const std::string& pem, const std::string& authority_pem);
std::expected<void, std::string> check_key(const std::string& certificate_pem, const std::string& key_pem);

}  // namespace lockstep
