#include "tests/simulation/simtest/run/play/play.hpp"

#include <cmath>

#include "core/kinematics/following_error.hpp"
#include "tests/simulation/simtest/record/explain.hpp"
#include "tests/simulation/simtest/run/play/play_correction.hpp"
#include "tests/simulation/simtest/run/play/play_job.hpp"
#include "tests/simulation/simtest/run/play/play_jogs.hpp"

namespace lockstep::simtest {
namespace {

/// The slide is at its true place as exactly as its motor was homed. Where motors are not those of one axis each, an
/// axis that homes by touch has finer steps than they, and the touch, the switch and the park are rounded to these,
/// too.
void check_slides(Bench& bench, const Counts& at) {
    constexpr double kFinerSteps = 16;
    const double rounded = bench.map().is_direct() ? 0 : 1.5 / kFinerSteps;
    for (std::size_t i = 0; i < at.size() && !bench.over(); ++i) {
        const MotorConfig& motor = bench.kinematics().motors()[i];
        const bool was_pushed = may_be_stopped(bench.recording(), i, bench.recording().began, bench.vm().now());
        const bool in_place = !row_of(motor.homing.way).searches;
        if (in_place && was_pushed) { continue; }
        const double mm = static_cast<double>(at[i] + bench.slipped(i)) / motor.steps_per_mm;
        const double is = bench.vm().device(i).plant().position_mm();
        // In place: as exactly as it was put there.
        const bool was_put = in_place && !corrects(bench.machine()) && !bench.homed_by_touch().contains(MotorIndex{i});
        const double most =
            was_put ? static_cast<double>(most_following_error(motor)) : bench.homed_within(MotorIndex{i}) + rounded;
        if (std::abs(is - mm) * motor.steps_per_mm > most) {
            bench.object("place",
                         motor.name + " stands at " + std::to_string(is) + " mm instead of " + std::to_string(mm));
        }
    }
}

/// The reported position, the encoder and the sum of the pulses agree.
void check_places(Bench& bench, const Counts& at) {
    bench.wait_slots(bench.lossy() ? 40 : 4);
    for (std::size_t i = 0; i < at.size(); ++i) {
        const std::string& name = bench.kinematics().motors()[i].name;
        const auto& state = bench.vm().axis_states()[i];
        std::int64_t pulses = 0;
        for (const StepEdge& step : bench.recording().motors[i].steps) { pulses += step.direction; }
        const std::int64_t encoder = bench.vm().device(i).plant().encoder() - bench.moved_by_hand(i);
        // A motor that is stopped at speed may lose steps; homing then corrects its position.
        const bool moved = may_be_stopped(bench.recording(), i, bench.recording().began, bench.vm().now());
        if (encoder != pulses && bench.recording().emergencies.empty() && !moved) {
            bench.object("lost", name + " has moved " + std::to_string(encoder) + " steps after " +
                                     std::to_string(pulses) + " pulses");
        } else if (!state || state->position.count() - state->play_steps != at[i] || !state->homed || !state->at_rest) {
            bench.object("place", name + " does not report that it rests homed at step " + std::to_string(at[i]));
        }
    }
}

void play_all(const Scenario& scenario, Bench& bench) {
    Counts at(bench.map().motors(), 0);
    const double listening = (3 * scenario.machine.timing.freshness_slots + 30) * bench.slot_s();
    (void)bench.await([&] { return bench.watch().phase() == MachinePhase::Idle; }, listening, "power-up");
    for (const WrongCommand& wrong : scenario.before_homing) { play_refusal(bench, wrong, at); }
    bench.plan(scenario.homing_faults);
    if (!bench.over()) { play_homing(bench, at, scenario.homing_stop); }
    bench.plan({});
    make_ready(bench, at);
    check_slides(bench, at);
    for (const Task& task : scenario.tasks) {
        for (const WrongCommand& wrong : task.before) { play_refusal(bench, wrong, at); }
        for (const JogSession& jogs : task.jogs) {
            bench.plan(jogs.faults);
            if (!bench.over()) { JogPlayer(bench, jogs, at).play(); }
            bench.plan({});
            make_ready(bench, at);
        }
        bench.plan(task.faults);
        if (!bench.over()) { JobPlayer(bench, task, at).play(); }
        bench.plan({});
        make_ready(bench, at);
        if (corrects(bench.machine())) { check_slides(bench, at); }
    }
    if (!bench.over()) { check_places(bench, at); }
}

void play_on(Bench& bench, const Scenario& scenario, Played& played) {
    played.recording.began = bench.vm().now();
    play_all(scenario, bench);
    played.recording.ended = bench.vm().now();
    played.coverage.take(bench.vm().alterations());
}

}  // namespace

Played play(const Scenario& scenario, std::span<VirtualObserver* const> also) {
    Played played;
    played.recording.machine = scenario.machine;
    played.recording.network = scenario.network;
    played.recording.motors.resize(motor_count(scenario.machine), {.power_up = scenario.power_up});
    for (std::size_t i = 0; i < scenario.clocks.size(); ++i) {
        played.recording.motors[i].clock = scenario.clocks[i].device;
        played.recording.motors[i].lateness = scenario.lateness(i);
    }
    const MotorShares map(scenario.machine);
    for (std::size_t m = 0; m < map.motors(); ++m) {
        played.recording.motors[m].play = map.play(m);
        played.recording.motors[m].mates = map.mates(m);
    }
    {
        Bench bench(scenario, played);
        for (VirtualObserver* const observer : also) { bench.vm().observe(*observer); }
        play_on(bench, scenario, played);
    }
    append(played.violations, played.recording.untrue);
    for (const std::string& trouble : played.recording.troubles) {
        played.violations.push_back({"trouble", {}, {}, {}, trouble});
    }
    return played;
}

}  // namespace lockstep::simtest
