#include "services/record/reading/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/step/executable.hpp"
#include "services/record/reading/log_step.hpp"

namespace lockstep::analysis {
namespace {

bool is_countable_run(const run_t& m) {
    return is_message_number(m.sequence) && is_countable(m.start_tick) && is_countable(m.start_count) &&
           is_countable(m.stop_count) && is_countable(m.zero_count) && is_countable(m.ahead) &&
           is_countable(m.clock_error) && m.clock_error >= 0;
}

bool are_commanded(const run_t& m) {
    const auto lasts = [](std::int64_t ticks) { return ticks > 0 && Ticks{ticks} <= kMaxPieceTicks; };
    const bool fit = m.retimed == 0 || m.retimed == m.pieces || m.retimed + 1 == m.pieces;
    return fit && std::ranges::all_of(m.commanded_ticks, lasts);
}

}  // namespace

Position Run::to() const {
    Position at = from;
    for (const Piece& piece : pieces) { at = at + piece.covered(); }
    return at;
}

Ticks Run::ticks() const { return total_ticks(pieces); }

std::expected<Run, std::string> to_run(const run_t& message) {
    if (!is_countable_run(message)) { return std::unexpected("a run with impossible numbers"); }
    if (message.ticks.size() > kMaxBodyPieces + 1) {
        return std::unexpected("a run of more pieces than a frame can carry");
    }
    if (!are_commanded(message)) { return std::unexpected("a run with an impossible commanded duration"); }
    Run run{.incarnation = message.incarnation,
            .sequence = message.sequence,
            .epoch = static_cast<Epoch>(message.epoch),
            .frame = static_cast<FrameNumber>(message.frame),
            .tail = message.tail != 0,
            .start = {message.start_tick},
            .from = Position::from_count(message.start_count, static_cast<std::uint64_t>(message.start_phase)),
            .pieces = {},
            .cut = message.cut != 0,
            .stop_count = message.stop_count,
            .zero_count = message.zero_count,
            .ahead = {message.ahead},
            .clock_error = {message.clock_error}};
    for (const std::int64_t ticks : message.commanded_ticks) { run.commanded_ticks.push_back({ticks}); }
    for (std::size_t i = 0; i < message.ticks.size(); ++i) {
        run.pieces.push_back({{message.ticks[i]}, {message.velocity[i]}, {message.acceleration[i]}});
        if (!executable(run.pieces.back())) { return std::unexpected("a run with a piece that no engine can execute"); }
    }
    return run;
}

RunMessage to_run_message(const run_t& message) {
    return {message.machine, message.axis, message.utime, to_run(message)};
}

std::string name_of(const Run& run) {
    std::string frame = fmt::format("{} {}", run.tail ? "tail of frame" : "frame", run.frame);
    if (run.epoch != 0) { return frame; }
    return fmt::format("run {}, {} of the axis's own move", run.sequence, frame);
}

bool starts_from_rest(const Run& run) { return rests_on_whole_step(run.from); }

bool is_next(const Run& before, const Run& run) {
    return before.incarnation == run.incarnation && before.epoch == run.epoch && !before.cut && !before.tail &&
           before.frame + (run.tail ? 0 : 1) == run.frame;
}

StepMaker::StepMaker(Run run)
    : run_(std::move(run)), engine_(run_.start, run_.from), ticks_(kMadeAtOnce), count_(run_.from.count()) {
    commanded_.other_from = run_.commanded_start();
}

void StepMaker::begin_piece() {
    const std::size_t i = begun_++;
    const std::size_t commanded = run_.commanded_ticks.size();
    engine_.begin(run_.pieces[i]);
    if (commanded > 0 && i == commanded) { return; }  // the second part of the split piece
    const bool split = i + 1 == commanded && commanded < run_.pieces.size();
    const Ticks ticks = run_.pieces[i].ticks + (split ? run_.pieces[i + 1].ticks : Ticks{});
    const Tick other_from = commanded_.other_from + commanded_.other_ticks;
    commanded_ = {engine_.now(), ticks, other_from, commanded > 0 ? run_.commanded_ticks[i] : ticks};
}

/// A piece reverses at most once, so the sum of the directions of some of its steps tells where.
void StepMaker::make_more() {
    std::int32_t* const ticks = ticks_.data();
    std::size_t made = 0;
    std::int64_t change = 0;
    std::int8_t last = 0;
    Tick origin;
    do {
        origin = engine_.now();
        if (engine_.idle()) {
            if (begun_ == run_.pieces.size()) { break; }
            begin_piece();
        }
        const Tick until = origin + std::min(engine_.remaining(), StepBuffer::kReach - Ticks{1});
        engine_.run(until, [&](StepEdge step) {
            ticks[made] = static_cast<std::int32_t>((step.tick - origin).value);
            change += step.direction;
            last = step.direction;
            return ++made < kMadeAtOnce;
        });
    } while (made == 0);
    passed_ = 0;
    const auto after_turn = static_cast<std::size_t>((static_cast<std::int64_t>(made) + change * last) / 2);
    directions_.assign(made - after_turn, static_cast<std::int8_t>(-last));
    const bool turns = !directions_.empty();
    directions_.resize(turns ? made : 0, last);
    ready_ = {origin, {ticks, made}, last, turns ? directions_.data() : nullptr};
}

}  // namespace lockstep::analysis
