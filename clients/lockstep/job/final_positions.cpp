#include "clients/lockstep/job/final_positions.hpp"

#include "clients/session/reports.hpp"
#include "services/runtime/clock.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

constexpr nanoseconds kFinalStatePatience = 1s;

}  // namespace

void add_final_positions(Session& session, proto::RunReport& report) {
    const nanoseconds end = monotonic_now();
    const MachineConfig& machine = session.config();
    for (const AxisIndex i : axis_indices(machine.axes.size())) {
        const auto rests = [&] {
            return session.received().axis(i) && session.received().axis(i)->time > end &&
                   session.received().axis(i)->state.at_rest;
        };
        if (session.receive_until(end + kFinalStatePatience - monotonic_now(), rests)) {
            *report.add_final_positions() =
                place_of(machine.axes[i], session.received().axis(i)->state.position.count());
        }
    }
}

}  // namespace lockstep
