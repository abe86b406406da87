#include "services/security/admission.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include "services/files/text_file.hpp"
#include "services/security/access_documents.hpp"
#include "services/security/key_directory.hpp"
#include "services/wire/dds/security_properties.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;

constexpr mode_t kForbidden = S_IRWXO | S_IWGRP | S_IXGRP;  // the services' group may read

/// Checks one file after the other and notes the errors.
class Inspection {
public:
    Inspection(const MachineSetup& machine, const Member& member) : machine_(machine), member_(member) {}

    /// Returns the text; empty if the file cannot be read.
    std::string read(const fs::path& path) {
        auto text = read_text_file(path);
        if (text) { return *std::move(text); }
        wrong(path, text.error().message,
              "copy it from the directory of `lockstep keys make`, and make it readable for the user of this process");
        return "";
    }
    void look_at_key_mode(const fs::path& path) {
        struct stat facts {};
        if (::stat(path.c_str(), &facts) != 0 || (facts.st_mode & kForbidden) == 0) { return; }
        wrong(path, "other users may read or change this private key", "chmod 600 " + path.string());
    }
    /// Checks the directory's mode, because users who may write the directory may replace its files.
    void look_at_directory_mode(const fs::path& path) {
        struct stat facts {};
        if (::stat(path.c_str(), &facts) != 0 || (facts.st_mode & (S_IWOTH | S_IWGRP)) == 0) { return; }
        wrong(path, "other users may replace the files in this directory", "chmod go-w " + path.string());
    }
    /// Notes how long a file is valid. `what`: "the certificate of axis-X".
    void date(const fs::path& path, const std::string& what, const std::optional<Period>& valid) {
        if (!valid) { return; }
        if (!latest_ || valid->from > latest_->valid.from) { latest_ = {path, what, *valid}; }
        if (!earliest_ || valid->until < earliest_->valid.until) { earliest_ = {path, what, *valid}; }
    }
    /// Reports the file that expires first, and the one that is valid last.
    void look_at_dates(std::chrono::sys_seconds now) {
        if (!latest_ || !earliest_) { return; }
        check_.until = earliest_->valid.until;
        const std::string clock = "; this host's clock says " + time_text(now);
        if (now < latest_->valid.from) {
            wrong(latest_->path, latest_->what + " is valid only from " + time_text(latest_->valid.from) + clock,
                  "set this host's clock");
        }
        const std::string end = time_text(*check_.until);
        if (now >= *check_.until) {
            wrong(earliest_->path, earliest_->what + " expired on " + end + clock,
                  std::string(kRenew) + "; if that clock is wrong, set it");
        } else if (*check_.until - now < kNearEnd) {
            check_.warnings.push_back(
                fmt::format("{}: {} expires on {}; then {} can no longer join, and leaves a machine that is up; {}",
                            earliest_->path.string(), earliest_->what, end, member_.name, kRenew));
        }
    }
    void certificate(const fs::path& path, const std::string& pem) {
        auto facts = read_certificate(pem);
        if (!facts) { return wrong(path, facts.error(), kRenew); }
        check_.certificate = *std::move(facts);
        date(path, "the certificate of " + member_.name, check_.certificate->valid);
    }
    void authority(const fs::path& path, const std::string& what, const std::string& pem) {
        const auto facts = read_certificate(pem);
        if (facts) { date(path, what, facts->valid); }
    }
    template <typename Outcome>
    void require(const fs::path& path, const Outcome& outcome) {
        if (!outcome) { wrong(path, outcome.error(), kSame); }
    }
    /// Requires that the signed content matches this machine's file.
    void require_content(const fs::path& path, const std::expected<std::string, std::string>& content,
                         const std::string& wanted) {
        require(path, content);
        if (content && !content->contains(wanted)) {
            wrong(path, "was made for a machine file with another name, domain or order of axes", kRenew);
        }
    }
    MemberCheck done() { return std::move(check_); }

private:
    static constexpr const char* kRenew = "run lockstep keys make --force, then give every host its files";
    static constexpr const char* kSame = "use files that were all made by the same run of lockstep keys make";

    void wrong(const fs::path& path, const std::string& what, const std::string& remedy) {
        check_.errors.push_back("machine '" + machine_.name + "', " + member_.name + ": " + path.string() + ": " +
                                what + "; " + remedy);
    }

    struct Dated {
        fs::path path;
        std::string what;
        Period valid;
    };
    const MachineSetup& machine_;
    const Member& member_;
    MemberCheck check_;
    std::optional<Dated> latest_;    // the file that is valid last
    std::optional<Dated> earliest_;  // the file that expires first
};

}  // namespace

MemberCheck check_member(const MachineSetup& machine, const fs::path& directory, const Member& member,
                         std::chrono::sys_seconds now) {
    Inspection look(machine, member);
    const Credentials files = credentials_in(directory, member);
    const std::string identity_ca = look.read(files.identity_ca);
    const std::string certificate = look.read(files.certificate);
    const std::string key = look.read(files.private_key);
    const std::string permissions_ca = look.read(files.permissions_ca);
    const std::string governance = look.read(files.governance);
    const std::string permissions = look.read(files.permissions);
    look.look_at_directory_mode(directory);
    look.look_at_key_mode(files.private_key);
    for (const char* ca : {"identity-ca.key", "permissions-ca.key"}) { look.look_at_key_mode(directory / "ca" / ca); }
    if (!certificate.empty()) { look.certificate(files.certificate, certificate); }
    look.authority(files.identity_ca, "the certificate of the authority for identities", identity_ca);
    look.authority(files.permissions_ca, "the certificate of the authority for permissions", permissions_ca);
    const auto signed_permissions = signed_content(permissions, permissions_ca);
    if (signed_permissions) {
        look.date(files.permissions, "the permissions of " + member.name, period_in(*signed_permissions));
    }
    look.look_at_dates(now);
    if (!certificate.empty() && !identity_ca.empty()) {
        look.require(files.certificate, check_certificate(certificate, identity_ca));
    }
    if (!certificate.empty() && !key.empty()) { look.require(files.private_key, check_key(certificate, key)); }
    if (permissions_ca.empty()) { return look.done(); }
    if (!governance.empty()) {
        look.require_content(files.governance, signed_content(governance, permissions_ca), governance_xml(machine));
    }
    if (!permissions.empty()) {
        look.require_content(files.permissions, signed_permissions, allow_rule_xml(machine, member));
    }
    return look.done();
}

std::expected<Admission, std::string> admit(const MachineSetup& machine, const Member& member) {
    Admission admission{.membership = {.axis = member.axis, .credentials = {}}, .until = {}};
    if (!machine.security.enabled()) { return admission; }
    keep_openssl_alive();
    const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
    const MemberCheck check = check_member(machine, machine.security.directory, member, now);
    if (!check.errors.empty()) { return std::unexpected(check.errors.front()); }
    admission.membership.credentials = credentials_in(machine.security.directory, member);
    admission.until = check.until;
    return admission;
}

}  // namespace lockstep
