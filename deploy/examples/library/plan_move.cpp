// Plans one move by each published method of step generation, and prints its duration and its first steps.
#include <cstdio>

#include "core/methods/methods.hpp"

int main() {
    using namespace lockstep;
    const StepMove move{.steps = 2000, .start = 200, .max = 8000, .acceleration = 40'000, .deceleration = 40'000};
    for (const methods::Method& method : methods::methods()) {
        const methods::StepResult train = method.run(move, methods::Fit::Nearest);
        if (!train) {
            std::printf("%-20s %s\n", method.name.data(), text_of(train.error()).c_str());
            continue;
        }
        const auto& times = train->times_s;
        std::printf("%-20s %7.4f s; the first steps at %.6f, %.6f, %.6f s  %s\n", method.name.data(), times.back(),
                    times[0], times[1], times[2], train->nearest.c_str());
    }
}
