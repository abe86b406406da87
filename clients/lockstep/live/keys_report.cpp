#include "clients/lockstep/live/keys_report.hpp"

#include "services/security/admission.hpp"
#include "services/security/key_directory.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;

bool is_here(const Credentials& files) {
    std::error_code error;
    return fs::exists(files.certificate, error) || fs::exists(files.private_key, error) ||
           fs::exists(files.permissions, error);
}

proto::MemberKeys member_keys(const Member& member, const MemberCheck& check, std::chrono::sys_seconds now) {
    proto::MemberKeys keys;
    keys.set_name(member.name);
    keys.set_role(std::string(name_of(member.role)));
    keys.set_here(true);
    for (const std::string& problem : check.errors) { keys.add_problems(problem); }
    for (const std::string& warning : check.warnings) { keys.add_warnings(warning); }
    if (!check.certificate) { return keys; }
    keys.set_subject(check.certificate->subject);
    keys.set_fingerprint(check.certificate->fingerprint);
    keys.set_until(time_text(*check.until));
    keys.set_days_left(static_cast<int>(std::chrono::floor<std::chrono::days>(*check.until - now).count()));
    return keys;
}

}  // namespace

proto::KeysReport keys_report(const MachineSetup& machine, const fs::path& directory) {
    const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
    proto::KeysReport report;
    report.set_machine(machine.name);
    report.set_directory(directory.string());
    for (const Member& member : members_of(machine)) {
        if (is_here(credentials_in(directory, member))) {
            *report.add_members() = member_keys(member, check_member(machine, directory, member, now), now);
            continue;
        }
        proto::MemberKeys& absent = *report.add_members();
        absent.set_name(member.name);
        absent.set_role(std::string(name_of(member.role)));
    }
    return report;
}

}  // namespace lockstep
