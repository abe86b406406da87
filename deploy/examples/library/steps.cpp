// Uses the step engine alone: an axis accelerates from rest over 100 steps, and each step falls on a tick. Built on the
// package lockstep-dev: find_package(lockstep), then link lockstep::lockstep_core.
#include <cstdio>

#include "core/step/engine.hpp"

int main() {
    using namespace lockstep;
    constexpr Ticks kTicks{200'000};
    constexpr Int128 kTriangle = Int128{kTicks.value} * (kTicks.value + 1) / 2;  // a + 2a + ... + na
    const Acceleration acceleration{static_cast<std::int64_t>(Displacement::steps(100).raw / kTriangle)};

    StepEngine engine;
    engine.begin({kTicks, Velocity{}, acceleration});
    int steps = 0;
    Tick last;
    engine.run(Tick{} + kTicks, [&](StepEdge step) {
        ++steps;
        last = step.tick;
    });
    std::printf("%d steps, the last at tick %lld of %lld\n", steps, static_cast<long long>(last.value),
                static_cast<long long>(kTicks.value));
    return steps == 100 ? 0 : 1;
}
