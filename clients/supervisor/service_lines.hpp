// The processes of a machine on one host, and the command line of each. Pure.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "clients/supervisor/state_directory.hpp"
#include "services/documents/placement.hpp"
#include "services/setup/machine_setup.hpp"

namespace lockstep {

enum class FpgaKind { AsConfigured, Sim, Shared };  // Sim: in the axis's process; Shared: in its own process

/// The choices of `lockstep up`.
struct Layout {
    FpgaKind fpga = FpgaKind::AsConfigured;
    bool standby = false;    // a second coordinator stands by
    bool continues = false;  // and continues a program in motion when it takes over
    bool web = false;        // serves the page although the configuration does not say so
};

struct ServiceLine {
    std::string name;                // as in the record of processes
    std::vector<std::string> words;  // the program's path and its arguments
};

/// The name of lockstep-web in the record. The machine counts as up without it.
inline constexpr const char* kWeb = "web";

/// The name, for open_window(), of a device that runs in its own process.
DeviceName shared_device(const MachineSetup& machine, const std::string& motor);

/// The machine's parts that are `placed` on this host. Devices come first, because axes attach to them. The page comes
/// last, on the coordinator's host. `programs`: the directory of the services' executables.
std::vector<ServiceLine> service_lines(const MachineSetup& machine, const Placement& placed, const Layout& layout,
                                       const std::filesystem::path& programs, const StateDirectory& state);

}  // namespace lockstep
