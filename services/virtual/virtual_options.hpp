// What a virtual machine consists of: its machine, its network, its clocks and its links to devices.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/coordinator/coordinator.hpp"
#include "core/flight/flight_event.hpp"
#include "services/setup/machine_setup.hpp"
#include "services/virtual/late_link.hpp"
#include "services/virtual/virtual_clock.hpp"
#include "services/virtual/virtual_network.hpp"

namespace lockstep {

struct VirtualOptions {
    MachineSetup machine;
    std::uint64_t config_hash = 1;
    std::uint64_t seed = 1;
    NetworkBehaviour network;
    Tick start{1'000'000};
    int loops_per_slot = 2;        // each process runs its loop at a random phase
    bool keeps_positions = false;  // an axis's position outlives its process
    OnTakeover on_takeover = OnTakeover::Stop;
    std::size_t coordinators = 1;  // the first to claim the machine owns it, the others stand by
    /// The clocks of each axis. Axes without an entry read the true time, like the coordinator. Clocks that differ need
    /// a machine with time_source Network.
    std::vector<AxisClocks> clocks;
    /// How late the device of each axis answers. Axes without an entry use its registers. A device that answers late
    /// has its own clock, so its axis must estimate one (estimates_clock).
    std::vector<LinkDelay> links;
    /// The abilities of each motor's device. A motor without an entry has a simulated device with the usual ones.
    std::vector<DeviceAbilities> devices;
    /// Returns the flight log of a process; called at each of its starts. Empty: no process has one.
    std::function<FlightLog&(std::size_t process)> flight;
    /// Makes the stores in which coordinators keep programs.
    MakeRows make_rows = memory_rows;
};

}  // namespace lockstep
