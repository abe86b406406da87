// Options that are common to several verbs.
#pragma once

#include <string>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace lockstep {

struct AllHosts;

/// The options of every verb that connects to a machine.
struct LiveOptions {
    std::string machine_file;
    bool json = false;
    bool take = false;  // of verbs with add_take()
};

void add_live_options(CLI::App& verb, LiveOptions& options);

/// --take: for a verb that moves or changes the machine.
void add_take(CLI::App& verb, LiveOptions& options);

/// --all and --ssh.
CLI::Option* add_all_hosts(CLI::App& verb, AllHosts& all);

/// --detach: for a verb that otherwise waits for its job's end.
void add_detach(CLI::App& verb, bool& detach);

/// The effect of an interrupt on such a verb's job.
inline constexpr const char* kInterrupted =
    "Ctrl-C stops the machine on its path and drops the rest; a closed terminal (SIGHUP) holds it: go on with\n"
    "lockstep resume. With --detach, or under nohup, it goes on by itself.\n";

/// Examples, one per line, then the exit codes.
std::string footer(const std::string& examples);

}  // namespace lockstep
