#include "core/methods/carrica_off_line.hpp"

#include <cmath>

#include "core/motion/ideal.hpp"

namespace lockstep::methods {

std::expected<CarricaTable, StepError> carrica_table(const StepMove& move, const CarricaOffLineParameters& parameters) {
    const double timer_s = parameters.timer_s;
    if (auto valid = check(move); !valid) { return std::unexpected(valid.error()); }
    if (move.max * timer_s > 1) {
        return std::unexpected(StepError{.why = StepError::Why::TooFast, .most = 1 / timer_s});
    }
    if (auto valid = check_length(move, timer_s); !valid) { return std::unexpected(valid.error()); }
    CarricaTable table;
    table.reserve(static_cast<std::size_t>(move.steps));
    std::int64_t before = 0;
    for (const double time_s : Ideal(move).step_times_s(Crossing::Whole)) {
        const std::int64_t count = std::llround(time_s / timer_s);
        table.push_back(static_cast<std::uint32_t>(count - before));
        before = count;
    }
    return table;
}

StepResult carrica_off_line(const StepMove& move, Fit, const CarricaOffLineParameters& parameters) {
    const auto table = carrica_table(move, parameters);
    if (!table) { return std::unexpected(table.error()); }
    StepTrain train{.clock_s = parameters.timer_s};
    train.times_s.reserve(table->size());
    std::int64_t now = 0;
    for (const std::uint32_t wait : *table) {
        now += wait;
        train.times_s.push_back(static_cast<double>(now) * parameters.timer_s);
    }
    return train;
}

}  // namespace lockstep::methods
