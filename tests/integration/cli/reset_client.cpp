#include "tests/integration/cli/reset_client.hpp"

#include <chrono>
#include <thread>

#include "services/wire/bus/bus.hpp"
#include "services/wire/dds/dds_log.hpp"
#include "tests/integration/wire/eventually.hpp"

namespace lockstep {

bool reset_often(const MachineSetup& machine, int times) {
    forward_dds_log([](const std::string&) {});  // drops DDS's messages at the client's end
    auto client = open_bus<ClientBus>(machine.network, machine.name);
    if (!client || !eventually([&] { return client->commands.matched() > machine.axes.size(); })) { return false; }
    Command reset{.client = 1, .kind = CommandKind::Reset};
    for (int i = 0; i < times; ++i) {
        ++reset.sequence;
        (void)client->commands.write(reset);
        std::this_thread::sleep_for(machine.timing.slot_us * std::chrono::microseconds{2});  // until it is carried out
    }
    return true;
}

}  // namespace lockstep
