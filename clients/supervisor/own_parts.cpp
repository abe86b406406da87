#include "clients/supervisor/own_parts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clients/session/parts.hpp"
#include "services/network/host_name.hpp"

namespace lockstep {
namespace {

/// A device, or the page.
bool is_not_on_network(const std::string& line) {
    return line.starts_with("fpga-") || line.starts_with("board-") || line == kWeb;
}

bool is_present(const ProcessRecord& record, const std::vector<PresentProcess>& present) {
    return std::ranges::any_of(present, [here = host_name(), &record](const PresentProcess& process) {
        return process.pid == record.pid && process.host == here;
    });
}

bool is_placed(const Placement& placed, const PresentProcess& process) {
    return process.motor ? std::ranges::find(placed.axes, *process.motor) != placed.axes.end() : placed.coordinator;
}

/// False if the number belongs to another program by now: a killed process stays on the network until its lease ends.
bool is_service(pid_t pid) {
    return std::ranges::any_of(command_line_of(pid), [](const std::string& word) {
        return word.ends_with("lockstep-axis") || word.ends_with("lockstep-coordinator");
    });
}

bool is_older(const PresentProcess& process, const ProcessRecord& supervisor) {
    const auto pid = static_cast<pid_t>(process.pid);
    const auto start = start_of(pid);
    return start && *start < supervisor.start && is_service(pid);
}

}  // namespace

bool are_present(const std::vector<ServiceLine>& lines, const std::vector<ProcessRecord>& recorded,
                 const std::vector<PresentProcess>& present) {
    return std::ranges::all_of(lines, [&](const ServiceLine& line) {
        const auto record = std::ranges::find(recorded, line.name, &ProcessRecord::name);
        return is_not_on_network(line.name) || (record != recorded.end() && is_present(*record, present));
    });
}

std::optional<std::string> foreign_part(const MachineSetup& machine, const Placement& placed,
                                        const ProcessRecord& supervisor, const std::vector<PresentProcess>& present) {
    const std::string here = host_name();
    for (const PresentProcess& process : present) {
        if (!is_placed(placed, process) || process.host.empty()) { continue; }
        const std::string part = part_name(machine, process.motor) + " of machine '" + machine.name + "'";
        const std::string number = fmt::format("process {}", process.pid);
        if (process.host != here) {
            return fmt::format(
                "{} runs on {} ({}), but the machine's file places it here, on {}; end it on that host: lockstep down; "
                "and give all hosts the same machine file",
                part, process.host, number, here);
        }
        if (is_older(process, supervisor)) {
            return fmt::format("{} already runs ({}), but lockstep up did not start it; end it first", part, number);
        }
    }
    return std::nullopt;
}

}  // namespace lockstep
