#include "clients/lockstep/live_options.hpp"

#include <fmt/format.h>

#include "clients/supervisor/machine_choice.hpp"
#include "clients/supervisor/other_hosts.hpp"

namespace lockstep {

Argument add_json(Verb verb, bool& json) {
    return verb.add_flag("--json", json, "one JSON report on standard output instead of text");
}

void add_live_options(Verb verb, LiveOptions& options) {
    verb.add_option("--machine", options.machine_file, kMachineHelp);
    add_json(verb, options.json);
}

void add_take(Verb verb, LiveOptions& options) {
    verb.add_flag("--take", options.take,
                  "take over the machine from the writer that lockstep status names; a job in motion continues");
}

Argument add_all_hosts(Verb verb, AllHosts& all) {
    const Argument asked = verb.add_flag(
        "--all", all.asked,
        "run the command on every host that the machine's file names, on other hosts over ssh, in parallel");
    verb.add_option("--ssh", all.ssh,
                    "with --all: the command that runs a command on another host; the host's name is appended to it")
        .needs(asked)
        .with_default();
    return asked;
}

void add_detach(Verb verb, bool& detach) {
    verb.add_flag("--detach", detach,
                  "return with the job's number after the job has begun; the job continues by itself");
}

std::string footer(const std::string& examples, const std::string& exit_codes) {
    return fmt::format("Examples:\n{}Exit codes: {}", examples, exit_codes);
}

std::string group_footer(const std::string& examples, const std::string& verb) {
    return footer(examples) + "\nOptions: lockstep " + verb + " --help";
}

}  // namespace lockstep
