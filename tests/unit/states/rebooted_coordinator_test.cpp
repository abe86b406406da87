// The coordinator's host starts again, and its clock restarts, in any state of the machine: the axes rest, take
// over the new time, and the offered remedies lead back to jobs that run.
#include <algorithm>

#include "tests/unit/states/machine_states.hpp"
#include "tests/unit/virtual/true_clocks.hpp"

namespace lockstep {
namespace {

VirtualOptions on_boards() {
    VirtualOptions options{.machine = small_machine()};
    options.machine.timing.time_source = TimeSource::Network;
    options.machine.timing.clock_error_limit_us = 250;
    options.network = {.delay_min{20}, .delay_max{200}};
    options.start = Tick{30'000'000};
    options.clocks = test::clocks_apart();
    return options;
}

/// Boards have their own clocks, so these are only the states that can be entered with any clocks.
std::vector<MachineSituation> situations_on_boards() {
    std::vector<MachineSituation> chosen;
    for (const char* name :
         {"starting, an axis missing", "unhomed", "homing", "homing, stopping", "idle", "running", "stopping to hold",
          "stopping", "holding", "resuming", "paused (M0)", "own move", "own move, stopping", "limit hit",
          "emergency stop", "axis lost", "coordinator silent in homing"}) {
        const auto found = std::ranges::find(situations(), name, &MachineSituation::name);
        EXPECT_NE(found, situations().end()) << name;
        if (found != situations().end()) { chosen.push_back(*found); }
    }
    return chosen;
}

std::vector<double> places_of(Walker& m) {
    std::vector<double> places;
    for (std::size_t i = 0; i < 2; ++i) { places.push_back(m.vm.device(i).plant().position_mm()); }
    return places;
}

class RebootedCoordinator : public testing::TestWithParam<MachineSituation> {};

TEST_P(RebootedCoordinator, WithAYoungerClockRunsJobsAgainByTheRemediesOffered) {
    constexpr std::size_t kCoordinator = 2;
    Walker m(on_boards());
    m.wait(20);  // the reboot then sets the clock back too far to be slewed
    GetParam().enter(m);
    if (HasFatalFailure()) { return; }
    const Slot before = m.vm.state()->stamp;
    m.inject({.kind = VirtualFault::Kind::Crash, .process = kCoordinator, .reboots = true}, 2);
    m.wait(1.5);
    const auto rests_at = places_of(m);
    m.wait(0.3);
    EXPECT_EQ(places_of(m), rests_at) << "without a coordinator nothing moves";
    m.wait(15);
    EXPECT_LT(m.vm.state()->stamp, before) << "the clock is younger";
    EXPECT_TRUE(m.recovers()) << m.state_text();
}

INSTANTIATE_TEST_SUITE_P(All, RebootedCoordinator, testing::ValuesIn(situations_on_boards()), situation_name);

}  // namespace
}  // namespace lockstep
