#include "services/security/key_directory.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include "services/files/text_file.hpp"
#include "services/security/access_documents.hpp"
#include "services/security/certificates.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;

constexpr mode_t kPublic = 0644;
constexpr mode_t kPrivate = 0600;

/// Writes one file after the other, until one fails.
class Writing {
public:
    explicit Writing(fs::path directory) : directory_(std::move(directory)) {}

    void file(const std::string& name, const std::expected<std::string, std::string>& text, mode_t mode) {
        if (!done_) { return; }
        if (!text) {
            done_ = std::unexpected(text.error());
        } else {
            done_ = create_text_file(directory_ / name, *text, mode);
        }
    }
    const std::expected<void, std::string>& done() const { return done_; }

private:
    fs::path directory_;
    std::expected<void, std::string> done_;
};

void write_member(Writing& writing, const MachineSetup& machine, const Member& member, const Signer& identity_ca,
                  const Signer& permissions_ca, const Period& valid) {
    const auto signer = issue({machine.name, member.name}, identity_ca, valid);
    if (!signer) { return writing.file(member.name + ".pem", std::unexpected(signer.error()), kPublic); }
    const auto facts = read_certificate(signer->certificate_pem());
    writing.file(member.name + ".pem", signer->certificate_pem(), kPublic);
    writing.file(member.name + ".key", signer->key_pem(), kPrivate);
    writing.file(member.name + ".p7s",
                 sign(permissions_xml(machine, member, facts->subject, facts->valid), permissions_ca), kPublic);
}

std::expected<void, std::string> write_all(const MachineSetup& machine, const fs::path& directory,
                                           const Period& valid) {
    const auto identity_ca = make_authority({machine.name, "identities"}, valid);
    const auto permissions_ca = make_authority({machine.name, "permissions"}, valid);
    if (!identity_ca) { return std::unexpected(identity_ca.error()); }
    if (!permissions_ca) { return std::unexpected(permissions_ca.error()); }
    Writing writing(directory);
    writing.file("identity-ca.pem", identity_ca->certificate_pem(), kPublic);
    writing.file("permissions-ca.pem", permissions_ca->certificate_pem(), kPublic);
    writing.file("ca/identity-ca.key", identity_ca->key_pem(), kPrivate);
    writing.file("ca/permissions-ca.key", permissions_ca->key_pem(), kPrivate);
    writing.file("governance.p7s", sign(governance_xml(machine), *permissions_ca), kPublic);
    for (const Member& member : members_of(machine)) {
        write_member(writing, machine, member, *identity_ca, *permissions_ca, valid);
    }
    return writing.done();
}

std::expected<void, std::string> make_directory(const fs::path& path, fs::perms permissions) {
    std::error_code error;
    fs::create_directories(path, error);
    if (!error) { fs::permissions(path, permissions, error); }
    if (error) { return std::unexpected(path.string() + ": cannot be created: " + error.message()); }
    return {};
}

/// Returns the new name of the previous directory. If two replacements fall into one second, the second rename fails.
fs::path aside(const fs::path& directory) {
    const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
    return directory.string() + ".replaced-" + time_text(now);
}

/// Puts the new directory in place in one step, or in two steps if a directory exists already.
std::expected<MadeKeys, std::string> put_in_place(const fs::path& fresh, const fs::path& directory, bool is_occupied) {
    MadeKeys made;
    std::error_code error;
    if (is_occupied) {
        made.replaced = aside(directory).string();
        fs::rename(directory, made.replaced, error);
        if (error) { return std::unexpected(directory.string() + ": cannot be moved aside: " + error.message()); }
    }
    fs::rename(fresh, directory, error);
    if (!error) { return made; }
    std::error_code ignored;
    if (is_occupied) { fs::rename(made.replaced, directory, ignored); }
    return std::unexpected(directory.string() + ": cannot be put in place: " + error.message());
}

}  // namespace

std::string time_text(std::chrono::sys_seconds time) {
    const std::time_t seconds = time.time_since_epoch().count();
    std::tm parts{};
    gmtime_r(&seconds, &parts);
    char text[32];
    (void)std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
    return text;
}

Credentials credentials_in(const fs::path& directory, const Member& member) {
    return {.identity_ca = directory / "identity-ca.pem",
            .certificate = directory / (member.name + ".pem"),
            .private_key = directory / (member.name + ".key"),
            .permissions_ca = directory / "permissions-ca.pem",
            .governance = directory / "governance.p7s",
            .permissions = directory / (member.name + ".p7s")};
}

std::expected<MadeKeys, std::string> make_keys(const MachineSetup& machine, const fs::path& directory,
                                               const Period& valid, bool replace) {
    std::error_code error;
    const bool is_occupied = fs::exists(directory, error) && !fs::is_empty(directory, error);
    if (is_occupied && !replace) {
        return std::unexpected(directory.string() +
                               ": this directory already has files; --force moves them aside and makes new ones; after "
                               "that every process of the machine needs its new files");
    }
    const fs::path fresh = fmt::format("{}.unfinished-{}", directory.string(), ::getpid());
    auto done = make_directory(fresh, fs::perms(0755));
    if (done) { done = make_directory(fresh / "ca", fs::perms(0700)); }
    if (done) { done = write_all(machine, fresh, valid); }
    auto placed = done ? put_in_place(fresh, directory, is_occupied) : std::unexpected(done.error());
    if (!placed) { fs::remove_all(fresh, error); }
    return placed;
}

}  // namespace lockstep
