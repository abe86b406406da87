// The frames of random programs are those that frames.txt has recorded, bit by bit. To write the file:
// LOCKSTEP_WRITE_HASHES=1 build/bin/property_path --gtest_filter='PathFramesOfPrograms.*'
#include <cstdio>
#include <string>

#include "core/path/timing/path_timer.hpp"
#include "tests/property/path/path_session.hpp"
#include "tests/property/recorded_hashes.hpp"

namespace lockstep {
namespace {

constexpr std::uint32_t kPrograms = 240;
constexpr std::size_t kMoves = 30;

/// Whole numbers as they are, and others to nine digits.
class Text {
public:
    Text& operator<<(std::int64_t value) {
        text_ += std::to_string(value) + ' ';
        return *this;
    }
    Text& operator<<(double value) {
        std::array<char, 32> digits{};
        text_ += {digits.data(), static_cast<std::size_t>(std::snprintf(digits.data(), digits.size(), "%.9g ", value))};
        return *this;
    }
    Text& operator<<(Position at) {
        return *this << at.count() << static_cast<std::int64_t>((at.raw + Position::steps(1).raw) & INT64_MAX);
    }
    Text& operator<<(const PathPlace& place) { return *this << std::int64_t{place.block} << place.along.as_steps(); }
    Text& operator<<(std::span<const Piece> pieces) {
        for (const Piece& piece : pieces) {
            *this << piece.ticks.value << piece.velocity.raw << piece.acceleration.raw;
        }
        text_ += '|';
        return *this;
    }
    Text& operator<<(const PathFrame& frame) {
        *this << frame.ticks.value << std::int64_t{frame.last} << frame.begin << frame.rest << frame.places[7];
        for (const AxisTrack& track : frame.axes) { *this << track.from << track.body << track.tail; }
        text_ += '\n';
        return *this;
    }
    std::string take() { return std::move(text_); }

private:
    std::string text_;
};

/// Lines only, arcs, and spirals, in turn.
RandomCase case_of(std::uint32_t number) {
    constexpr std::array<std::uint64_t, 3> kFirst{100, kFirstWithArcs + 100, kFirstWithSpirals + 100};
    RandomCase c = random_case(kFirst[number % kFirst.size()] + number);
    if (c.program.moves.size() > kMoves) { c.program.moves.resize(kMoves); }
    return c;
}

void add_time(Text& text, const RandomCase& c) {
    PathLoad load(std::vector<std::int64_t>(c.setup.axes()));
    PathTimer timer(c.setup);
    timer.begin(std::vector<Position>(c.setup.axes()), {}, load);
    for (std::size_t k = 0; k < c.program.moves.size(); ++k) {
        const TestMove& move = c.program.moves[k];
        const PlaceVector to = c.setup.to_steps(move.to);
        const auto block = static_cast<std::uint32_t>(k + 1);
        move.arc ? timer.begin_arc_to_steps(*move.arc, to, move.settings, block)
                 : timer.line_to_steps(to, move.settings, block);
    }
    timer.finish();
    text << timer.ticks();
    for (const AxisLoad& axis : load.axes()) {
        text << axis.steps << axis.least << axis.greatest << axis.peak_velocity << axis.peak_acceleration
             << axis.peak_jump;
    }
}

/// Every second program is interrupted, and runs with changing overrides.
std::string frames_of(std::uint32_t number) {
    const RandomCase c = case_of(number);
    Random random(number);
    PathSession session(c.setup, number % 2 == 0 ? std::deque<SessionEvent>{} : random_events(random, c.setup));
    session.run(c.program, [&](std::size_t) { return random() % 3 == 0; });
    Text text;
    for (const PathFrame& frame : session.frames()) { text << frame; }
    add_time(text, c);
    return text.take();
}

TEST(PathFramesOfPrograms, StayAsRecorded) { expect_recorded("tests/property/path/frames.txt", kPrograms, frames_of); }

}  // namespace
}  // namespace lockstep
