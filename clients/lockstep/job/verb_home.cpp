// lockstep home
#include "clients/lockstep/job/job.hpp"
#include "clients/lockstep/live_options.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/session/move_program.hpp"
#include "clients/supervisor/machine_choice.hpp"

namespace lockstep {
namespace {

struct HomeOptions : LiveOptions {
    std::vector<std::string> axes;
    bool detach = false;
};

std::expected<AxisSet, Failure> axes_of(const MachineConfig& machine, const std::vector<std::string>& names) {
    AxisSet axes;
    for (const std::string& name : names) {
        const auto axis = find_axis(machine, name);
        if (!axis) { return std::unexpected(bad_input(axis.error())); }
        axes.insert(*axis);
    }
    return axes;
}

ExitCode home(const HomeOptions& options) {
    Output output(options.json);
    const auto machine = choose_machine(options.machine_file);
    if (!machine) { return output.fail(machine.error()); }
    const auto axes = axes_of(machine->config, options.axes);
    if (!axes) { return output.fail(axes.error()); }
    auto session = Session::open(*machine, Purpose::Command);
    if (!session) { return output.fail(session.error()); }
    const Job job{.command = CommandKind::Home,
                  .kind = "home",
                  .name = {},
                  .axes = *axes,
                  .detach = options.detach,
                  .take = options.take};
    return run_job(*session, job, output);
}

}  // namespace

void add_home(Verb command) {
    const Verb verb = command.add_verb("home",
                                       "find the zero of all axes, or of the named axes\n"
                                       "The axes find it with their home switches.");
    const auto options = std::make_shared<HomeOptions>();
    verb.add_option("axes", options->axes, "the names of the axes; default: all axes");
    add_detach(verb, options->detach);
    add_take(verb, *options);
    add_live_options(verb, *options);
    verb.footer(
        "For each axis it shows the part of homing, the switch, and the axes for which it waits.\n"
        "Ctrl-C, a closed terminal (SIGHUP), lockstep stop and lockstep hold end homing at rest: axes without\n"
        "their zero stay unhomed. With --detach, or under nohup, homing continues by itself.\n" +
        footer("  lockstep home\n  lockstep home X Y\n"));
    verb.action([options] { return home(*options); });
}

}  // namespace lockstep
