// The arcs of random splines follow the splines. Bernstein's polynomials, which the product does not use, give the
// places of the curve.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/arc_path.hpp"
#include "core/gcode/curves/spline_arcs.hpp"

namespace lockstep::gcode {
namespace {

using Random = std::mt19937_64;
using Place = std::array<double, 2>;

/// The place at `share` of a spline of one span with weights.
Place on_curve(const Spline& spline, double share) {
    const int degree = spline.order - 1;
    Place at{};
    double all = 0;
    double choose = 1;
    for (int i = 0; i <= degree; ++i) {
        const Spline::Control& control = spline.controls[static_cast<std::size_t>(i)];
        const double weight = control.weight * choose * std::pow(share, i) * std::pow(1 - share, degree - i);
        at = {at[0] + control.at[0] * weight, at[1] + control.at[1] * weight};
        all += weight;
        choose = choose * (degree - i) / (i + 1);
    }
    return {at[0] / all, at[1] / all};
}

Spline random_spline(Random& random) {
    std::uniform_real_distribution<> place(0, 50);
    Spline spline{.target = {}, .order = 2 + static_cast<int>(random() % 5), .controls = {}, .feed = 600};
    for (int i = 0; i < spline.order; ++i) {
        const bool repeats = i > 0 && random() % 10 == 0;
        const double weight = random() % 2 == 0 ? 1 : 0.2 + place(random) / 10;
        const Vector at = repeats ? spline.controls.back().at : Vector{place(random), place(random), 0};
        spline.controls.push_back({at, weight});
    }
    spline.target = {spline.controls.back().at[0], spline.controls.back().at[1]};
    return spline;
}

struct Part {
    Place from;
    Place to;
    const Arc* arc;  // null if the part is straight
};

double distance(Place place, const Part& part) {
    const double x = part.to[0] - part.from[0];
    const double y = part.to[1] - part.from[1];
    const double square = x * x + y * y;
    const double along = (place[0] - part.from[0]) * x + (place[1] - part.from[1]) * y;
    const double share = square > 0 ? std::min(1.0, std::max(0.0, along / square)) : 0;
    if (part.arc != nullptr && along >= 0 && along <= square) {
        const double radius = std::hypot(part.from[0] - part.arc->centre[0], part.from[1] - part.arc->centre[1]);
        return std::abs(std::hypot(place[0] - part.arc->centre[0], place[1] - part.arc->centre[1]) - radius);
    }
    return std::hypot(place[0] - part.from[0] - share * x, place[1] - part.from[1] - share * y);
}

void expect_followed(std::uint64_t seed, double tolerance_mm) {
    Random random(seed);
    const Spline spline = random_spline(random);
    const Point from{spline.controls[0].at[0], spline.controls[0].at[1]};
    std::vector<Action> actions;
    cut_into_arcs(spline, from, tolerance_mm, [&](const Action& action) { actions.push_back(action); });
    std::vector<Part> parts;
    Place at{from[0], from[1]};
    for (const Action& action : actions) {
        const auto* arc = std::get_if<Arc>(&action);
        const Point& target = arc != nullptr ? arc->target : std::get<Straight>(action).target;
        parts.push_back({at, {target[0], target[1]}, arc});
        at = parts.back().to;
    }
    EXPECT_EQ(at, (Place{spline.target[0], spline.target[1]}));
    EXPECT_LT(parts.size(), 4000U);
    std::size_t first = 0;
    constexpr int kPlaces = 5000;
    for (int k = 0; k <= kPlaces; ++k) {
        const Place place = on_curve(spline, static_cast<double>(k) / kPlaces);
        while (first < parts.size() && distance(place, parts[first]) > tolerance_mm) { ++first; }
        ASSERT_LT(first, parts.size()) << "leaves the arcs at " << k << " of " << kPlaces;
    }
    const bool rest_is_short = distance(at, {parts[first].to, parts[first].to, nullptr}) <= tolerance_mm;
    EXPECT_TRUE(first + 3 >= parts.size() || rest_is_short) << "the arcs end where the curve ends";
}

TEST(SplineArcs, FollowTheSplineToItsEnd) {
    for (std::uint64_t seed = 1; seed <= 300 && !HasFatalFailure(); ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        for (const double tolerance_mm : {1e-6, 1e-4, 1.25e-3}) {
            SCOPED_TRACE("within " + std::to_string(tolerance_mm) + " mm");
            expect_followed(seed, tolerance_mm);
        }
    }
}

}  // namespace
}  // namespace lockstep::gcode
