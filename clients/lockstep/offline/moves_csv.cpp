#include "clients/lockstep/offline/moves_csv.hpp"

#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/gcode/curves/spline_arcs.hpp"
#include "core/gcode/interpreter.hpp"
#include "core/gcode/program_builder.hpp"
#include "core/number_text.hpp"
#include "services/documents/program_file.hpp"
#include "services/files/line_reader.hpp"
#include "services/files/text_file.hpp"

namespace lockstep {
namespace {

using gcode::Point;

class MovesTable {
public:
    MovesTable(const GcodeSetup& setup, std::ostream& out)
        : setup_(setup), out_(out), places_(gcode::axis_places(setup)), at_(gcode::start_state(setup).machine) {
        out_ << "line,kind";
        for (const GcodeAxis& axis : setup.axes) { out_ << "," << axis.name; }
        out_ << ",feed_mm_min,i,j,k\n";
    }

    void take(const gcode::Action& action, int line) {
        line_ = line;
        if (const auto* straight = std::get_if<gcode::Straight>(&action)) {
            add(straight->rapid ? "rapid" : "feed", straight->target, straight->feed);
        } else if (const auto* arc = std::get_if<gcode::Arc>(&action)) {
            take_arc(*arc);
        } else if (const auto* spline = std::get_if<gcode::Spline>(&action)) {
            gcode::cut_into_arcs(*spline, Point(at_), gcode::spline_tolerance_mm(setup_.chord_tolerance_mm),
                                 [&](const gcode::Action& part) { take(part, line); });
        } else if (std::holds_alternative<Dwell>(action)) {
            add("dwell", at_, 0);
        }
    }

private:
    /// Adds whole turns first, each with its share of the axial motion. The last row ends at the target.
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

    /// The uniform part of an axis's motion: along the arc's own axis, or all of it for axes other than X, Y and Z.
    static double part(const gcode::Arc& arc, const Point& from, std::size_t axis) {
        if (axis >= 3) { return arc.target[axis] - from[axis]; }
        double rise = 0;
        for (std::size_t i = 0; i < 3; ++i) { rise += (arc.target[i] - from[i]) * arc.axis[i]; }
        return rise * arc.axis[axis];
    }

    void add(const char* kind, const Point& target, double feed, const gcode::Vector* centre = nullptr) {
        out_ << line_ << "," << kind;
        for (std::size_t i = 0; i < places_.size(); ++i) {
            out_ << "," << number_text(places_[i] ? target[*places_[i]] : setup_.axes[i].start_mm);
        }
        out_ << "," << (feed > 0 ? number_text(feed) : std::string());
        for (std::size_t i = 0; i < 3; ++i) { out_ << "," << (centre != nullptr ? number_text((*centre)[i]) : ""); }
        out_ << "\n";
        at_ = target;
    }

    const GcodeSetup& setup_;
    std::ostream& out_;
    std::vector<std::optional<std::size_t>> places_;
    Point at_;
    int line_ = 0;
};

/// Reads a long file line by line. In such a file a subroutine must precede its call.
std::expected<void, std::string> read_long(const std::string& file, const GcodeSetup& setup, MovesTable& table) {
    auto lines = LineReader::open(file);
    if (!lines) { return std::unexpected(lines.error()); }
    gcode::Interpreter interpreter(gcode::interpreter_setup(setup), gcode::start_state(setup),
                                   [&](const gcode::Action& action, int line) { table.take(action, line); });
    for (int number = 1; !interpreter.ended(); ++number) {
        const auto next = lines->next();
        if (!next) { return std::unexpected(next.error()); }
        if (next->state == LineReader::State::Ends) { break; }
        (void)interpreter.take(next->line, number);
    }
    (void)interpreter.finish();
    return {};
}

std::expected<void, std::string> read_short(const std::string& file, const GcodeSetup& setup, MovesTable& table) {
    const auto text = read_text_file(file);
    if (!text) { return std::unexpected(text.error().message); }
    (void)gcode_actions(*text, setup, [&](const gcode::Action& action, int line) { table.take(action, line); });
    return {};
}

}  // namespace

std::expected<void, std::string> write_moves(const std::string& table, const std::string& program,
                                             const GcodeSetup& setup) {
    errno = 0;
    std::ofstream out(table, std::ios::binary | std::ios::trunc);
    MovesTable moves(setup, out);
    auto read = is_long_program(program) ? read_long(program, setup, moves) : read_short(program, setup, moves);
    out.close();
    if (read && !out) { read = std::unexpected(table + ": cannot be written: " + std::strerror(errno)); }
    std::error_code ignored;
    if (!read && std::filesystem::is_regular_file(table, ignored)) { std::filesystem::remove(table, ignored); }
    return read;
}

}  // namespace lockstep
