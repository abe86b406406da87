#include "tests/benchmarks/planners/speed_changes.hpp"

#include "tests/benchmarks/planners/trapezoid.hpp"

namespace lockstep::planners {
namespace {

Vector ahead(const Vector& from, const Vector& direction, double mm) {
    Vector place = from;
    for (std::size_t i = 0; i < kAxes; ++i) { place[i] += direction[i] * mm; }
    return place;
}

}  // namespace

ChangeShares changes_of(const std::vector<StraightMove>& moves, const Speeds& speeds, const Limits& limits) {
    Vector from{};
    SpeedChanges changes(limits, from);
    double next = kSample_s;  // time of the next sample, from the begin of the phase
    for (std::size_t k = 0; k < moves.size(); ++k) {
        double way = 0;
        for (const Phase& phase : phases_of(speeds[k], moves[k].length_mm)) {
            const auto way_at = [&](double t) { return way + (phase.velocity + phase.acceleration * t / 2) * t; };
            for (; next <= phase.seconds; next += kSample_s) {
                changes.take(ahead(from, moves[k].direction, way_at(next)));
            }
            next -= phase.seconds;
            way = way_at(phase.seconds);
        }
        from = ahead(from, moves[k].direction, moves[k].length_mm);
    }
    changes.take(from);
    changes.finish();
    return changes.shares();
}

}  // namespace lockstep::planners
