#include "clients/verification/run_difference.hpp"

#include <algorithm>

namespace lockstep::verification {
namespace {

std::string text_of(const Piece& piece) {
    return std::to_string(piece.ticks.value) + " ticks, velocity " + std::to_string(piece.velocity.raw) +
           ", acceleration " + std::to_string(piece.acceleration.raw);
}

std::string text_of(Position position) {
    return std::to_string(position.count()) + " + " + std::to_string(position.phase()) + " / 2^64";
}

std::string what_differs(const Run& planned, const Run& seen) {
    if (seen.from != planned.from) {
        return "starts at " + text_of(seen.from) + ", planned at " + text_of(planned.from);
    }
    const auto [p, s] = std::ranges::mismatch(planned.pieces, seen.pieces);
    if (p == planned.pieces.end() || s == seen.pieces.end()) {
        return "has " + std::to_string(seen.pieces.size()) + " pieces, planned are " +
               std::to_string(planned.pieces.size());
    }
    return "has piece " + std::to_string(p - planned.pieces.begin() + 1) + " of " + text_of(*s) +
           "; planned: " + text_of(*p);
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

}  // namespace

std::optional<RunDifference> compare_runs(const Run& planned, const Run& seen) {
    if (seen.start != planned.start) {
        return RunDifference{"starts at tick " + std::to_string(seen.start.value) + ", planned at tick " +
                                 std::to_string(planned.start.value),
                             planned.start, seen.start};
    }
    if (seen.from == planned.from && seen.pieces == planned.pieces) { return std::nullopt; }
    RunDifference difference{what_differs(planned, seen), {}, {}};
    find_step(planned, seen, difference);
    return difference;
}

}  // namespace lockstep::verification
