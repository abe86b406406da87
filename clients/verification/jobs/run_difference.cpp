#include "clients/verification/jobs/run_difference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lockstep::verification {
namespace {

std::string text_of(const Piece& piece) {
    return fmt::format("{} ticks, velocity {}, acceleration {}", piece.ticks.value, piece.velocity.raw,
                       piece.acceleration.raw);
}

std::string text_of(Position position) { return fmt::format("{} + {} / 2^64", position.count(), position.phase()); }

std::string what_differs(const Run& planned, const Run& seen) {
    if (seen.from != planned.from) {
        return fmt::format("starts at {}, planned at {}", text_of(seen.from), text_of(planned.from));
    }
    const auto [p, s] = std::ranges::mismatch(planned.pieces, seen.pieces);
    if (p == planned.pieces.end() || s == seen.pieces.end()) {
        return fmt::format("has {} pieces, planned are {}", seen.pieces.size(), planned.pieces.size());
    }
    return fmt::format("has piece {} of {}; planned: {}", p - planned.pieces.begin() + 1, text_of(*s), text_of(*p));
}

void find_step(const Run& planned, const Run& seen, RunDifference& difference) {
    StepMaker expected(planned);
    StepMaker found(seen);
    while (expected.next() != nullptr && found.next() != nullptr && *expected.next() == *found.next()) {
        expected.pass();
        found.pass();
    }
    if (expected.next() != nullptr) { difference.tick_expected = expected.next()->tick; }
    if (found.next() != nullptr) { difference.tick_seen = found.next()->tick; }
}

constexpr double kStretchSlack_ticks = 512;  // pieces of one tick each keep their length

/// The planned speed between two pieces, the smaller of both sides; 0 at a reversal. In 2^-64 step per tick.
Int128 joint_speed(const Piece& before, const Piece& after) {
    const Int128 ends = before.velocity_after(before.ticks) + before.acceleration.raw / 2;
    const Int128 begins = Int128{after.velocity.raw} + after.acceleration.raw / 2;
    if ((ends < 0) != (begins < 0)) { return 0; }
    return ends < 0 ? std::min(-ends, -begins) : std::min(ends, begins);
}

/// The maximum distance of the end of piece `i`, not the last, from its planned place. A piece ends at a tick of the
/// device's clock, at the plan's place by then, so the place is off by the motion between both.
/// The start of the run and the places of all ends are known exactly, so errors do not add up over the pieces: the
/// nearest tick is half a tick away at most. Where pieces of one tick each leave no room for the nearest tick,
/// core/axis/device/retime.cpp limits the distance to half a tick as well. Velocities are whole numbers, so n ticks
/// leave an error of up to n / 2 units of 2^-64 step, which the next piece compensates. kDoubles covers the rounding of
/// a speed times a part of a tick.
Displacement end_reach(const Run& planned, const Run& seen, std::size_t i) {
    constexpr Int128 kDoubles = 1 << 12;
    const Int128 half_tick = joint_speed(planned.pieces[i], planned.pieces[i + 1]) / 2;
    return Displacement{half_tick + seen.pieces[i].ticks.value / 2 + kDoubles};
}

/// Returns the number of the first piece after which the axis is not at its planned place, or nullopt if there is none.
std::optional<std::size_t> misplaced_piece(const Run& planned, const Run& seen) {
    Position expected = planned.from;
    Position found = seen.from;
    const bool split = seen.pieces.size() == planned.pieces.size() + 1;
    if (!split && seen.pieces.size() != planned.pieces.size()) { return seen.pieces.size(); }
    for (std::size_t i = 0; i < planned.pieces.size(); ++i) {
        expected = expected + planned.pieces[i].covered();
        found = found + seen.pieces[i].covered();
        const bool last = i + 1 == planned.pieces.size();
        if (last && split) { found = found + seen.pieces.back().covered(); }
        const Displacement off = found - expected;
        const Displacement reach = last ? Displacement{} : end_reach(planned, seen, i);
        if (off > reach || -off > reach) { return i + 1; }
    }
    return std::nullopt;
}

/// Compares the machine times for which the axis took the frame with the planned ones.
std::optional<RunDifference> compare_commanded(const Run& planned, const Run& seen) {
    if (seen.commanded_start() != planned.start) {
        return RunDifference{fmt::format("was executed for a start at tick {} of machine time, planned at tick {}",
                                         seen.commanded_start().value, planned.start.value),
                             planned.start, seen.commanded_start()};
    }
    const auto as_long = [](const Piece& piece, Ticks ticks) { return piece.ticks == ticks; };
    if (std::ranges::equal(planned.pieces, seen.commanded_ticks, as_long)) { return std::nullopt; }
    return RunDifference{"was executed for other lengths of its pieces than planned", std::nullopt,
                         seen.commanded_start()};
}

}  // namespace

std::optional<RunDifference> compare_retimed(const Run& planned, const Run& seen, std::optional<Tick> joins) {
    if (auto found = compare_commanded(planned, seen)) { return found; }
    if (joins && seen.start != *joins) {
        return RunDifference{
            fmt::format("starts at tick {}; the one before it ends at tick {}", seen.start.value, joins->value), joins,
            seen.start};
    }
    const auto length = static_cast<double>(planned.ticks().value);
    const double longer = std::abs(static_cast<double>((seen.ticks() - planned.ticks()).value));
    if (longer > length * kMostStretch + kStretchSlack_ticks) {
        return RunDifference{
            fmt::format("lasts {} ticks of its device, planned are {}", seen.ticks().value, planned.ticks().value),
            std::nullopt, seen.start};
    }
    if (seen.from != planned.from) { return RunDifference{what_differs(planned, seen), std::nullopt, seen.start}; }
    if (const auto piece = misplaced_piece(planned, seen)) {
        return RunDifference{fmt::format("is not at its planned place after piece {}", *piece), std::nullopt,
                             seen.start};
    }
    return std::nullopt;
}

std::optional<RunDifference> compare_runs(const Run& planned, const Run& seen) {
    if (seen.start != planned.start) {
        return RunDifference{
            fmt::format("starts at tick {}, planned at tick {}", seen.start.value, planned.start.value), planned.start,
            seen.start};
    }
    if (seen.from == planned.from && seen.pieces == planned.pieces) { return std::nullopt; }
    RunDifference difference{what_differs(planned, seen), {}, {}};
    find_step(planned, seen, difference);
    return difference;
}

}  // namespace lockstep::verification
