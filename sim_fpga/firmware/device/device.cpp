#include "sim_fpga/firmware/device/device.hpp"

namespace lockstep::firmware {

using namespace registers;

Device::Device(Port& port, const Abilities& abilities, std::int64_t now)
    : port_(port),
      abilities_(abilities),
      segments_(words_),
      capture_(words_),
      channels_(words_, abilities_, port),
      engine_(now) {
    store_abilities();
    tend();
    publish();
    words_.store(kMagic, kMagicValue);
}

void Device::store_abilities() {
    words_.store(kVersion, kVersionValue);
    words_.store(kMapChecksum, kMapChecksumValue);
    words_.store(kTickNs, abilities_.tick_ns);
    words_.store(kPowerUp, abilities_.power_up);
    words_.store(kSegmentEntries, std::uint64_t{kSegmentRoom});
    words_.store(kCaptureEntries, std::uint64_t{kCaptureRoom});
    words_.store(kLeastStepTicks, abilities_.least_step_ticks);
    words_.store(kTimeUnitPs, abilities_.time_unit_ps);
    words_.store(kLongestTime, abilities_.longest_time);
    words_.store(kLongestPwmPeriod, abilities_.longest_pwm_period);
    words_.store(kLongestPieceTicks, kLongestPiece);
    words_.store(kLeadTicks, abilities_.lead_ticks);
    words_.store(kPinTicks, abilities_.pin_ticks);
    words_.store(kInputChannels, abilities_.inputs);
    words_.store(kDigitalChannels, abilities_.digital_outputs);
    words_.store(kAnalogChannels, abilities_.analog_outputs);
    words_.store(kOutputEntries, std::uint64_t{kOutputRoom});
    words_.store(kEventEntries, std::uint64_t{kEventRoom});
    words_.store(kFeatures, (abilities_.has_encoder ? kFeaturesEncoder : 0) |
                                (abilities_.can_enable ? kFeaturesEnable : 0) |
                                (abilities_.can_compare ? kFeaturesCompare : 0));
}

void Device::advance(std::int64_t until) {
    prepare_orders();
    take_orders();
    execute(until);
    publish();
}

void Device::take_orders() {
    take_setup();
    take_enable();
    channels_.take_orders(moment());
    take_run();
    if (phase_ != Phase::AtRest && is_stop_asked()) { finish(kStatusStoppedByHost); }
    if (phase_ != Phase::AtRest && has_lost_ticks_) { finish(kStatusLostTicks); }
}

void Device::execute(std::int64_t until) {
    tend();
    for (std::int64_t next = decide(until); engine_.now() < until; next = decide(until)) {
        const std::int64_t due = next_due(next);
        if (engine_.is_idle()) {
            engine_.wait(due);
        } else {
            engine_.run(due, [this](const StepBlock& block) { return take_steps(block); });
        }
        tend();
    }
}

void Device::prepare_orders() {
    segments_.check_ahead();
    const std::uint64_t asked = words_.load(kSetupRequest);
    if (is_in_motion() || asked == setup_taken_ || asked == setup_refused_) { return; }
    prepared_ = load_setup(words_);
    is_prepared_possible_ = is_within(abilities_, prepared_);
    setup_prepared_ = asked;
}

/// A setup changes what inputs and pulses mean, so it is taken at rest only.
void Device::take_setup() {
    const std::uint64_t asked = words_.load(kSetupRequest);
    if (is_in_motion() || asked == setup_taken_ || asked != setup_prepared_) { return; }
    if (!is_prepared_possible_) {
        setup_refused_ = asked;
        return;
    }
    setup_taken_ = asked;
    channels_.set(prepared_, moment());
}

void Device::take_enable() {
    const bool falls_off = channels_.is_host_silent() && setup().is_disabled_at_silence;
    if (words_.load(kEnable) == 0 || falls_off) {
        if (enabled_.is_set && is_in_motion()) { finish(kStatusStoppedByHost); }
        enabled_ = {};
    } else if (!enabled_.is_set) {
        enabled_ = Due::at(engine_.now());
    }
}

void Device::take_run() {
    const std::uint64_t asked = words_.load(kRunRequest);
    if (is_in_motion() || asked == 0 || asked == run_) { return; }
    run_ = asked;
    trigger_ = words_.load(kTrigger);
    run_bits_ = 0;
    frame_.number = 0;
    phase_ = Phase::Waiting;
}

/// Does the work of this tick. Returns the next tick at which a decision may be due.
std::int64_t Device::decide(std::int64_t until) {
    if (phase_ == Phase::AtRest) { take_run(); }
    if (phase_ == Phase::AtRest) {
        segments_.drop_run(run_);
        channels_.drop_run(run_);
        return until;
    }
    if (phase_ == Phase::Waiting) { return decide_first_frame(until); }
    if (engine_.is_idle()) { next_piece(); }
    return until;
}

std::int64_t Device::decide_first_frame(std::int64_t until) {
    segments_.drop_other_runs(run_);
    FrameHeader first;
    if (!segments_.front(first)) { return until; }
    if (is_vetoed(1)) {
        finish(0);
        return until;
    }
    if (first.start > engine_.now()) { return until < first.start ? until : first.start; }
    if (may_run(1)) { start(first); }
    return until;
}

void Device::start(const FrameHeader& first) {
    const bool joins =
        first.is_frame(1) && first.start == engine_.now() && rebase_to(first.from(engine_.place().count));
    if (!joins || !segments_.take_frame(1, frame_)) {
        finish(kStatusBadSegment);
    } else if (is_closed(setup().stop)) {
        frame_.number = 0;
        finish(kStatusStoppedByInput);
    } else if (is_triggered()) {
        frame_.number = 0;
        trigger_count_ = count_;
        finish(kStatusStoppedByTrigger);
    } else {
        begin_body();
    }
}

void Device::next_piece() {
    ++piece_;
    if (phase_ == Phase::Body && piece_ == frame_.body_pieces) {
        end_body();
    } else if (piece_ == frame_.size) {
        finish(0);
    } else {
        engine_.begin(frame_.pieces[piece_]);
    }
}

void Device::end_body() {
    if (frame_.is_last) {
        finish(0);
        return;
    }
    FrameHeader next;
    const std::uint64_t number = frame_.number + 1;
    if (segments_.front(next) && next.is_of_run(run_) && next.is_frame(number) && may_run(number)) {
        if (joins(next) && segments_.take_frame(number, frame_)) {
            begin_body();
            return;
        }
        run_bits_ |= kStatusBadSegment;
    }
    begin_tail();
}

void Device::begin_body() {
    phase_ = Phase::Body;
    piece_ = 0;
    if (!channels_.begin_frame(run_, frame_.number, moment())) { run_bits_ |= kStatusBadOutput; }
    engine_.begin(frame_.pieces[0]);
}

void Device::begin_tail() {
    if (frame_.body_pieces == frame_.size) {
        finish(0);
        return;
    }
    phase_ = Phase::Tail;
    piece_ = frame_.body_pieces;
    channels_.begin_tail(moment());
    engine_.begin(frame_.pieces[piece_]);
}

void Device::finish(std::uint64_t reason) {
    const bool is_cut = reason != 0 || phase_ != Phase::Body || !frame_.is_last;
    engine_.halt();
    if (engine_.place().count != count_) {  // a limit switch suppressed a pulse
        engine_.rebase({.count = count_, .phase = kForwardPhase});
    }
    run_bits_ |= kStatusFinished | reason | (phase_ == Phase::Tail ? kStatusInTail : 0);
    phase_ = Phase::AtRest;
    channels_.end_run(is_cut, moment());
}

/// The host withdraws ARMED before it lifts VETO for another run, and requests that run last. The words are read in
/// reverse order, so no mixture of the values of two runs lets a frame through.
bool Device::may_run(std::uint64_t frame) const {
    return !is_vetoed(frame) && words_.load(kArmed) >= frame && words_.load(kRunRequest) == run_ && may_move();
}

bool Device::is_vetoed(std::uint64_t frame) const { return words_.load(kVeto) <= frame; }

bool Device::is_stop_asked() const {
    const std::uint64_t stop = words_.load(kStop);
    return stop != 0 && stop == words_.load(kRunRequest);
}

bool Device::joins(const FrameHeader& frame) const {
    return frame.start == engine_.now() && frame.from(engine_.place().count) == engine_.place();
}

/// A run may begin at the motor's place, with the phase that a stop left, or with the phase at rest.
bool Device::rebase_to(Place from) {
    const bool is_rest = from.count == count_ && (from.phase == kForwardPhase || from.phase == kBackwardPhase);
    if (from != engine_.place() && !is_rest) { return false; }
    engine_.rebase(from);
    return true;
}

bool Device::may_move() const {
    return !has_lost_ticks_ && setup_taken_ != 0 && enabled_.is_set &&
           engine_.now() - enabled_.tick >= setup().enable_ticks;
}

bool Device::runs_into_limit(int direction) const {
    return is_closed(direction < 0 ? setup().limit_min : setup().limit_max);
}

bool Device::is_triggered() const {
    const auto inputs = static_cast<std::uint32_t>(kTriggerInputs.of(trigger_));
    const bool opens = (trigger_ & kTriggerOpens) != 0;
    return inputs != 0 && is_closed(inputs) != opens;
}

std::int64_t Device::next_due(std::int64_t until) {
    const Due due = channels_.next();
    return due.is_past(until) ? due.tick : until;
}

/// Pauses behind a step that begins a pulse, whose end is due, or that has changed the inputs, and at a limit switch.
TakenSteps Device::take_steps(const StepBlock& block) {
    if (runs_into_limit(block.direction)) {
        into_limit_ = true;
        return {1, true};
    }
    const std::uint32_t to_place = channels_.steps_to_place(block, block.size, count_);
    const std::uint32_t made = port_.step(block, to_place > 0 ? to_place : block.size);
    if (!capture_.keep(block, made)) { run_bits_ |= kStatusCaptureOverflow; }
    count_ += block.direction < 0 ? -std::int64_t{made} : std::int64_t{made};
    stepped_ = block.direction;
    if (made == to_place) { channels_.arrive(block.tick(made - 1), count_); }
    return {made, made < block.size || made == to_place || port_.pins() != pins_};
}

/// Looks at the inputs and does what is due after this tick.
void Device::tend() {
    pins_ = port_.pins();
    channels_.tend(pins_, moment());
    if (const std::uint64_t reason = reason_to_cease(); reason != 0) {
        if ((reason & kStatusStoppedByTrigger) != 0) { trigger_count_ = count_; }
        finish(reason);
    }
    into_limit_ = false;
    stepped_ = 0;
    if (channels_.is_host_silent()) { take_enable(); }
}

/// Why pulses cease after this tick. 0: they do not.
std::uint64_t Device::reason_to_cease() const {
    if (!is_in_motion()) { return 0; }
    const bool at_limit = into_limit_ || (stepped_ != 0 && runs_into_limit(stepped_));
    return (at_limit ? kStatusStoppedByLimit : 0) | (is_triggered() ? kStatusStoppedByTrigger : 0) |
           (is_closed(setup().stop) ? kStatusStoppedByInput : 0);
}

Moment Device::moment() const { return {.now = engine_.now(), .count = count_, .phase = engine_.place().phase}; }

std::uint64_t Device::status_word() const {
    const auto bit = [](bool is_set, std::uint64_t mask) { return is_set ? mask : 0; };
    return run_bits_ | bit(has_lost_ticks_, kStatusLostTicks) | bit(is_in_motion(), kStatusMoving) |
           bit(phase_ == Phase::Tail, kStatusInTail) | bit(is_closed(setup().limit_min), kStatusLimitMin) |
           bit(is_closed(setup().limit_max), kStatusLimitMax) | bit(is_closed(setup().home), kStatusHome) |
           bit(enabled_.is_set, kStatusEnabled) | bit(channels_.is_host_silent(), kStatusHostSilent) |
           bit(setup_refused_ != 0 && words_.load(kSetupRequest) == setup_refused_, kStatusBadSetup);
}

void Device::publish() {
    words_.store(kSequence, ++sequence_);
    words_.store(kTick, engine_.now());
    words_.store(kStatus, status_word());
    words_.store(kCount, engine_.place().count);
    words_.store(kPhase, engine_.place().phase);
    words_.store(kVelocity, engine_.velocity());
    words_.store(kRun, run_);
    words_.store(kFrame, frame_.number);
    words_.store(kTriggerCount, trigger_count_);
    words_.store(kEncoder, abilities_.has_encoder ? port_.encoder() : count_);
    words_.store(kSegmentTail, segments_.taken());
    capture_.publish();
    words_.store(kSetup, setup_taken_);
    channels_.publish(engine_.now());
    words_.store(kSequence, ++sequence_);
}

}  // namespace lockstep::firmware
