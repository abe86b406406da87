// Options common to several verbs.
#pragma once

#include <string>

#include "services/arguments/argument_parser.hpp"

namespace lockstep {

struct AllHosts;

/// The options of every verb that connects to a machine.
struct LiveOptions {
    std::string machine_file;
    bool json = false;
    bool take = false;  // for verbs with add_take()
};

/// Adds --json.
Argument add_json(Verb verb, bool& json);

void add_live_options(Verb verb, LiveOptions& options);

/// Adds --take, for a verb that moves or changes the machine.
void add_take(Verb verb, LiveOptions& options);

/// Adds --all and --ssh.
Argument add_all_hosts(Verb verb, AllHosts& all);

/// Adds --detach, for a verb that otherwise waits for the end of its job.
void add_detach(Verb verb, bool& detach);

/// Help text: the effect of an interrupt on the job of such a verb.
inline constexpr const char* kInterrupted =
    "Ctrl-C stops the machine on its path and drops the rest; a closed terminal (SIGHUP) holds it: continue with\n"
    "lockstep resume. With --detach, or under nohup, it continues by itself.\n";

inline constexpr const char* kExitCodes =
    "0 done, 1 failed or refused, 2 bad usage or input (nothing was done), 3 machine not reachable";

/// The help's footer: examples, one per line, then the exit codes.
std::string footer(const std::string& examples, const std::string& exit_codes = kExitCodes);
/// The footer of a verb that has verbs of its own; `verb` is one of them, with its options.
std::string group_footer(const std::string& examples, const std::string& verb);

}  // namespace lockstep
