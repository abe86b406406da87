#include "tests/simulation/simtest/draw/draw_bounces.hpp"

#include "tests/simulation/simtest/draw/draw.hpp"

namespace lockstep::simtest {

void give_bounces(std::uint64_t seed, Scenario& scenario) {
    Draw draw(seed ^ 0xb0c7ceb0c7ceb0c7U);
    for (InputConfig& input : scenario.machine.inputs) {
        // A switch that bounces for longer is at another place at each touch, and is a fault of its own.
        const bool is_short = draw.chance(0.5) || input.use == InputUse::Home;
        const double most_ms = is_short ? 0.9 * input.debounce_ms : 10;
        input.simulated_bounce_ms = most_ms * draw.part();
    }
}

}  // namespace lockstep::simtest
