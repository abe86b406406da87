// lockstep spy
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "clients/lockstep/live/spy_command.hpp"
#include "clients/lockstep/live_options.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/supervisor/machine_choice.hpp"
#include "clients/text/output.hpp"

namespace lockstep {
namespace {

/// Replaces this process by lcm-spy. Returns only if that fails.
Failure become(std::vector<std::string> words) {
    std::vector<char*> arguments;
    for (std::string& word : words) { arguments.push_back(word.data()); }
    arguments.push_back(nullptr);
    execv(arguments[0], arguments.data());
    return failed("cannot execute " + words[0] + ": " + std::strerror(errno));
}

ExitCode spy(const LiveOptions& options) {
    Output output(options.json);
    const auto machine = choose_machine(options.machine_file);
    if (!machine) { return output.fail(machine.error()); }
    auto command = spy_command(look_at_host(), machine->config.network.lcm_url);
    if (!command) { return output.fail(command.error()); }
    output.print("lcm-spy: double-click a channel for its fields, click a field's curve for its chart");
    return output.fail(become(std::move(*command)));
}

}  // namespace

void add_spy(Verb command) {
    const Verb verb = command.add_verb("spy",
                                       "open lcm-spy with the machine's types\n"
                                       "lcm-spy shows every channel, field and curve live.");
    const auto options = std::make_shared<LiveOptions>();
    add_live_options(verb, *options);
    verb.footer(footer("  lockstep spy\n  lockstep spy --machine mill.textproto\n"));
    verb.action([options] { return spy(*options); });
}

}  // namespace lockstep
