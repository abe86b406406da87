// A custom device behind the register map (sim_fpga/REGISTERS.md). It works tick by tick with additions only, like
// hardware. An axis drives it if the machine's file says device: "uio:PATH".
//
//     own_device PATH        # until SIGTERM or SIGINT
//
// It has a home switch, no limit switches and no outputs. Its pulses are as long as it makes them. Hardware would set
// its pins in pulse().
#include <signal.h>
#include <time.h>

#include <cstdio>
#include <optional>
#include <random>

#include "core/step/tick_engine.hpp"
#include "sim_fpga/register_ring.hpp"
#include "sim_fpga/register_window.hpp"

namespace {

using namespace lockstep;
using namespace lockstep::registers;

constexpr std::int64_t kTick_ns = 1000;
constexpr std::uint64_t kHomeInput = 4;     // input 2 is the home switch
constexpr std::int64_t kHomeCloses = -700;  // the home switch is closed up to this count; the device starts at 0

constexpr RegisterRing kSegments(kSegmentRing, 2048, kSegmentRingEntryBytes);
constexpr RegisterRing kCaptures(kCaptureRing, kCaptureRingMostEntries, kCaptureRingEntryBytes);

class OwnDevice {
public:
    OwnDevice(RegisterWindow window, Tick now, std::uint64_t power_up) : window_(std::move(window)), now_(now) {
        window_.store(kVersion, kVersionValue);
        window_.store(kMapChecksum, kMapChecksumValue);
        window_.store(kTickNs, kTick_ns);
        window_.store(kPowerUp, power_up);
        window_.store(kSegmentEntries, kSegments.entries());
        window_.store(kCaptureEntries, kCaptures.entries());
        window_.store(kLeastStepTicks, 2);
        window_.store(kTimeUnitPs, kTick_ns * 1000);
        window_.store(kLongestPieceTicks, static_cast<std::uint64_t>(kMaxPieceTicks.value));
        window_.store(kInputChannels, 3);
        window_.store(kFeatures, kFeaturesFramesStay);  // an entry is taken as it is executed
        publish();
        window_.store(kMagic, kMagicValue);  // the other words are valid from now on
    }

    void advance(Tick until) {
        if (state_ != State::Rests && (window_.load(kStop) == run_ || window_.load(kEnable) == 0)) {
            finish(kStatusStoppedByHost);
        }
        for (decide(); now_ < until; decide()) {
            now_ += Ticks{1};
            if (state_ == State::InBody || state_ == State::InTail) { move(); }
        }
        publish();
    }

private:
    enum class State { Rests, Waits, InBody, InTail };

    /// A word of the oldest entry that was not taken yet.
    std::uint64_t word(std::size_t at) const { return window_.load(kSegments.entry(taken_) + at); }
    std::int64_t number(std::size_t at) const { return static_cast<std::int64_t>(word(at)); }
    bool is_loaded() const { return taken_ != window_.load(kSegmentHead); }
    /// The oldest entry begins a frame of this run.
    bool is_of_run(std::uint64_t run) const {
        const std::uint64_t tag = word(kSegmentRingHeaderTag);
        return (tag & kSegmentRingHeaderTagIsHeader) != 0 && kSegmentRingHeaderTagRun.shows(tag, run);
    }
    std::uint64_t body() const { return kSegmentRingHeaderCountsBody.of(word(kSegmentRingHeaderCounts)); }
    std::uint64_t tail() const { return kSegmentRingHeaderCountsTail.of(word(kSegmentRingHeaderCounts)); }
    void skip_frame() { taken_ += 1 + body() + tail(); }
    bool is_vetoed(std::uint64_t frame) const { return window_.load(kVeto) <= frame; }
    bool may_run(std::uint64_t frame) const {
        const bool is_ready = window_.load(kSetupRequest) != 0 && window_.load(kEnable) != 0;
        return is_ready && !is_vetoed(frame) && window_.load(kArmed) >= frame && window_.load(kRunRequest) == run_;
    }
    bool starts_here() const {
        const auto ahead =
            static_cast<std::int32_t>(word(kSegmentRingHeaderCounts) - static_cast<std::uint64_t>(count_));
        const Position from = Position::from_count(count_ + ahead, word(kSegmentRingHeaderPhase));
        const bool same =
            from == position() ||
            (state_ == State::Waits && (from == rest_position(count_, false) || from == rest_position(count_, true)));
        return number(kSegmentRingHeaderStart) == now_.value && same;
    }
    Position position() const { return Position::from_count(count_, phase_); }

    /// Begins and ends runs, frames and pieces at this tick.
    void decide() {
        if (state_ == State::Rests) { take_run(); }
        if (state_ == State::Waits) { begin_first_frame(); }
        if (state_ == State::InBody && left_ == Ticks{}) { body_left_ > 0 ? begin_piece() : end_body(); }
        if (state_ == State::InTail && left_ == Ticks{}) { tail_left_ > 0 ? begin_piece() : finish(0); }
    }

    void take_run() {
        const std::uint64_t asked = window_.load(kRunRequest);
        while (is_loaded() && is_of_run(run_)) { skip_frame(); }
        if (asked == run_) { return; }
        run_ = asked;
        frame_ = 0;
        ended_ = 0;
        trigger_ = window_.load(kTrigger);
        state_ = State::Waits;
    }

    void begin_first_frame() {
        while (is_loaded() && !is_of_run(run_)) { skip_frame(); }
        if (!is_loaded() || number(kSegmentRingHeaderStart) > now_.value) { return; }
        if (is_vetoed(1)) { return finish(0); }
        if (!may_run(1)) { return; }
        if (!starts_here()) { return finish(kStatusBadSegment); }
        begin_frame();
        if (is_triggered()) { finish_by_trigger(); }
    }

    void begin_frame() {
        ++frame_;
        body_left_ = body();
        tail_left_ = tail();
        is_last_ = (word(kSegmentRingHeaderTag) & kSegmentRingHeaderTagLastFrame) != 0;
        phase_ = word(kSegmentRingHeaderPhase);
        ++taken_;
        state_ = State::InBody;
        begin_piece();
    }

    /// Begins the next frame, or this frame's tail.
    void end_body() {
        if (is_last_) { return finish(0); }
        const std::uint64_t tail = taken_;
        taken_ += tail_left_;
        const bool is_next =
            is_loaded() && is_of_run(run_) && kSegmentRingHeaderTagFrame.shows(word(kSegmentRingHeaderTag), frame_ + 1);
        if (is_next && may_run(frame_ + 1)) {
            if (starts_here()) { return begin_frame(); }
            ended_ |= kStatusBadSegment;
        }
        taken_ = tail;
        state_ = State::InTail;
    }

    void begin_piece() {
        left_ = Ticks{static_cast<std::int64_t>(kSegmentRingPieceTagTicks.of(word(kSegmentRingPieceTag)))};
        engine_.emplace(Position::from_count(count_, phase_),
                        Piece{left_, {number(kSegmentRingPieceVelocity)}, {number(kSegmentRingPieceAcceleration)}});
        ++taken_;
        --(state_ == State::InBody ? body_left_ : tail_left_);
    }

    /// Runs one tick of the add-only engine.
    void move() {
        const int direction = engine_->tick();
        phase_ = engine_->phase;
        left_ = left_ - Ticks{1};
        if (direction != 0) { pulse(direction); }
    }

    void pulse(int direction) {
        count_ += direction;
        const std::uint64_t kept = captured_ - window_.load(kCaptureTail);
        if (kept < kCaptures.entries()) {
            const std::uint64_t tick = kCaptureRingStepTick.word(static_cast<std::uint64_t>(now_.value));
            window_.store(kCaptures.entry(captured_++), tick | (direction > 0 ? kCaptureRingStepForward : 0));
        } else {
            ++lost_;
            ended_ |= kStatusCaptureOverflow;
        }
        if (is_triggered()) { finish_by_trigger(); }
    }

    bool is_home() const { return count_ <= kHomeCloses; }
    bool is_triggered() const {
        const bool opens = (trigger_ & kTriggerOpens) != 0;
        return kTriggerInputs.of(trigger_) == kHomeInput && is_home() != opens;
    }
    void finish_by_trigger() {
        trigger_count_ = count_;
        finish(kStatusStoppedByTrigger);
    }

    void finish(std::uint64_t why) {
        ended_ |= kStatusFinished | why | (state_ == State::InTail ? kStatusInTail : 0);
        state_ = State::Rests;
        engine_.reset();
        left_ = Ticks{};
        taken_ += body_left_ + tail_left_;  // of a frame that was cut
        body_left_ = 0;
        tail_left_ = 0;
    }

    void publish() {
        const bool moves = state_ == State::InBody || state_ == State::InTail;
        window_.store(kSequence, ++sequence_);
        window_.store(kTick, static_cast<std::uint64_t>(now_.value));
        window_.store(kStatus, ended_ | (moves ? kStatusMoving : 0) | (state_ == State::InTail ? kStatusInTail : 0) |
                                   (is_home() ? kStatusHome : 0));
        window_.store(kCount, static_cast<std::uint64_t>(count_));
        window_.store(kPhase, phase_);
        window_.store(kVelocity, engine_ ? engine_->velocity : 0);
        window_.store(kRun, run_);
        window_.store(kFrame, frame_);
        window_.store(kTriggerCount, static_cast<std::uint64_t>(trigger_count_));
        window_.store(kEncoder, static_cast<std::uint64_t>(count_));
        window_.store(kSegmentTail, taken_);
        window_.store(kCaptureHead, captured_);
        window_.store(kCaptureLost, lost_);
        window_.store(kSetup, window_.load(kSetupRequest));
        window_.store(kSequence, ++sequence_);
    }

    RegisterWindow window_;
    Tick now_;
    State state_ = State::Rests;
    std::uint64_t run_ = 0;
    std::uint64_t frame_ = 0;
    bool is_last_ = false;
    std::uint64_t trigger_ = 0;
    std::uint64_t ended_ = 0;      // bits of STATUS that say how the run ended
    std::uint64_t taken_ = 0;      // entries taken from the segment ring
    std::uint64_t body_left_ = 0;  // pieces of the frame that were not taken yet
    std::uint64_t tail_left_ = 0;
    std::optional<Accumulator> engine_;
    Ticks left_;  // ticks left in the piece
    std::int64_t count_ = 0;
    std::uint64_t phase_ = kRestPhase;
    std::int64_t trigger_count_ = 0;
    std::uint64_t captured_ = 0;
    std::uint64_t lost_ = 0;
    std::uint64_t sequence_ = 0;
};

/// Returns machine time, which all processes of one host share.
Tick machine_now() {
    timespec time{};
    clock_gettime(CLOCK_MONOTONIC, &time);
    return {(time.tv_sec * 1'000'000'000 + time.tv_nsec) / kTick_ns};
}

volatile sig_atomic_t must_end = 0;

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: own_device PATH\n");
        return 2;
    }
    auto window = RegisterWindow::create_file(argv[1]);
    if (!window) {
        std::fprintf(stderr, "own_device: %s\n", window.error().c_str());
        return 1;
    }
    struct sigaction end {};
    end.sa_handler = [](int) { must_end = 1; };
    sigaction(SIGTERM, &end, nullptr);
    sigaction(SIGINT, &end, nullptr);
    OwnDevice device(*window, machine_now(), std::random_device()() | 1U);
    while (must_end == 0) {
        device.advance(machine_now());
        const timespec pause{.tv_sec = 0, .tv_nsec = 500'000};
        nanosleep(&pause, nullptr);
    }
}
