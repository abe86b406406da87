#include "clients/analysis/run.hpp"

#include <utility>

#include "clients/analysis/log_step.hpp"
#include "core/step/executable.hpp"

namespace lockstep::analysis {
namespace {

bool is_countable_run(const run_t& m) {
    return is_countable(m.sequence) && m.sequence >= 0 && is_countable(m.start_tick) && is_countable(m.start_count) &&
           is_countable(m.stop_count) && is_countable(m.zero_count);
}

}  // namespace

Position Run::to() const {
    Position at = from;
    for (const Piece& piece : pieces) { at = at + piece.covered(); }
    return at;
}

Ticks Run::ticks() const {
    Ticks sum;
    for (const Piece& piece : pieces) { sum += piece.ticks; }
    return sum;
}

std::expected<Run, std::string> to_run(const run_t& message) {
    if (!is_countable_run(message)) { return std::unexpected("a run with numbers that no machine counts to"); }
    if (message.ticks.size() > kMaxBodyPieces) { return std::unexpected("a run of more pieces than a frame carries"); }
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
            .zero_count = message.zero_count};
    for (std::size_t i = 0; i < message.ticks.size(); ++i) {
        run.pieces.push_back({{message.ticks[i]}, {message.velocity[i]}, {message.acceleration[i]}});
        if (!executable(run.pieces.back())) { return std::unexpected("a run with a piece that no engine executes"); }
    }
    return run;
}

std::string name_of(const Run& run) {
    const std::string frame = (run.tail ? "tail of frame " : "frame ") + std::to_string(run.frame);
    if (run.epoch != 0) { return frame; }
    return "run " + std::to_string(run.sequence) + ", " + frame + " of the axis's own move";
}

StepMaker::StepMaker(Run run) : run_(std::move(run)), engine_(run_.start, run_.from), count_(run_.from.count()) {}

const StepEdge* StepMaker::next() {
    if (passed_ == made_.size()) { make_more(); }
    return passed_ < made_.size() ? &made_[passed_] : nullptr;
}

void StepMaker::pass() {
    count_ += made_[passed_].direction;
    ++passed_;
}

void StepMaker::make_more() {
    made_.clear();
    passed_ = 0;
    while (made_.empty()) {
        if (engine_.idle()) {
            if (begun_ == run_.pieces.size()) { return; }
            engine_.begin(run_.pieces[begun_++]);
        }
        engine_.run(engine_.now() + engine_.remaining(), [this](StepEdge step) {
            made_.push_back(step);
            return made_.size() < kMadeAtOnce;
        });
    }
}

}  // namespace lockstep::analysis
