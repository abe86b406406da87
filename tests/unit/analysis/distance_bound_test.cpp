// The bound of the distance from a curve, compared with the distance itself.
#include "clients/analysis/moves/distance_bound.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "clients/analysis/asked/asked_shape.hpp"

namespace lockstep::analysis {
namespace {

struct Curve {
    std::string name;
    std::vector<double> from;
    std::vector<double> to;
    std::optional<ArcShape> arc;
    /// For GoogleTest.
    friend void PrintTo(const Curve& curve, std::ostream* out) { *out << curve.name; }
};

std::vector<Curve> curves() {
    const ArcShape centre{.first = 0, .second = 1, .centre_first_mm = 50, .centre_second_mm = 40};
    ArcShape backwards = centre;
    backwards.is_clockwise = true;
    ArcShape turns = centre;
    turns.turns = 2;
    return {{"line", {50, 40, 10}, {70, 52, 3}, std::nullopt},
            {"circle", {60, 40, 10}, {60, 40, 10}, centre},
            {"arc", {60, 40, 10}, {50, 50, 10}, backwards},
            {"helix", {60, 40, 10}, {60, 40, 4}, turns},
            {"spiral", {60, 40, 10}, {39.98, 40, 10}, centre}};
}

class Bound : public testing::TestWithParam<Curve> {};

/// Places go along the curve in steps, each axis on its own, and now and then beside it.
TEST_P(Bound, FindsEveryStepThatIsFarther) {
    constexpr double kStep_mm = 0.01;
    const auto& [name, from, to, arc] = GetParam();
    AskedShape shape(from, to, arc);
    AskedShape measured = shape;
    DistanceBound bound;
    std::mt19937 random(1);
    std::vector<double> at = from;
    double farthest = 0;
    int measured_steps = 0;
    int steps = 0;
    Places places;
    places.mm.resize(at.size());
    const auto measure = [&] {
        std::size_t next = bound.first_farther(places, 0, farthest);
        for (std::size_t place = 0; place < places.size; ++place, ++steps) {
            std::vector<double> its(at.size());
            places.get(place, its);
            const double square = measured.square_of_distance(its);
            if (place < next) {
                EXPECT_LE(square, farthest + 1e-12);
                continue;
            }
            farthest = std::max(farthest, square);
            (void)shape.square_of_distance(its);
            bound.set(shape);
            ++measured_steps;
            next = bound.first_farther(places, place + 1, farthest);
        }
        places.size = 0;
    };
    for (double share = 0; share <= 1; share += 2e-5) {
        for (std::size_t axis = 0; axis < at.size(); ++axis) {
            const double on_curve =
                arc ? ArcPath(*arc, from, to).at(axis, share) : std::lerp(from[axis], to[axis], share);
            const double goal = std::round(on_curve / kStep_mm + (random() % 40 == 0 ? 1 : 0)) * kStep_mm;
            if (std::abs(goal - at[axis]) < kStep_mm / 2) { continue; }
            at[axis] = goal;
            for (std::size_t i = 0; i < at.size(); ++i) { places.mm[i][places.size] = at[i]; }
            if (++places.size == Places::kMost) { measure(); }
        }
    }
    EXPECT_GT(steps, 1000);
    EXPECT_LT(measured_steps, steps / 3) << "the bound spares most measurements";
}

INSTANTIATE_TEST_SUITE_P(Curves, Bound, testing::ValuesIn(curves()),
                         [](const auto& curve) { return curve.param.name; });

}  // namespace
}  // namespace lockstep::analysis
