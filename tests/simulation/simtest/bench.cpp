#include "tests/simulation/simtest/bench.hpp"

#include <cmath>

namespace lockstep::simtest {

Bench::Bench(const Scenario& scenario, Played& played)
    : scenario_(scenario),
      played_(played),
      vm_({.machine = scenario.machine, .seed = scenario.seed, .network = scenario.network}),
      recorder_(played.recording) {
    vm_.observe(recorder_);
    vm_.observe(watch_);
}

void Bench::object(const std::string& rule, const std::string& text) {
    played_.violations.push_back({rule, {}, vm_.now().value, {}, text});
    over_ = true;
}

bool Bench::await(const std::function<bool()>& done, double seconds, const std::string& what) {
    if (over_) { return false; }
    const Ticks limit{static_cast<std::int64_t>(std::ceil(seconds * machine().ticks_per_second()))};
    const auto faulted = [this] { return watch_.phase() == MachinePhase::Fault; };
    const bool in_time = vm_.advance_until([&] { return done() || faulted(); }, limit);
    if (done()) { return true; }
    if (faulted() && lossy()) {
        over_ = true;
        played_.fault = watch_.fault();
    } else if (faulted()) {
        object("fault", "while " + what + ": " + std::string(name_of(watch_.fault())));
    } else if (!in_time) {
        object("liveness", what + " takes longer than " + std::to_string(seconds) + " s");
    }
    return false;
}

void Bench::wait(double seconds) {
    const Tick until = vm_.now() + Ticks{static_cast<std::int64_t>(seconds * machine().ticks_per_second())};
    while (vm_.now() < until) { vm_.advance(); }
}

const Reply* Bench::ask(CommandKind kind, std::uint64_t program) {
    constexpr int kMostRepeats = 20;
    if (over_) { return nullptr; }
    const std::uint64_t sequence = vm_.command(kind, 0, program);
    for (int tries = 0; lossy() && tries < kMostRepeats && vm_.reply_to(sequence) == nullptr; ++tries) {
        wait_slots(kAnswerSlots);
        if (vm_.reply_to(sequence) == nullptr) { vm_.repeat_command(); }
    }
    const bool answered =
        await([&] { return vm_.reply_to(sequence) != nullptr; }, kAnswerSlots * slot_s(), "an answer");
    return answered ? vm_.reply_to(sequence) : nullptr;
}

std::uint64_t Bench::send_program(Program program) {
    vm_.give_program(++programs_, std::move(program));
    return programs_;
}

std::vector<std::size_t> Bench::steps_made() const {
    std::vector<std::size_t> made;
    for (const AxisRecord& axis : played_.recording.axes) { made.push_back(axis.steps.size()); }
    return made;
}

}  // namespace lockstep::simtest
