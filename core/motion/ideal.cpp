#include "core/motion/ideal.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep {
namespace {

/// The time to cover x from speed v under acceleration a: the root of x = v t + a t^2 / 2, written so that nothing
/// cancels.
double time_to_cover(double x, double v, double a) { return x <= 0 ? 0 : 2 * x / (v + std::sqrt(v * v + 2 * a * x)); }

}  // namespace

Ideal::Ideal(const StepMove& move) : move_(move) {
    const double a = move.acceleration;
    const double d = move.deceleration;
    const double v0 = move.start;
    const auto n = static_cast<double>(move.steps);
    peak_ = std::min(move.max, std::sqrt((2 * a * d * n + (a + d) * v0 * v0) / (a + d)));
    rise_steps_ = (peak_ * peak_ - v0 * v0) / (2 * a);
    fall_steps_ = (peak_ * peak_ - v0 * v0) / (2 * d);
    rise_s_ = (peak_ - v0) / a;
    fall_s_ = (peak_ - v0) / d;
    cruise_s_ = std::max(0.0, n - rise_steps_ - fall_steps_) / peak_;
}

double Ideal::time_s(double position) const {
    const double left = static_cast<double>(move_.steps) - position;
    if (position <= rise_steps_) { return time_to_cover(position, move_.start, move_.acceleration); }
    if (left <= fall_steps_) { return duration_s() - time_to_cover(left, move_.start, move_.deceleration); }
    return rise_s_ + (position - rise_steps_) / peak_;
}

std::vector<double> Ideal::step_times_s(Crossing crossing) const {
    std::vector<double> times(static_cast<std::size_t>(move_.steps));
    const double before = crossing == Crossing::Half ? 0.5 : 0;
    for (std::size_t i = 0; i < times.size(); ++i) { times[i] = time_s(static_cast<double>(i + 1) - before); }
    return times;
}

std::vector<Ideal::Corner> Ideal::corners() const {
    return {{0, move_.start}, {rise_s_, peak_}, {rise_s_ + cruise_s_, peak_}, {duration_s(), move_.start}};
}

}  // namespace lockstep
