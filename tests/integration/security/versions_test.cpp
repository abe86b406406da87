// Processes of incompatible versions report it, with both versions, and move nothing together.
#include <gmock/gmock.h>

#include "services/documents/machine_file.hpp"
#include "services/wire/dds/protocol_version.hpp"
#include "tests/integration/cli/own_machine.hpp"
#include "tests/integration/wire/eventually.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

class Versions : public OwnMachine {
protected:
    bool is_logged(const std::string& process, const std::string& text) const {
        return eventually([&] { return tail_of(state().log_file(process), 1000).find(text) != std::string::npos; });
    }
};

TEST_F(Versions, OfTheProtocolAreNamedByEveryProcess) {
    bring_up();
    const MachineSetup machine = load_machine_file(file()).value();
    const std::string newer = std::to_string(kProtocol + 1);
    const ChildProcess other(LOCKSTEP_FOREIGN_PEER,
                             {std::to_string(machine.network.domain), machine.name, "protocol", newer, "-"});
    for (const char* process : {"coordinator", "axis-X", "axis-Y"}) {
        EXPECT_TRUE(is_logged(process, "uses protocol " + newer + ", this one " + std::to_string(kProtocol)));
    }
    EXPECT_EQ(status().phase(), "Idle");
}

TEST_F(Versions, OfTheConfigurationAreNamedAndNothingMoves) {
    MachineSetup machine = load_machine_file(file()).value();
    machine.axes[0].max_velocity_mm_s = 100;
    const std::string changed = write("changed.textproto", machine_text(machine));
    const ChildProcess coordinator(LOCKSTEP_COORDINATOR, {"--machine", file(), "--log", write("coordinator.log", "")});
    const ChildProcess x(LOCKSTEP_AXIS, {"--machine", file(), "--axis", "X"});
    const ChildProcess y(LOCKSTEP_AXIS, {"--machine", changed, "--axis", "Y"});
    EXPECT_TRUE(eventually([&] {
        return tail_of(folder() / "coordinator.log", 1000).find("axis Y runs configuration ") != std::string::npos;
    }));
    const Ran moved = run_lockstep({"home"});
    EXPECT_EQ(moved.code, 1) << moved.out << moved.err;
    EXPECT_THAT(moved.err + moved.out, HasSubstr("config"));
}

}  // namespace
}  // namespace lockstep
