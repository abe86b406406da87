// Prints for some seeds the number of steps of a drawn machine and their hash, and the same of a delta.
#include <array>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>

#include "tests/simulation/simtest/run/play/play.hpp"
#include "tests/unit/virtual/motors/delta_machine.hpp"

namespace lockstep::simtest {
namespace {

/// Counts steps and sums them up by FNV-1a.
class StepSum : public VirtualObserver {
public:
    void on_step(MotorIndex axis, StepEdge step) override {
        ++steps_;
        for (const auto value : {static_cast<std::uint64_t>(axis), static_cast<std::uint64_t>(step.tick.value),
                                 static_cast<std::uint64_t>(step.direction)}) {
            hash_ = (hash_ ^ value) * 0x100000001b3;
        }
    }
    std::uint64_t steps() const { return steps_; }
    std::uint64_t hash() const { return hash_; }

private:
    std::uint64_t steps_ = 0;
    std::uint64_t hash_ = 0xcbf29ce484222325;
};

/// Homes a delta, and moves it along lines, a circle and a helix.
bool play_delta(StepSum& sum) {
    constexpr Ticks kMost{100'000'000};
    VirtualMachine vm({.machine = delta_machine()});
    vm.observe(sum);
    const auto rests_behind = [&](std::uint64_t job) {
        return vm.advance_until(
            [&] { return vm.state() && vm.state()->job >= job && vm.state()->phase == MachinePhase::Idle; }, kMost);
    };
    const ArcShape about_0{.first = 0, .second = 1};
    const ArcShape twice{.first = 0, .second = 1, .centre_first_mm = 20, .is_clockwise = true, .turns = 2};
    Program program{.name = "delta", .axes = {"X", "Y", "Z"}, .start_mm = {0, 0, 80}};
    for (const ProgramMove& move : {ProgramMove{{45, 0, 40}, 0, true}, ProgramMove{{45, 0, 40}, 60, false, about_0},
                                    ProgramMove{{-55.5, 31.7, 2.25}, 90}, ProgramMove{{50, -50, 10}, 90},
                                    ProgramMove{{35, 0, 30}, 0, true}, ProgramMove{{35, 0, 12.5}, 40, false, twice}}) {
        program.blocks.push_back({.action = move});
    }
    if (!rests_behind(0)) { return false; }
    (void)vm.command(CommandKind::Home);
    if (!rests_behind(1)) { return false; }
    vm.give_program(1, program);
    (void)vm.command(CommandKind::Run, {}, 1);
    return rests_behind(2);
}

}  // namespace
}  // namespace lockstep::simtest

int main(int argc, char** argv) {
    using namespace lockstep::simtest;
    if (argc != 3) {
        std::fprintf(stderr, "usage: machine_steps FIRST_SEED RUNS\n");
        return 2;
    }
    const std::uint64_t first = std::strtoull(argv[1], nullptr, 10);
    const std::uint64_t runs = std::strtoull(argv[2], nullptr, 10);
    for (std::uint64_t seed = first; seed < first + runs; ++seed) {
        const Played played = play(draw_scenario(seed, FaultKinds::all(), {}));
        std::printf("seed %" PRIu64 ": %" PRIu64 " steps, hash %016" PRIx64 ", %zu violations\n", seed,
                    played.recording.steps(), played.recording.hash(), played.violations.size());
    }
    StepSum delta;
    if (!play_delta(delta)) {
        std::fprintf(stderr, "the delta did not finish its program\n");
        return 1;
    }
    std::printf("delta: %" PRIu64 " steps, hash %016" PRIx64 "\n", delta.steps(), delta.hash());
    return 0;
}
