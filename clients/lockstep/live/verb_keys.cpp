// lockstep keys
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "clients/lockstep/live/keys_report.hpp"
#include "clients/lockstep/live_options.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/supervisor/machine_choice.hpp"
#include "clients/text/output.hpp"
#include "services/security/key_directory.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;

struct KeysOptions : LiveOptions {
    std::string directory;
    int days = 1825;
    bool force = false;
};

struct Keys {
    ChosenMachine machine;
    fs::path directory;
};

std::expected<Keys, Failure> choose_keys(const KeysOptions& options) {
    auto machine = choose_machine(options.machine_file);
    if (!machine) { return std::unexpected(machine.error()); }
    const std::string& named =
        options.directory.empty() ? machine->config.security.directory : fs::absolute(options.directory).string();
    if (!named.empty()) { return Keys{*std::move(machine), fs::path(named).lexically_normal()}; }
    return std::unexpected(bad_input(
        machine->file.string() + ": this file has no security { directory: ... }; add it, or give --directory DIR"));
}

void report_member(const proto::MemberKeys& member, bool with_fingerprint, Output& output) {
    constexpr std::size_t kColumn = 22;
    const std::string mark = !member.problems().empty() ? "BAD  " : member.here() ? "ok   " : "-    ";
    std::string name = member.name();
    name.resize(std::max(name.size() + 1, kColumn), ' ');
    const std::string until = fmt::format("until {}, {} days", member.until(), member.days_left());
    output.print(mark + name + (member.here() ? until : "not on this host"));
    if (with_fingerprint && member.here()) {
        output.print("     " + member.subject() + "\n     " + member.fingerprint());
    }
    for (const std::string& problem : member.problems()) { output.print("     " + problem); }
    for (const std::string& warning : member.warnings()) { output.print("     " + warning); }
}

ExitCode look(const KeysOptions& options, bool with_fingerprint) {
    Output output(options.json);
    const auto keys = choose_keys(options);
    if (!keys) { return output.fail(keys.error()); }
    const proto::KeysReport report = keys_report(keys->machine.config, keys->directory);
    const bool any = std::ranges::any_of(report.members(), [](const auto& member) { return member.here(); });
    if (!any) {
        return output.fail(failed(
            fmt::format("{}: no member of machine '{}' has keys here; make them: lockstep keys make --machine {}",
                        keys->directory.string(), keys->machine.config.name, keys->machine.file.string())));
    }
    output.report(report);
    output.print(keys->directory.string());
    for (const proto::MemberKeys& member : report.members()) { report_member(member, with_fingerprint, output); }
    const bool well =
        std::ranges::all_of(report.members(), [](const auto& member) { return member.problems().empty(); });
    return well ? kExitDone : kExitFailed;
}

ExitCode make(const KeysOptions& options) {
    Output output(options.json);
    const auto keys = choose_keys(options);
    if (!keys) { return output.fail(keys.error()); }
    const MachineSetup& machine = keys->machine.config;
    const auto made = make_keys(machine, keys->directory, valid_for(std::chrono::days(options.days)), options.force);
    if (!made) { return output.fail(failed(made.error())); }
    proto::KeysReport report = keys_report(machine, keys->directory);
    if (!made->replaced.empty()) { report.set_replaced(made->replaced); }
    output.report(report);
    output.print(fmt::format("created keys for {} members of machine '{}' in {}", report.members_size(), machine.name,
                             keys->directory.string()));
    if (!made->replaced.empty()) {
        output.print("the previous keys are in " + made->replaced + "; delete them after the new keys work");
    }
    output.print(
        "each host needs identity-ca.pem, permissions-ca.pem, governance.p7s, and .pem, .key and .p7s of what runs\n"
        "there; keep ca/ off the machine: with it anybody can make members");
    if (!machine.security.enabled()) {
        output.print("the machine's file does not enable security yet; add to it:\n    security { directory: \"" +
                     keys->directory.string() + "\" }");
    }
    return kExitDone;
}

Verb add_part(Verb keys, const char* name, const char* what, const std::shared_ptr<KeysOptions>& options) {
    const Verb verb = keys.add_verb(name, what);
    add_live_options(verb, *options);
    verb.add_option("--directory", options->directory,
                    "the directory of the keys; default: the machine's security.directory");
    return verb;
}

void add_make(Verb keys) {
    const auto options = std::make_shared<KeysOptions>();
    const Verb verb =
        add_part(keys, "make", "create certificates, keys and permissions for all members of a machine", options);
    verb.add_option("--days", options->days, "how many days the certificates are valid")
        .in_range(1, 36500)
        .with_default();
    verb.add_flag("--force", options->force, "replace existing keys: move them aside and create new ones");
    verb.footer(
        footer("  lockstep keys make --machine mill.textproto\n"
               "  lockstep keys make --machine mill.textproto --directory /root/mill-keys --days 365\n"));
    verb.action([options] { return make(*options); });
}

void add_look(Verb keys, const char* name, const char* what, bool with_fingerprint) {
    const auto options = std::make_shared<KeysOptions>();
    const Verb verb = add_part(keys, name, what, options);
    verb.footer(footer(
        fmt::format("  lockstep keys {0}\n  lockstep keys {0} --json | jq '.members[] | [.name, .until]'\n", name)));
    verb.action([options, with_fingerprint] { return look(*options, with_fingerprint); });
}

}  // namespace

void add_keys(Verb command) {
    const Verb keys = command.add_verb("keys",
                                       "make, show or check the keys of the machine's members\n"
                                       "The keys are those of DDS Security.");
    keys.footer(group_footer("  lockstep keys make --machine mill.textproto\n", "keys make"));
    add_make(keys);
    add_look(keys, "show", "show each member's certificate: subject, fingerprint and end", true);
    add_look(keys, "check", "check that the keys on this host are valid, private, and this machine's", false);
}

}  // namespace lockstep
