// Plans of single moves, the way to rest from any instant of them, and what the check of pieces says just within and
// just beyond each limit, stay as recorded. To write the files: LOCKSTEP_WRITE_HASHES=1 build/bin/property_motion
// --gtest_filter='*StayAsRecorded'
#include <algorithm>
#include <cmath>

#include "core/axis/following/frame_check.hpp"
#include "core/motion/ideal.hpp"
#include "core/motion/interpolate.hpp"
#include "tests/property/draw_below.hpp"
#include "tests/property/motion/random_move.hpp"
#include "tests/property/recorded_hashes.hpp"
#include "tests/property/recorded_text.hpp"

namespace lockstep {
namespace {

constexpr std::uint32_t kRecordedMoves = 1'500;
constexpr std::uint32_t kProfiles = 2'000;
constexpr std::uint32_t kTracks = 1'500;

void record(RecordedText& text, const PathLimits& limits) {
    text.line(limits.start_velocity, limits.max_velocity, limits.max_acceleration, limits.max_deceleration);
}
void record(RecordedText& text, const PathMove& move) {
    text.line(move.from, move.to, move.lead, move.length_mm, move.feed_mm_per_tick, move.dwell, move.start,
              move.profile);
    record(text, move.own);
    record(text, move.limits);
}

/// Two moves planned alone, joined at rest, and the way to rest from some instants.
std::string move_of(std::uint32_t number) {
    Random random(number);
    const Machine machine = random_machine(random, 1 + random() % 4);
    RecordedText text;
    Path path;
    for (int k = 0; k < 2; ++k) {
        PathMove move = random_move(random, machine);
        const Displacement along{k == 1 || one_in(random, 2) ? Int128{0} : Displacement::steps(move.lead).raw / 3};
        text.line(move.asked_velocity());
        move = plan_alone(move, along, Ticks{draw_below(random, 4) * 50'000});
        move.start = path.duration();
        record(text, move);
        path.moves.push_back(move);
    }
    Path rest;
    for (int k = 0; k < 6; ++k) {
        const Subticks now{draw_below(random, path.duration().value)};
        text.line(path.move_at(now));
        brake_from(path, now, machine.limits, rest);
        for (const PathMove& move : rest.moves) { record(text, move); }
    }
    return text.text();
}

std::string profile_of(std::uint32_t number) {
    Random random(number);
    const PathLimits limits = random_limits(random);
    const Displacement way = Displacement::steps(1 + draw_below(random, one_in(random, 2) ? 20 : 100'000));
    const double low = limits.max_velocity * static_cast<double>(draw_below(random, 9)) / 8;
    const double least = limits.max_acceleration * 4;
    RecordedText text;
    text.line(plan_fastest({{}, way, limits.start_velocity, limits.start_velocity, limits}));
    text.line(plan_brake_to({}, std::max(low, least), limits.max_deceleration, Subticks{draw_below(random, 65536)}));
    text.line(plan_brake_through({}, way, std::max(low, limits.start_velocity), limits.start_velocity));
    text.line(plan_steady({}, way, Ticks{1 + draw_below(random, 1'000'000)}));
    const auto ticks = static_cast<std::int64_t>(log_uniform(random, 10, 1e8));
    const auto timed = plan_in_time(way, Ticks{ticks}, limits);
    if (timed) { return text.line(*timed).text(); }
    return text.line(timed.error().least_ticks, timed.error().longest).text();
}

/// Scales speeds and accelerations to just within a limit, to the limit, or just beyond it.
AxisLimits nearly(Random& random, AxisLimits limits) {
    constexpr std::array kScales{0.99, 0.999999, 1.0, 1.000001, 1.01};
    const auto scale = [&] { return one_in(random, 2) ? 1.0 : kScales[random() % kScales.size()]; };
    limits.start_velocity *= scale();
    limits.max_velocity *= scale();
    limits.max_acceleration *= scale();
    limits.max_deceleration *= scale();
    return limits;
}

/// The track of a single move of one axis, cut into a body and its tail, and sometimes altered a little.
std::string check_of(std::uint32_t number) {
    Random random(number);
    const Machine machine = random_machine(random, 1);
    const PathMove move = plan_alone(random_move(random, machine), {}, {});
    const int direction = one_in(random, 2) ? 1 : -1;
    const Position from = rest_position(0, direction < 0);
    const std::vector<Piece> pieces = pieces_of(move.profile, from, direction);
    const auto in_body = static_cast<std::size_t>(draw_below(random, static_cast<std::int64_t>(pieces.size()) + 1));
    AxisTrack track{from, {}, {}};
    Ticks ticks;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        Piece piece = pieces[k];
        if (one_in(random, 8)) { piece.ticks = piece.ticks + Ticks{draw_below(random, 3) - 1}; }
        if (one_in(random, 8)) { piece.velocity.raw += piece.velocity.raw / 1000; }
        if (k < in_body) {
            track.body.append(piece);
            ticks = ticks + piece.ticks;
        } else {
            track.tail.append(piece);
        }
    }
    RecordedText text;
    for (int k = 0; k < 12; ++k) {
        AxisLimits limits = nearly(random, machine.limits[0]);
        limits.min_steps = -(direction < 0 ? move.lead : 0) + draw_below(random, 3) - 1;
        limits.max_steps = (direction > 0 ? move.lead : 0) + draw_below(random, 3) - 1;
        MotionPoint point{from, one_in(random, 6) ? limits.start_velocity : 0.0, {}};
        const Ticks lasts = one_in(random, 10) ? ticks + Ticks{draw_below(random, 3) - 1} : ticks;
        const FaultCode fault = check_track(track, lasts, in_body == pieces.size(), limits, point);
        text.line(fault, point.position, point.velocity, point.strain.up, point.strain.down, may_rest(point, limits));
    }
    return text.text();
}

/// The ideal of the same moves: its times and its corners.
std::string ideal_of(std::uint32_t number) {
    Random random(number);
    StepMove move{.steps = 1 + draw_below(random, 60)};
    move.max = log_uniform(random, 10, 20'000);
    move.start = one_in(random, 4) ? move.max : move.max / static_cast<double>(1 + draw_below(random, 20));
    move.acceleration = log_uniform(random, 100, 1e6);
    move.deceleration = one_in(random, 2) ? move.acceleration : log_uniform(random, 100, 1e6);
    const Ideal ideal(move);
    RecordedText text;
    text.line(ideal.duration_s(), ideal.peak(), ideal.step_times_s(Crossing::Whole),
              ideal.step_times_s(Crossing::Half));
    for (const Ideal::Corner& corner : ideal.corners()) { text.line(corner.time_s, corner.steps_per_s); }
    return text.text();
}

TEST(SingleMoves, StayAsRecorded) { expect_recorded("tests/property/motion/moves.txt", kRecordedMoves, move_of); }
TEST(Profiles, StayAsRecorded) { expect_recorded("tests/property/motion/profiles.txt", kProfiles, profile_of); }
TEST(ChecksOfTracks, StayAsRecorded) { expect_recorded("tests/property/motion/checks.txt", kTracks, check_of); }
TEST(IdealMoves, StayAsRecorded) { expect_recorded("tests/property/motion/ideals.txt", kProfiles, ideal_of); }

}  // namespace
}  // namespace lockstep
