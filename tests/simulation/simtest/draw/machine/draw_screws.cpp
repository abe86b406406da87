#include "tests/simulation/simtest/draw/machine/draw_screws.hpp"

#include <algorithm>
#include <cmath>

#include "core/kinematics/axis_steps.hpp"
#include "tests/simulation/simtest/draw/draw.hpp"
#include "tests/simulation/simtest/record/motor_shares.hpp"

namespace lockstep::simtest {
namespace {

constexpr double kMostSlope = 0.049;  // the rules allow 0.05
constexpr double kMostAccel = 0.49;   // and half of the acceleration

class ScrewDrawer {
public:
    ScrewDrawer(std::uint64_t seed, const MachineConfig& machine)
        : draw_(seed ^ 0x5c4e35c4e35c4e3U), machine_(machine), exact_(machine) {}

    std::vector<ScrewPoint> draw(std::size_t motor, std::size_t axis) {
        std::vector<ScrewPoint> points = draw_places(machine_.axes[axis]);
        for (ScrewPoint& point : points) { point.error_mm = draw_.real(-1, 1); }
        scale(points, share(motor, axis), exact_.limits(motor));
        return points;
    }
    bool chance(double probability) { return draw_.chance(probability); }

private:
    /// mm of the motor's way for each mm of the points.
    double share(std::size_t motor, std::size_t axis) const {
        if (!exact_.moves_only(motor, axis)) { return 1; }
        return exact_.share(motor, axis) * machine_.axes[axis].steps_per_mm / exact_.steps_per_mm(motor);
    }

    std::vector<ScrewPoint> draw_places(const AxisConfig& axis) {
        const double travel = axis.position_max_mm - axis.position_min_mm;
        std::vector<double> places;
        for (std::int64_t n = draw_.chance(0.2) ? 2 : draw_.whole(3, 30); n > 0; --n) {
            places.push_back(axis.position_min_mm + travel * draw_.part());
        }
        std::ranges::sort(places);
        std::vector<ScrewPoint> points;
        for (const double place : places) {
            const bool is_apart = points.empty() || place - points.back().position_mm > travel / 1000;
            if (is_apart) { points.push_back({place, 0}); }
        }
        if (points.size() < 2) { points = {{axis.position_min_mm, 0}, {axis.position_max_mm, 0}}; }
        return points;
    }

    /// Multiplies the errors so that they are a drawn part of what the rules allow.
    void scale(std::vector<ScrewPoint>& points, double share, const MotorLimits& limits) {
        std::vector<ScrewByBezier::Point> way;
        for (const ScrewPoint& point : points) { way.push_back({share * point.position_mm, share * point.error_mm}); }
        std::ranges::sort(way, {}, &ScrewByBezier::Point::place);
        const ScrewByBezier screw(way);
        const double by_slope = kMostSlope / screw.most_slope();
        const double weaker = std::min(limits.accel, limits.decel);
        const double by_bend = kMostAccel * weaker / (screw.most_bend() * limits.top * limits.top);
        const double most = std::min(by_slope, by_bend) * draw_.magnitude(0.01, 1);
        for (ScrewPoint& point : points) { point.error_mm *= most; }
    }

    Draw draw_;
    const MachineConfig& machine_;
    MotorShares exact_;
};

}  // namespace

MachineConfig with_screws(std::uint64_t seed, MachineConfig machine) {
    ScrewDrawer drawer(seed, machine);
    std::size_t motor = 0;
    std::vector<AxisConfig> axes = machine.axes;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        if (axes[i].motors.empty()) {
            if (drawer.chance(0.65)) { axes[i].screw = drawer.draw(motor, i); }
            ++motor;
        }
        for (MotorBlock& block : axes[i].motors) {
            if (drawer.chance(0.65)) { block.screw = drawer.draw(motor, i); }
            ++motor;
        }
    }
    machine.axes = std::move(axes);
    set_steps_of_axes(machine);
    return machine;
}

}  // namespace lockstep::simtest
