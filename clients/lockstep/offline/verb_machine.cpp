// lockstep machine check
#include <fmt/format.h>

#include <memory>

#include "clients/lockstep/live_options.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/supervisor/machine_choice.hpp"
#include "clients/text/format.hpp"
#include "clients/text/output.hpp"
#include "core/axis_unit.hpp"
#include "services/documents/machine_proto.hpp"
#include "services/documents/rules/machine_warnings.hpp"

namespace lockstep {
namespace {

struct CheckOptions {
    std::string file;
    bool json = false;
};

std::string axis_line(const AxisConfig& axis) {
    const std::string unit(unit_of(axis.name));
    return fmt::format("  {}  {} to {} {}, {} {}/s, device {}{}", axis.name, fixed(axis.position_min_mm, 3),
                       fixed(axis.position_max_mm, 3), unit, fixed(axis.max_velocity_mm_s, 1), unit, axis.device.text(),
                       (axis.host.empty() ? "" : ", host " + axis.host));
}

std::string board_line(const BoardConfig& board) {
    return fmt::format("  {}  board, device {}{}", board.name, board.device.text(),
                       (board.host.empty() ? "" : ", host " + board.host));
}

ExitCode check(const CheckOptions& options) {
    Output output(options.json);
    const auto machine = choose_machine(options.file);
    if (!machine) { return output.fail(machine.error()); }
    const MachineSetup& config = machine->config;
    output.print(
        fmt::format("{}: ok: machine '{}', axes: {}", machine->file.string(), config.name, config.axes.size()));
    for (const AxisConfig& axis : config.axes) { output.print(axis_line(axis)); }
    for (const BoardConfig& board : config.boards) { output.print(board_line(board)); }
    output.report(machine_to_proto(config), machine_warnings(config));
    return kExitDone;
}

}  // namespace

void add_machine(Verb command) {
    const Verb verb = command.add_verb("machine", "check a machine's configuration file");
    verb.footer(group_footer("  lockstep machine check mill.textproto\n", "machine check"));
    const Verb part = verb.add_verb("check",
                                    "read the whole file and report everything that is wrong with it; "
                                    "warn of axes that no program can move; needs no running machine");
    const auto options = std::make_shared<CheckOptions>();
    part.add_option("file", options->file, "the machine's configuration file; default: the file that other verbs use");
    part.add_flag("--json", options->json, "print the configuration with every default as JSON instead of text");
    part.footer(footer("  lockstep machine check mill.textproto\n  lockstep machine check mill.textproto --json\n",
                       "0 the file is valid; 2 bad usage, or the file is not valid or cannot be read"));
    part.action([options] { return check(*options); });
}

}  // namespace lockstep
