#include "sim_fpga/device.hpp"

#include <algorithm>
#include <utility>

#include "core/step/executable.hpp"

namespace lockstep {

using namespace registers;

namespace {

bool is_vetoed(const RegisterWindow& window, FrameNumber frame) { return window.load(kVeto) <= frame; }

bool is_stop_asked(const RegisterWindow& window) {
    const std::uint64_t stop = window.load(kStop);
    return stop != 0 && stop == window.load(kRunRequest);
}

bool joins(const StepEngine& engine, const FrameHeader& frame) {
    return frame.start == engine.now() && frame.from(engine.position().count()) == engine.position();
}

bool is_closed(const Channels& channels, std::uint32_t inputs) { return (channels.closed() & inputs) != 0; }

bool runs_into_limit(const Channels& channels, int direction) {
    return is_closed(channels, direction < 0 ? channels.setup().limit_min : channels.setup().limit_max);
}

/// trigger: the word of TRIGGER.
bool is_triggered(const Channels& channels, std::uint64_t trigger) {
    const auto inputs = static_cast<std::uint32_t>(kTriggerInputs.of(trigger));
    const bool opens = (trigger & kTriggerOpens) != 0;
    return inputs != 0 && is_closed(channels, inputs) != opens;
}

}  // namespace

static_assert(DeviceAbilities{}.longest_piece == kMaxPieceTicks);

SimulatedDevice::SimulatedDevice(RegisterWindow window, Plant plant, std::int64_t tick_ns, Tick now,
                                 std::uint64_t power_up, const DeviceAbilities& abilities)
    : window_(window),
      abilities_(abilities),
      identity_(window, tick_ns, power_up),
      motor_(window, abilities),
      segments_(window, abilities.segment_entries, abilities.longest_piece),
      capture_(window, abilities.capture_entries),
      channels_(window, abilities),
      plant_(std::move(plant)),
      engine_(now, rest_position(0, false)) {
    identity_.store(abilities);
    tend();
    publish();
    identity_.show();
}

bool SimulatedDevice::is_intact() const {
    const std::uint64_t loaded = window_.load(kSegmentHead) - segments_.taken();
    const std::uint64_t captured = capture_.head() - window_.load(kCaptureTail);
    return identity_.is_intact() && loaded <= abilities_.segment_entries && captured <= abilities_.capture_entries &&
           channels_.is_intact();
}

void SimulatedDevice::advance(Tick until) {
    const auto setup = in_motion() ? std::nullopt : motor_.take_setup();
    if (setup) { channels_.set(*setup, place()); }
    take_enable();
    channels_.take_orders(place());
    take_run();
    if (phase_ != Phase::AtRest && is_stop_asked(window_)) { finish(kStatusStoppedByHost); }
    if (phase_ != Phase::AtRest && has_lost_ticks_) { finish(kStatusLostTicks); }
    tend();
    for (Tick next = decide(until); engine_.now() < until; next = decide(until)) {
        const Tick due = std::min({next, channels_.next().value_or(next), plant_.wiring().next(now()).value_or(next)});
        if (engine_.idle()) {
            engine_.wait(due);
        } else {
            engine_.run(due, [this](StepEdge step) { return on_step(step); });
        }
        tend();
    }
    publish();
}

Tick SimulatedDevice::next_step(Tick until) const {
    if (phase_ == Phase::AtRest) { return until; }
    if (phase_ == Phase::Waiting) {
        const auto first = segments_.front();
        return first ? std::clamp(first->start, now(), until) : until;
    }
    StepEngine ahead = engine_;
    Tick step = std::min(until, now() + engine_.remaining());
    ahead.run(step, [&](StepEdge edge) {
        step = edge.tick;
        return false;
    });
    return step;
}

void SimulatedDevice::take_enable() {
    const bool falls_off = channels_.is_host_silent() && channels_.setup().disable_at_silence;
    if (motor_.take_enable(falls_off, engine_.now()) && in_motion()) { finish(kStatusStoppedByHost); }
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
    if (is_vetoed(window_, 1)) {
        finish(0);
        return until;
    }
    if (first->start > engine_.now()) { return std::min(until, first->start); }
    if (may_run(1)) {
        const bool joins =
            first->is_frame(1) && first->start == engine_.now() && rebase_to(first->from(engine_.position().count()));
        if (!joins || !segments_.take_frame(1, next_)) {
            finish(kStatusBadSegment);
        } else if (is_closed(channels_, channels_.setup().stop)) {
            finish(kStatusStoppedByInput);
        } else if (is_triggered(channels_, trigger_)) {
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
        if (joins(engine_, *next) && segments_.take_frame(number, next_)) {
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
    return !is_vetoed(window_, frame) && window_.load(kArmed) >= frame && window_.load(kRunRequest) == run_ &&
           !has_lost_ticks_ && motor_.may_move(engine_.now(), channels_.setup().enable_wait);
}

/// A run may begin at the axis's position, with the phase that a stop left, or with the phase at rest.
bool SimulatedDevice::rebase_to(Position from) {
    const bool same_place = from == engine_.position() || (from.count() == count_ && rests_on_whole_step(from));
    if (same_place) { engine_.rebase(from); }
    return same_place;
}

/// Returns false to pause after this tick: for a limit switch, or to look at the inputs.
bool SimulatedDevice::on_step(StepEdge step) {
    if (runs_into_limit(channels_, step.direction)) {
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
    channels_.tend(plant_.wiring().look(pins_, now()), place());
    const OutputUnit& outputs = channels_.outputs();
    plant_.wiring().follow(
        outputs.digital(), [&](std::size_t channel) { return outputs.analog(channel, now()); }, now());
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
    const bool at_limit = into_limit_ || (stepped_ != 0 && runs_into_limit(channels_, stepped_));
    return (at_limit ? kStatusStoppedByLimit : 0) | (is_triggered(channels_, trigger_) ? kStatusStoppedByTrigger : 0) |
           (is_closed(channels_, channels_.setup().stop) ? kStatusStoppedByInput : 0);
}

DevicePlace SimulatedDevice::place() const {
    return {.now = engine_.now(), .count = count_, .phase = engine_.position().phase()};
}

std::uint64_t SimulatedDevice::status_word() const {
    const auto bit = [](bool set, std::uint64_t mask) { return set ? mask : 0; };
    return run_bits_ | bit(has_lost_ticks_, kStatusLostTicks) | bit(in_motion(), kStatusMoving) |
           bit(phase_ == Phase::Tail, kStatusInTail) |
           bit(is_closed(channels_, channels_.setup().limit_min), kStatusLimitMin) |
           bit(is_closed(channels_, channels_.setup().limit_max), kStatusLimitMax) |
           bit(is_closed(channels_, channels_.setup().home), kStatusHome) | bit(motor_.is_enabled(), kStatusEnabled) |
           bit(channels_.is_host_silent(), kStatusHostSilent) | bit(motor_.refuses_setup(), kStatusBadSetup);
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
    window_.store(kSetup, motor_.setup_number());
    channels_.publish(engine_.now(), in_motion());
    window_.store(kSequence, ++sequence_);
}

}  // namespace lockstep
