#include "tests/benchmarks/planners/straight_moves.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <variant>

#include "core/check.hpp"

namespace lockstep::planners {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

class MoveList {
public:
    explicit MoveList(std::span<const double> start) { std::ranges::copy(start, at_.begin()); }

    void add(const std::vector<double>& to, double feed) {
        StraightMove move{.feed_mm_s = feed};
        for (std::size_t i = 0; i < kAxes; ++i) { move.direction[i] = to[i] - at_[i]; }
        for (const double way : move.direction) { move.length_mm += way * way; }
        move.length_mm = std::sqrt(move.length_mm);
        if (move.length_mm < 1e-9) { return; }
        for (double& way : move.direction) { way /= move.length_mm; }
        std::ranges::copy(to, at_.begin());
        moves_.push_back(move);
    }
    std::vector<double> at() const { return {at_.begin(), at_.end()}; }
    std::vector<StraightMove> take() { return std::move(moves_); }

private:
    Vector at_{};
    std::vector<StraightMove> moves_;
};

void add_arc(const ProgramMove& move, const ChordCount& chords, double feed, MoveList& list) {
    const std::vector<double> from = list.at();
    const ArcPath arc(*move.arc, from, move.target_mm);
    const double count = chords(arc);
    for (double k = 1; k < count; ++k) { list.add(arc.at(k / count), feed); }
    list.add(move.target_mm, feed);
}

}  // namespace

Limits limits_of(const MachineConfig& machine) {
    check(machine.axes.size() == kAxes, "the planners are compared on three axes");
    Limits limits;
    for (std::size_t i = 0; i < kAxes; ++i) {
        const AxisConfig& axis = machine.axes[i];
        limits[i] = {.start_velocity = axis.start_velocity_mm_s,
                     .max_velocity = axis.max_velocity_mm_s,
                     .acceleration = std::min(axis.max_accel_mm_s2, axis.max_decel_mm_s2)};
    }
    return limits;
}

ChordCount chords_of_length(double mm) {
    return [mm](const ArcPath& arc) { return std::max(1.0, std::floor(arc.length_mm() / mm)); };
}

ChordCount chords_of_error(double mm) {
    return [mm](const ArcPath& arc) {
        const double radius = arc.radius_begin();
        const double half_chord = std::sqrt(mm * (2 * radius - mm));
        return std::max(1.0, std::floor(arc.sweep() * radius / 2 / half_chord));
    };
}

std::vector<StraightMove> straight_moves(const Program& program, const ChordCount& chords) {
    MoveList list(program.start_mm);
    for (const Block& block : program.blocks) {
        if (std::holds_alternative<ProgramEvent>(block.action)) { continue; }
        const auto* move = std::get_if<ProgramMove>(&block.action);
        check(move != nullptr, "the planners are compared on moves without rests");
        const double feed = move->rapid ? kInfinite : move->feed_mm_s;
        move->arc ? add_arc(*move, chords, feed, list) : list.add(move->target_mm, feed);
    }
    return list.take();
}

double most_along(const Vector& direction, const Limits& limits, double AxisLimit::*value) {
    double most = kInfinite;
    for (std::size_t i = 0; i < kAxes; ++i) {
        if (direction[i] != 0) { most = std::min(most, limits[i].*value / std::abs(direction[i])); }
    }
    return most;
}

}  // namespace lockstep::planners
