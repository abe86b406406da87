// The example programs on a live mill: run to their end, every step as planned, and their offsets kept.
#include <gmock/gmock.h>

#include "idl/proto/values.pb.h"
#include "services/documents/machine_file.hpp"
#include "tests/integration/cli/own_machine.hpp"

namespace lockstep {
namespace {

const std::string kExamples = "deploy/examples/";

struct Example {
    const char* program;
    int systems;  // coordinate systems that it leaves set
    friend std::ostream& operator<<(std::ostream& out, const Example& example) { return out << example.program; }
};

class ExamplePrograms : public OwnMachine, public testing::WithParamInterface<Example> {
protected:
    void configure(MachineSetup& machine) override {
        const auto mill = load_machine_file(kExamples + "three-axis.textproto");
        ASSERT_TRUE(mill);
        machine.axes = mill->axes;
    }
    void SetUp() override {
        OwnMachine::SetUp();
        bring_up();
        record();
        const Ran home = run_lockstep({"home"});
        ASSERT_EQ(home.code, 0) << home.out << home.err;
    }
};

TEST_P(ExamplePrograms, EndParkedAndAsPlanned) {
    const Ran run = run_lockstep({"run", kExamples + GetParam().program, "--json"});
    ASSERT_EQ(run.code, 0) << run.out << run.err;
    const auto report = run.json<proto::RunReport>();
    const std::vector<double> park{5, 5, 58};
    ASSERT_EQ(report.final_positions_size(), 3);
    for (int i = 0; i < 3; ++i) {
        EXPECT_DOUBLE_EQ(report.final_positions(i).position_mm(), park[static_cast<std::size_t>(i)]);
    }
    const auto values = run_lockstep({"offsets", "--json"}).json<proto::KeptValues>();
    EXPECT_EQ(values.system_size(), GetParam().systems);
    EXPECT_FALSE(values.g92_applies());
    expect_verified();
}

INSTANTIATE_TEST_SUITE_P(Programs, ExamplePrograms,
                         testing::Values(Example{"pocket.gcode", 1}, Example{"drilling.gcode", 2},
                                         Example{"contour.gcode", 1}),
                         [](const auto& one) {
                             const std::string name = one.param.program;
                             return name.substr(0, name.find('.'));
                         });

}  // namespace
}  // namespace lockstep
