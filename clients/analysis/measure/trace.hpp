// An axis's position over time in few knots, whatever the number of steps.
//
// A step falls where the position crosses a half, so each step gives one point of the true course: (its tick, the
// count before + direction / 2). A straight line replaces points while it passes each within the tolerance (Bristol's
// swinging door, 1990: one pass, constant memory). If there are too many knots, the tolerance doubles.
#pragma once

#include <optional>
#include <vector>

#include "clients/analysis/log/step_stream.hpp"
#include "core/units.hpp"

namespace lockstep::analysis {

struct Knot {
    Tick tick;
    double position_steps = 0;
    bool joined = true;  // false: no line leads here from the knot before
    bool operator==(const Knot&) const = default;
};

class Trace final : public StepListener {
public:
    static constexpr double kTolerance = 0.25;  // steps
    static constexpr std::size_t kMaxKnots = 200'000;

    explicit Trace(std::size_t max_knots = kMaxKnots) : max_knots_(max_knots) {}

    void on_batch(const StepBatch& batch) override;
    void on_break(const Break& what) override;
    /// Ends the last line, at the whole step where the axis came to rest.
    void finish();

    const std::vector<Knot>& knots() const { return knots_; }
    /// The maximum distance of a line from a step that it represents, in steps.
    double tolerance_steps() const { return error_; }

private:
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
    std::optional<Knot> newest_;  // the end of the line so far; none right after a knot
    double low_slope_ = 0;        // of the lines that still pass every point
    double high_slope_ = 0;
    std::optional<Tick> last_step_;
    Ticks last_interval_;  // between the two steps before; 0: unknown
    std::int64_t position_ = 0;
};

/// The position at an instant, in steps, by the lines between knots; outside them that of the nearest knot. `place` is
/// where the search begins, for instants that rise; start at 0. Knots must not be empty.
double position_at(const std::vector<Knot>& knots, Tick tick, std::size_t& place);

}  // namespace lockstep::analysis
