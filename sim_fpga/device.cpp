#include "sim_fpga/device.hpp"

#include <algorithm>
#include <utility>

namespace lockstep {

using namespace registers;

SimulatedDevice::SimulatedDevice(RegisterWindow window, Plant plant, std::int64_t tick_ns, Tick now,
                                 std::uint64_t power_up, const DeviceAbilities& abilities)
    : window_(window),
      abilities_(abilities),
      segments_(window, abilities.segment_entries),
      capture_(window, abilities.capture_entries),
      plant_(std::move(plant)),
      tick_ns_(static_cast<std::uint64_t>(tick_ns)),
      power_up_(power_up),
      engine_(now, rest_position(0, false)),
      inputs_(plant_.inputs()) {
    reset();
}

void SimulatedDevice::reset() {
    for (const std::size_t word :
         {kMagic, kSequence, kRunRequest, kTrigger, kArmed, kVeto, kStop, kSegmentHead, kCaptureTail}) {
        window_.store(word, 0);
    }
    window_.store(kVersion, kVersionValue);
    window_.store(kMapChecksum, kMapChecksumValue);
    window_.store(kTickNs, tick_ns_);
    window_.store(kPowerUp, power_up_);
    window_.store(kSegmentEntries, abilities_.segment_entries);
    window_.store(kCaptureEntries, abilities_.capture_entries);
    window_.store(kLeastStepTicks, static_cast<std::uint64_t>(abilities_.least_step.value));
    publish();
    window_.store(kMagic, kMagicValue);
}

bool SimulatedDevice::is_intact() const {
    const bool is_own = window_.load(kMagic) == kMagicValue && window_.load(kVersion) == kVersionValue &&
                        window_.load(kMapChecksum) == kMapChecksumValue && window_.load(kTickNs) == tick_ns_ &&
                        window_.load(kPowerUp) == power_up_;
    const std::uint64_t loaded = window_.load(kSegmentHead) - segments_.taken();
    const std::uint64_t captured = capture_.head() - window_.load(kCaptureTail);
    return is_own && loaded <= abilities_.segment_entries && captured <= abilities_.capture_entries;
}

void SimulatedDevice::advance(Tick until) {
    inputs_ = plant_.inputs();
    take_run();
    if (phase_ != Phase::AtRest && stop_asked()) { finish(kStatusStoppedByHost); }
    for (Tick next = decide(until); engine_.now() < until; next = decide(until)) {
        if (engine_.idle()) {
            engine_.wait(next);
        } else {
            run(next);
        }
    }
    publish();
}

void SimulatedDevice::take_run() {
    const std::uint64_t asked = window_.load(kRunRequest);
    const bool at_rest = phase_ == Phase::AtRest || phase_ == Phase::Waiting;
    if (!at_rest || asked == 0 || asked == run_) { return; }
    run_ = asked;
    trigger_ = window_.load(kTrigger);
    run_bits_ = 0;
    frame_ = {};
    phase_ = Phase::Waiting;
}

/// Does the work of this tick. Returns the next tick at which a decision may be due.
Tick SimulatedDevice::decide(Tick until) {
    if (phase_ == Phase::AtRest) { take_run(); }
    if (phase_ == Phase::AtRest) {
        segments_.drop_run(run_);
        return until;
    }
    if (phase_ == Phase::Waiting) { return decide_first_frame(until); }
    if (engine_.idle()) { next_piece(); }
    return until;
}

Tick SimulatedDevice::decide_first_frame(Tick until) {
    segments_.drop_other_runs(run_);
    const auto first = segments_.front();
    if (!first) { return until; }
    if (vetoed(1)) {
        finish(0);
        return until;
    }
    if (first->start > engine_.now()) { return std::min(until, first->start); }
    if (may_run(1)) {
        const bool joins =
            first->is_frame(1) && first->start == engine_.now() && rebase_to(first->from(engine_.position().count()));
        if (!joins || !segments_.take_frame(1, next_)) {
            finish(kStatusBadSegment);
        } else if (triggered()) {
            trigger_count_ = count_;
            finish(kStatusStoppedByTrigger);
        } else {
            begin_frame();
        }
    }
    return until;
}

void SimulatedDevice::next_piece() {
    ++piece_;
    if (phase_ == Phase::Body && piece_ == frame_.body_pieces) {
        end_body();
    } else if (piece_ == frame_.pieces.size()) {
        finish(0);
    } else {
        engine_.begin(frame_.pieces[piece_]);
    }
}

void SimulatedDevice::end_body() {
    if (frame_.last) {
        finish(0);
        return;
    }
    const auto next = segments_.front();
    const FrameNumber number = frame_.number + 1;
    if (next && next->is_of_run(run_) && next->is_frame(number) && may_run(number)) {
        if (joins(*next) && segments_.take_frame(number, next_)) {
            begin_frame();
            return;
        }
        run_bits_ |= kStatusBadSegment;
    }
    begin_tail();
}

void SimulatedDevice::begin_frame() {
    frame_ = next_;
    phase_ = Phase::Body;
    piece_ = 0;
    engine_.begin(frame_.pieces[0]);
}

void SimulatedDevice::begin_tail() {
    if (frame_.body_pieces == frame_.pieces.size()) {
        finish(0);
        return;
    }
    phase_ = Phase::Tail;
    piece_ = frame_.body_pieces;
    engine_.begin(frame_.pieces[piece_]);
}

void SimulatedDevice::finish(std::uint64_t reason) {
    engine_.halt();
    run_bits_ |= kStatusFinished | reason | (phase_ == Phase::Tail ? kStatusInTail : 0);
    phase_ = Phase::AtRest;
}

/// The host withdraws ARMED before it lifts VETO for another run, and requests that run last. The registers are read in
/// reverse order, so no mixture of the values of two runs lets a frame through.
bool SimulatedDevice::may_run(FrameNumber frame) const {
    return !vetoed(frame) && window_.load(kArmed) >= frame && window_.load(kRunRequest) == run_;
}

bool SimulatedDevice::vetoed(FrameNumber frame) const { return window_.load(kVeto) <= frame; }

bool SimulatedDevice::stop_asked() const {
    const std::uint64_t stop = window_.load(kStop);
    return stop != 0 && stop == window_.load(kRunRequest);
}

bool SimulatedDevice::joins(const FrameHeader& frame) const {
    return frame.start == engine_.now() && frame.from(engine_.position().count()) == engine_.position();
}

/// A run may begin at the axis's position, with the phase that a stop left, or with the phase at rest.
bool SimulatedDevice::rebase_to(Position from) {
    const bool same_place = from == engine_.position() || (from.count() == count_ && rests_on_whole_step(from));
    if (same_place) { engine_.rebase(from); }
    return same_place;
}

bool SimulatedDevice::runs_into_limit(int direction) const {
    return direction < 0 ? inputs_.limit_min : inputs_.limit_max;
}

bool SimulatedDevice::triggered() const {
    return (trigger_ == kTriggerHomeCloses && inputs_.home) || (trigger_ == kTriggerHomeOpens && !inputs_.home);
}

void SimulatedDevice::run(Tick until) {
    engine_.run(until, [this](StepEdge step) { return on_step(step); });
    if (cease_ != 0) {
        finish(std::exchange(cease_, 0));
        if (engine_.position().count() != count_) {  // a pulse was suppressed at a limit switch
            engine_.rebase(rest_position(count_, false));
        }
    }
}

bool SimulatedDevice::on_step(StepEdge step) {
    if (runs_into_limit(step.direction)) {
        cease_ = kStatusStoppedByLimit;
        return false;
    }
    count_ += step.direction;
    plant_.step(step);
    inputs_ = plant_.inputs();
    if (!capture_.keep(step)) { run_bits_ |= kStatusCaptureOverflow; }
    if (triggered()) {
        trigger_count_ = count_;
        cease_ = kStatusStoppedByTrigger;
    }
    if (runs_into_limit(step.direction)) { cease_ |= kStatusStoppedByLimit; }
    return cease_ == 0;
}

std::uint64_t SimulatedDevice::status_word() const {
    const auto bit = [](bool set, std::uint64_t mask) { return set ? mask : 0; };
    return run_bits_ | bit(phase_ == Phase::Body || phase_ == Phase::Tail, kStatusMoving) |
           bit(phase_ == Phase::Tail, kStatusInTail) | bit(inputs_.limit_min, kStatusLimitMin) |
           bit(inputs_.limit_max, kStatusLimitMax) | bit(inputs_.home, kStatusHome);
}

void SimulatedDevice::publish() {
    const auto store = [this](std::size_t word, std::int64_t value) {
        window_.store(word, static_cast<std::uint64_t>(value));
    };
    window_.store(kSequence, ++sequence_);
    store(kTick, engine_.now().value);
    window_.store(kStatus, status_word());
    store(kCount, engine_.position().count());
    window_.store(kPhase, engine_.position().phase());
    store(kVelocity, engine_.velocity().raw);
    window_.store(kRun, run_);
    window_.store(kFrame, frame_.number);
    store(kTriggerCount, trigger_count_);
    store(kEncoder, plant_.encoder());
    window_.store(kSegmentTail, segments_.taken());
    window_.store(kCaptureHead, capture_.head());
    window_.store(kCaptureLost, capture_.lost());
    window_.store(kSequence, ++sequence_);
}

}  // namespace lockstep
