#include "sim_fpga/contacts/reach.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep {

Reach Reach::of(const AxisConfig& axis, const MachineConfig& machine) {
    const double tick_s = 1 / machine.ticks_per_second();
    return {.most = axis.max_velocity_mm_s * tick_s,
            .start = axis.start_velocity_mm_s * tick_s,
            .accel = std::max(axis.max_accel_mm_s2, axis.max_decel_mm_s2) * tick_s * tick_s};
}

Reach Reach::with(const Reach& other) const {
    return {std::hypot(most, other.most), std::hypot(start, other.start), std::hypot(accel, other.accel)};
}

double Reach::mm(double way_mm, Ticks last, Ticks next) const {
    const auto before = static_cast<double>(last.value);
    const auto ticks = static_cast<double>(next.value);
    const double was = last > Ticks{} ? way_mm / before : most;
    return std::min(most, 3 * was + start + accel * (before + ticks)) * ticks;
}

}  // namespace lockstep
