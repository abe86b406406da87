// An axis's position over time, as a limited number of knots for any number of steps.
//
// A step occurs when the position crosses a half, so each step gives one point of the true course: (its tick, the
// previous count + direction / 2). A straight line replaces points while it passes each within the tolerance (Bristol's
// swinging door, 1990, one pass in constant memory). If there are too many knots, the tolerance doubles.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/units.hpp"
#include "services/record/reading/step_stream.hpp"

namespace lockstep::analysis {

struct Knot {
    Tick tick;
    double position_steps = 0;
    bool joined = true;  // false: no line joins it to the previous knot
    bool operator==(const Knot&) const = default;
};

class Trace final : public StepListener {
public:
    static constexpr double kTolerance = 0.25;  // steps
    static constexpr std::size_t kMaxKnots = 200'000;

    explicit Trace(std::size_t max_knots = kMaxKnots) : max_knots_(max_knots) {}

    void on_batch(const StepBatch& batch) override;
    void on_break(const Break& what) override;
    /// Ends the last line at the whole step on which the axis came to rest.
    void finish();

    const std::vector<Knot>& knots() const { return knots_; }
    /// The maximum distance of a line from a step that it represents, in steps.
    double tolerance_steps() const { return error_; }

private:
    static constexpr std::size_t kBlock = 16;
    bool block(const StepSpan& steps);
    bool goes_on(const StepSpan& steps) const;
    void step(StepEdge edge, std::int64_t position_before);
    void rest(Tick until, std::int64_t position);
    void point(Tick tick, double position);
    void end_line();
    void keep(Knot knot);
    void thin_out();

    std::size_t max_knots_;
    double tolerance_ = kTolerance;
    double error_ = kTolerance;
    std::vector<Knot> knots_;
    bool joined_ = false;         // the next point continues the line
    std::optional<Knot> newest_;  // the current end of the line; nullopt right after a knot
    double low_slope_ = 0;        // range of the slopes of lines that still pass every point
    double high_slope_ = 0;
    std::optional<Tick> last_step_;
    Ticks last_interval_;  // between the two previous steps; 0: unknown
    std::int64_t position_ = 0;
};

}  // namespace lockstep::analysis
