#include "clients/lockstep/offline/moves_csv.hpp"

#include <cmath>
#include <cstdlib>

#include "core/gcode/chords.hpp"
#include "core/gcode/program_builder.hpp"
#include "core/number_text.hpp"

namespace lockstep {
namespace {

using gcode::Point;

class MovesTable {
public:
    explicit MovesTable(const ProgramInput& input)
        : input_(input), places_(gcode::axis_places(input.setup)), at_(gcode::start_state(input.setup).machine) {
        text_ = "line,kind";
        for (const GcodeAxis& axis : input.setup.axes) { text_ += "," + axis.name; }
        text_ += ",feed_mm_min,i,j,k\n";
    }

    void take(const gcode::Action& action, int line) {
        line_ = line;
        if (const auto* straight = std::get_if<gcode::Straight>(&action)) {
            add(straight->rapid ? "rapid" : "feed", straight->target, straight->feed);
        } else if (const auto* arc = std::get_if<gcode::Arc>(&action)) {
            take_arc(*arc);
        } else if (const auto* spline = std::get_if<gcode::Spline>(&action)) {
            gcode::cut(*spline, Point(at_), input_.setup.chord_tolerance_mm,
                       [&](const Point& target) { add("feed", target, spline->feed); });
        } else if (std::holds_alternative<gcode::Dwell>(action)) {
            add("dwell", at_, 0);
        }
    }

    std::string text() && { return std::move(text_); }

private:
    /// Whole turns first, each with its part of the way; the last ends at the target.
    void take_arc(const gcode::Arc& arc) {
        const int turns = std::abs(arc.turns);
        const char* kind = arc.turns > 0 ? "arc_ccw" : "arc_cw";
        const Point from = at_;
        for (int turn = 1; turn < turns; ++turn) {
            Point end = from;
            for (std::size_t axis = 0; axis < gcode::kAxes; ++axis) {
                end[axis] += part(arc, from, axis) * turn / turns;
            }
            add(kind, end, arc.feed, &arc.centre);
        }
        add(kind, arc.target, arc.feed, &arc.centre);
    }

    /// Of the way that an axis goes evenly: along the arc's own axis, and all axes but X, Y and Z.
    static double part(const gcode::Arc& arc, const Point& from, std::size_t axis) {
        if (axis >= 3) { return arc.target[axis] - from[axis]; }
        double rise = 0;
        for (std::size_t i = 0; i < 3; ++i) { rise += (arc.target[i] - from[i]) * arc.axis[i]; }
        return rise * arc.axis[axis];
    }

    void add(const char* kind, const Point& target, double feed, const gcode::Vector* centre = nullptr) {
        text_ += std::to_string(line_) + "," + kind;
        for (std::size_t i = 0; i < places_.size(); ++i) {
            text_ += "," + number_text(places_[i] ? target[*places_[i]] : input_.setup.axes[i].start_mm);
        }
        text_ += "," + (feed > 0 ? number_text(feed) : std::string());
        for (std::size_t i = 0; i < 3; ++i) { text_ += "," + (centre != nullptr ? number_text((*centre)[i]) : ""); }
        text_ += "\n";
        at_ = target;
    }

    const ProgramInput& input_;
    std::vector<std::optional<std::size_t>> places_;
    Point at_;
    std::string text_;
    int line_ = 0;
};

}  // namespace

std::string moves_csv(const ProgramInput& input) {
    MovesTable table(input);
    (void)gcode_actions(input.text, input.setup,
                        [&](const gcode::Action& action, int line) { table.take(action, line); });
    return std::move(table).text();
}

}  // namespace lockstep
