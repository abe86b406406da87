#include "sim_fpga/device.hpp"

#include <algorithm>
#include <utility>

#include "core/step/executable.hpp"

namespace lockstep {

using namespace registers;

static_assert(DeviceAbilities{}.longest_piece == kMaxPieceTicks);

SimulatedDevice::SimulatedDevice(RegisterWindow window, Plant plant, std::int64_t tick_ns, Tick now,
                                 std::uint64_t power_up, const DeviceAbilities& abilities)
    : window_(window),
      abilities_(abilities),
      segments_(window, abilities.segment_entries, abilities.longest_piece),
      capture_(window, abilities.capture_entries),
      channels_(window, abilities),
      plant_(std::move(plant)),
      tick_ns_(static_cast<std::uint64_t>(tick_ns)),
      power_up_(power_up),
      engine_(now, rest_position(0, false)) {
    reset();
}

void SimulatedDevice::reset() {
    for (const std::size_t word :
         {kMagic, kSequence, kRunRequest, kTrigger, kArmed, kVeto, kStop, kSegmentHead, kCaptureTail, kOutputHead,
          kEventTail, kBeat, kEnable, kDirectRequest, kSetupRequest}) {
        window_.store(word, 0);
    }
    window_.store(kVersion, kVersionValue);
    window_.store(kMapChecksum, kMapChecksumValue);
    window_.store(kTickNs, tick_ns_);
    window_.store(kPowerUp, power_up_);
    window_.store(kSegmentEntries, abilities_.segment_entries);
    window_.store(kCaptureEntries, abilities_.capture_entries);
    window_.store(kLeastStepTicks, static_cast<std::uint64_t>(abilities_.least_step.value));
    window_.store(kTimeUnitPs, abilities_.time_unit_ps);
    window_.store(kLongestTime, abilities_.longest_time);
    window_.store(kLongestPwmPeriod, abilities_.longest_pwm_period);
    window_.store(kLongestPieceTicks, static_cast<std::uint64_t>(abilities_.longest_piece.value));
    window_.store(kLeadTicks, static_cast<std::uint64_t>(abilities_.lead.value));
    window_.store(kPinTicks, static_cast<std::uint64_t>(abilities_.behind.value));
    window_.store(kInputChannels, abilities_.inputs);
    window_.store(kDigitalChannels, abilities_.digital_outputs);
    window_.store(kAnalogChannels, abilities_.analog_outputs);
    window_.store(kOutputEntries, abilities_.output_entries);
    window_.store(kEventEntries, abilities_.event_entries);
    window_.store(kFeatures, (abilities_.has_encoder ? kFeaturesEncoder : 0) |
                                 (abilities_.can_enable ? kFeaturesEnable : 0) |
                                 (abilities_.can_compare ? kFeaturesCompare : 0) |
                                 (abilities_.frames_stay ? kFeaturesFramesStay : 0));
    tend();
    publish();
    window_.store(kMagic, kMagicValue);
}

bool SimulatedDevice::is_intact() const {
    const bool is_own = window_.load(kMagic) == kMagicValue && window_.load(kVersion) == kVersionValue &&
                        window_.load(kMapChecksum) == kMapChecksumValue && window_.load(kTickNs) == tick_ns_ &&
                        window_.load(kPowerUp) == power_up_;
    const std::uint64_t loaded = window_.load(kSegmentHead) - segments_.taken();
    const std::uint64_t captured = capture_.head() - window_.load(kCaptureTail);
    return is_own && loaded <= abilities_.segment_entries && captured <= abilities_.capture_entries &&
           channels_.is_intact();
}

void SimulatedDevice::advance(Tick until) {
    take_setup();
    take_enable();
    channels_.take_orders(place());
    take_run();
    if (phase_ != Phase::AtRest && stop_asked()) { finish(kStatusStoppedByHost); }
    if (phase_ != Phase::AtRest && has_lost_ticks_) { finish(kStatusLostTicks); }
    tend();
    for (Tick next = decide(until); engine_.now() < until; next = decide(until)) {
        const Tick due = next_due(next);
        if (engine_.idle()) {
            engine_.wait(due);
        } else {
            engine_.run(due, [this](StepEdge step) { return on_step(step); });
        }
        tend();
    }
    publish();
}

/// A setup changes what inputs and pulses mean, so it is taken at rest only.
void SimulatedDevice::take_setup() {
    const std::uint64_t asked = window_.load(kSetupRequest);
    if (in_motion() || asked == setup_taken_ || asked == setup_refused_) { return; }
    const DeviceSetup setup = load_setup(window_, abilities_.time_unit_ps);
    if (lack_of(abilities_, setup)) {
        setup_refused_ = asked;
        return;
    }
    setup_taken_ = asked;
    channels_.set(setup, place());
}

void SimulatedDevice::take_enable() {
    const bool falls_off = channels_.is_host_silent() && setup().disable_at_silence;
    if (window_.load(kEnable) == 0 || falls_off) {
        if (enabled_.has_value() && in_motion()) { finish(kStatusStoppedByHost); }
        enabled_.reset();
    } else if (!enabled_) {
        enabled_ = engine_.now();
    }
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
        channels_.drop_run(run_);
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
        } else if (is_closed(setup().stop)) {
            finish(kStatusStoppedByInput);
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
    if (!channels_.begin_frame(run_, frame_.number, place())) { run_bits_ |= kStatusBadOutput; }
    engine_.begin(frame_.pieces[0]);
}

void SimulatedDevice::begin_tail() {
    if (frame_.body_pieces == frame_.pieces.size()) {
        finish(0);
        return;
    }
    phase_ = Phase::Tail;
    piece_ = frame_.body_pieces;
    channels_.begin_tail(place());
    engine_.begin(frame_.pieces[piece_]);
}

void SimulatedDevice::finish(std::uint64_t reason) {
    const bool is_cut = reason != 0 || phase_ != Phase::Body || !frame_.last;
    engine_.halt();
    if (engine_.position().count() != count_) { engine_.rebase(rest_position(count_, false)); }  // at a limit switch
    run_bits_ |= kStatusFinished | reason | (phase_ == Phase::Tail ? kStatusInTail : 0);
    phase_ = Phase::AtRest;
    channels_.end_run(is_cut, place());
}

/// The host withdraws ARMED before it lifts VETO for another run, and requests that run last. The registers are read in
/// reverse order, so no mixture of the values of two runs lets a frame through.
bool SimulatedDevice::may_run(FrameNumber frame) const {
    return !vetoed(frame) && window_.load(kArmed) >= frame && window_.load(kRunRequest) == run_ && may_move();
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

bool SimulatedDevice::may_move() const {
    return !has_lost_ticks_ && setup_taken_ != 0 && enabled_ && engine_.now() - *enabled_ >= setup().enable_wait;
}

bool SimulatedDevice::runs_into_limit(int direction) const {
    return is_closed(direction < 0 ? setup().limit_min : setup().limit_max);
}

bool SimulatedDevice::triggered() const {
    const auto inputs = static_cast<std::uint32_t>(kTriggerInputs.of(trigger_));
    const bool opens = (trigger_ & kTriggerOpens) != 0;
    return inputs != 0 && is_closed(inputs) != opens;
}

Tick SimulatedDevice::next_due(Tick until) const {
    const auto due = channels_.next();
    return due ? std::min(until, *due) : until;
}

/// Returns false to pause after this tick: for a limit switch, or to look at the inputs.
bool SimulatedDevice::on_step(StepEdge step) {
    if (runs_into_limit(step.direction)) {
        into_limit_ = true;
        return false;
    }
    count_ += step.direction;
    plant_.step(step);
    if (!capture_.keep(step)) { run_bits_ |= kStatusCaptureOverflow; }
    channels_.arrive(step.tick, count_);
    stepped_ = step.direction;
    return plant_.pins() == pins_;
}

/// Looks at the inputs and does what is due after this tick.
void SimulatedDevice::tend() {
    pins_ = plant_.pins();
    channels_.tend(pins_, place());
    if (const std::uint64_t reason = reason_to_cease(); reason != 0) {
        if ((reason & kStatusStoppedByTrigger) != 0) { trigger_count_ = count_; }
        finish(reason);
    }
    into_limit_ = false;
    stepped_ = 0;
    if (channels_.is_host_silent()) { take_enable(); }
}

/// Why pulses cease after this tick. 0: they do not.
std::uint64_t SimulatedDevice::reason_to_cease() const {
    if (!in_motion()) { return 0; }
    const bool at_limit = into_limit_ || (stepped_ != 0 && runs_into_limit(stepped_));
    return (at_limit ? kStatusStoppedByLimit : 0) | (triggered() ? kStatusStoppedByTrigger : 0) |
           (is_closed(setup().stop) ? kStatusStoppedByInput : 0);
}

DevicePlace SimulatedDevice::place() const {
    return {.now = engine_.now(), .count = count_, .phase = engine_.position().phase()};
}

std::uint64_t SimulatedDevice::status_word() const {
    const auto bit = [](bool set, std::uint64_t mask) { return set ? mask : 0; };
    return run_bits_ | bit(has_lost_ticks_, kStatusLostTicks) | bit(in_motion(), kStatusMoving) |
           bit(phase_ == Phase::Tail, kStatusInTail) | bit(is_closed(setup().limit_min), kStatusLimitMin) |
           bit(is_closed(setup().limit_max), kStatusLimitMax) | bit(is_closed(setup().home), kStatusHome) |
           bit(enabled_.has_value(), kStatusEnabled) | bit(channels_.is_host_silent(), kStatusHostSilent) |
           bit(setup_refused_ != 0 && window_.load(kSetupRequest) == setup_refused_, kStatusBadSetup);
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
    store(kEncoder, abilities_.has_encoder ? plant_.encoder() : count_);
    window_.store(kSegmentTail, abilities_.frames_stay && in_motion() ? frame_.entry : segments_.taken());
    window_.store(kCaptureHead, capture_.head());
    window_.store(kCaptureLost, capture_.lost());
    window_.store(kCaptureSum, capture_.sum());
    window_.store(kCaptureSums, capture_.sums());
    window_.store(kSetup, setup_taken_);
    channels_.publish(engine_.now(), in_motion());
    window_.store(kSequence, ++sequence_);
}

}  // namespace lockstep
