#include "clients/lockstep/live/service_lines.hpp"

namespace lockstep {

std::vector<ServiceLine> service_lines(const MachineConfig& machine, const Layout& layout,
                                       const std::filesystem::path& programs, const StateDirectory& state) {
    const auto begin = [&](const char* program) {
        return std::vector<std::string>{(programs / program).string(), "--machine", state.machine_file().string()};
    };
    const auto line = [](const std::string& name, std::vector<std::string> words,
                         const std::vector<std::string>& more) {
        words.insert(words.end(), more.begin(), more.end());
        return ServiceLine{name, std::move(words)};
    };
    const auto shared_name = [&](const AxisConfig& axis) { return "lockstep-" + machine.name + "-" + axis.name; };
    std::vector<ServiceLine> lines;
    for (const AxisConfig& axis : machine.axes) {
        if (layout.fpga == FpgaKind::Sim) { break; }
        lines.push_back(
            line("fpga-" + axis.name, begin("lockstep-fpga"), {"--axis", axis.name, "--name", shared_name(axis)}));
    }
    for (const char* name : {"coordinator", "coordinator-2"}) {
        std::vector<std::string> more{"--log", state.log_file(name).string()};
        if (layout.standby) { more.emplace_back("--standby"); }  // both: who ends and is started again stands by
        if (layout.continues) { more.insert(more.end(), {"--on-takeover", "continue"}); }
        lines.push_back(line(name, begin("lockstep-coordinator"), more));
        if (!layout.standby) { break; }
    }
    for (const AxisConfig& axis : machine.axes) {
        const std::string name = "axis-" + axis.name;
        std::vector<std::string> more{"--axis", axis.name, "--log", state.log_file(name).string()};
        if (layout.fpga == FpgaKind::Shared) { more.insert(more.end(), {"--fpga", "shm:" + shared_name(axis)}); }
        lines.push_back(line(name, begin("lockstep-axis"), more));
    }
    return lines;
}

}  // namespace lockstep
