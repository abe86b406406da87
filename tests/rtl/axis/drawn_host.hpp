// A host that does everything a host may do, and much that it may not, at drawn times.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>

#include "core/hardware/device_abilities.hpp"
#include "core/step/executable.hpp"
#include "core/units.hpp"
#include "sim_fpga/register_ring.hpp"
#include "sim_fpga/registers.hpp"
#include "tests/property/step/random_segment.hpp"

namespace lockstep::rtl {

/// Bench: both devices, with kAbilities, which says what they can do.
template <typename Bench>
class DrawnHost {
public:
    DrawnHost(Bench& bench, std::uint64_t seed) : bench_(bench), draw_(seed) {
        set_up();
        bench_.store(registers::kEnable, 1);
    }

    /// Acts between two ticks.
    void act() {
        if (draw_.one_in(has_ended() ? 5 : 500)) { begin_run(); }
        if (frames_left_ > 0 && draw_.one_in(4)) { load_frame(); }
        if (draw_.one_in(4)) { arm(); }
        if (draw_.one_in(300)) { bench_.store(registers::kVeto, frame_ + below(4)); }
        if (draw_.one_in(1'500)) { bench_.store(registers::kStop, run_); }
        if (!is_slow_ && draw_.one_in(20)) { drain(); }
        if (draw_.one_in(4'000)) { is_slow_ = !is_slow_; }
        beat();
        touch_inputs();
        touch_setup();
        if (draw_.one_in(200)) { change_outputs(); }
    }
    std::int64_t pieces() const { return pieces_; }

private:
    static constexpr std::uint64_t kNoVeto = std::numeric_limits<std::uint64_t>::max();

    std::uint64_t below(std::int64_t bound) { return static_cast<std::uint64_t>(draw_.below(bound)); }
    bool has_ended() const {
        const bool is_finished = (bench_.load(registers::kStatus) & registers::kStatusFinished) != 0;
        return bench_.load(registers::kRun) == run_ && (is_finished || run_ == 0);
    }
    std::uint64_t any_inputs() { return draw_.one_in(2) ? 0 : below(256) & below(256) & below(256); }

    void begin_run() {
        run_ += draw_.one_in(50) ? std::uint64_t{1} << 24 : 1;
        frame_ = draw_.one_in(60) ? 1 : 0;
        armed_ = 0;
        bench_.store(registers::kArmed, 0);
        bench_.store(registers::kVeto, draw_.one_in(30) ? below(3) : kNoVeto);
        const std::uint64_t opens = draw_.one_in(4) ? registers::kTriggerOpens : 0;
        bench_.store(registers::kTrigger, draw_.one_in(4) ? any_inputs() | opens : 0);
        bench_.store(registers::kRunRequest, run_);
        start_ = bench_.now() + Ticks{1 + draw_.below(25)};
        const auto count = static_cast<std::int64_t>(bench_.load(registers::kCount));
        at_ = Position::from_count(count, bench_.load(registers::kPhase));
        if (draw_.one_in(2)) { at_ = rest_position(count, draw_.one_in(2)); }
        frames_left_ = 1 + draw_.below(12);
    }

    Piece piece() {
        ++pieces_;
        Piece drawn = draw_.next(6).piece;
        if (draw_.one_in(2)) { drawn.velocity.raw = (std::numeric_limits<std::int64_t>::max() >> draw_.below(4)) / 2; }
        if (draw_.one_in(2)) { drawn.velocity.raw = -drawn.velocity.raw; }
        return executable(drawn) ? drawn : Piece{drawn.ticks, drawn.velocity, {}};
    }
    void put_piece(const Piece& piece, std::uint64_t entry) {
        using namespace registers;
        const std::size_t at = segments_.entry(entry);
        const bool is_wrong = draw_.one_in(2'000);
        const std::uint64_t ticks = kSegmentRingPieceTagTicks.word(static_cast<std::uint64_t>(piece.ticks.value));
        bench_.store(at + kSegmentRingPieceTag, is_wrong ? below(2) : ticks);
        bench_.store(at + kSegmentRingPieceVelocity, static_cast<std::uint64_t>(piece.velocity.raw));
        bench_.store(at + kSegmentRingPieceAcceleration, static_cast<std::uint64_t>(piece.acceleration.raw));
    }

    /// The next frame of the run, mostly as it should be.
    void load_frame() {
        using namespace registers;
        const std::uint64_t body = draw_.one_in(300) ? 0 : 1 + below(4);
        const std::uint64_t tail = below(4);
        const std::uint64_t used = head_ - bench_.load(kSegmentTail);
        if (used + 1 + body + tail > segments_.entries()) { return; }
        const std::uint64_t number = ++frame_;
        --frames_left_;
        const bool is_last = frames_left_ == 0 && !draw_.one_in(4);
        const std::size_t at = segments_.entry(head_);
        const std::uint64_t run = draw_.one_in(100) ? run_ - 1 : run_;
        bench_.store(at + kSegmentRingHeaderTag,
                     (draw_.one_in(300) ? 0 : kSegmentRingHeaderTagIsHeader) |
                         (is_last ? kSegmentRingHeaderTagLastFrame : 0) | kSegmentRingHeaderTagRun.word(run) |
                         kSegmentRingHeaderTagFrame.word(draw_.one_in(100) ? number + 1 : number));
        const std::int64_t late = draw_.one_in(100) ? draw_.below(3) - 1 : 0;
        bench_.store(at + kSegmentRingHeaderStart, static_cast<std::uint64_t>(start_.value + late));
        const std::uint64_t off = draw_.one_in(100) ? 1 : 0;
        bench_.store(at + kSegmentRingHeaderCounts,
                     kSegmentRingHeaderCountsCount.word(static_cast<std::uint64_t>(at_.count()) + off) |
                         kSegmentRingHeaderCountsBody.word(body) | kSegmentRingHeaderCountsTail.word(tail));
        const std::uint64_t bent = draw_.one_in(100) ? std::uint64_t{1} << below(64) : 0;
        load_outputs(run, number, 12, false);
        load_outputs(run, number, 12, true);
        bench_.store(kOutputHead, output_head_);
        bench_.store(at + kSegmentRingHeaderPhase, draw_.one_in(50) ? kRestPhase : at_.phase() ^ bent);
        for (std::uint64_t n = 1; n <= body + tail; ++n) {
            const Piece drawn = piece();
            put_piece(drawn, head_ + n);
            if (n > body) { continue; }
            start_ += drawn.ticks;
            at_ = at_ + drawn.covered();
        }
        head_ += 1 + body + tail;
        const std::uint64_t missing = draw_.one_in(200) ? 1 + below(3) : 0;
        bench_.store(kSegmentHead, head_ - missing);
        missing_ = missing != 0;
    }

    /// Changes of the frame's outputs, mostly in order and possible.
    void load_outputs(std::uint64_t run, std::uint64_t frame, std::int64_t ticks, bool is_tail) {
        using namespace registers;
        std::int64_t at = 1;
        for (std::int64_t left = draw_.one_in(3) ? draw_.below(5) : 0; left > 0; --left) {
            if (output_head_ - bench_.load(kOutputTail) >= changes_.entries()) { return; }
            at += draw_.below(1 + ticks / 2);
            const std::size_t entry = changes_.entry(output_head_++);
            const std::uint64_t kind = draw_.one_in(300) ? 2 + below(2) : below(2);
            const std::uint64_t other = draw_.one_in(40) ? below(3) - 1 : 0;
            bench_.store(entry + kOutputRingTag, (is_tail != draw_.one_in(40) ? kOutputRingTagTail : 0) |
                                                     kOutputRingTagKind.word(kind) |
                                                     kOutputRingTagChannel.word(draw_.one_in(300) ? 2 : below(2)) |
                                                     kOutputRingTagRun.word(run - (draw_.one_in(40) ? 1 : 0)) |
                                                     kOutputRingTagFrame.word(frame + other));
            bench_.store(entry + kOutputRingAt, draw_.one_in(300) ? below(4) : static_cast<std::uint64_t>(at));
            bench_.store(entry + kOutputRingValue, kind == 1 ? any_analog() : any_levels());
            bench_.store(entry + kOutputRingSlope, draw_.one_in(3) ? 0 : any_slope());
        }
    }
    std::uint64_t bits(unsigned count) { return below(std::int64_t{1} << count); }
    std::uint64_t any_levels() { return bits(16) | bits(8) << 16 | (draw_.one_in(300) ? std::uint64_t{1} << 24 : 0); }
    std::uint64_t any_analog() { return bits(62) << (draw_.one_in(4) ? 2 : 0) >> below(3); }
    std::uint64_t any_slope() { return (draw_.one_in(2) ? ~std::uint64_t{0} : 0) ^ bits(62) >> below(10); }

    void change_outputs() {
        using namespace registers;
        bench_.store(kDirectOutputs, bits(40));
        for (const std::size_t n : {0, 1}) {
            bench_.store(kAnalogTable + n * kAnalogTableEntryBytes + kAnalogTableDirectValue, any_analog());
        }
        bench_.store(kDirectRequest, ++request_);
    }

    void arm() {
        if (missing_ && draw_.one_in(10)) {
            missing_ = false;
            bench_.store(registers::kSegmentHead, head_);
        }
        armed_ = std::max(armed_, frame_ - std::min(frame_, below(8) / 6));
        bench_.store(registers::kArmed, armed_);
    }

    /// Reads the new steps and events, which must be the same.
    void drain() {
        using namespace registers;
        const std::uint64_t head = bench_.load(kCaptureHead);
        for (; captured_ != head; ++captured_) {
            const std::size_t at = captures_.entry(captured_) + kCaptureRingStep;
            ASSERT_EQ(bench_.verilog().read(at), bench_.load(at)) << "captured step " << captured_;
        }
        bench_.store(kCaptureTail, captured_);
        for (const std::uint64_t end = bench_.load(kEventHead); noted_ != end; ++noted_) {
            for (std::size_t at = events_.entry(noted_); at < events_.entry(noted_) + kEventRingEntryBytes; at += 8) {
                ASSERT_EQ(bench_.verilog().read(at), bench_.load(at)) << "event " << noted_ << ", word at " << at;
            }
        }
        bench_.store(kEventTail, noted_);
    }

    void beat() {
        if (draw_.one_in(2'000)) { is_silent_ = !is_silent_; }
        if (is_silent_ ? draw_.one_in(200) : draw_.one_in(8)) { bench_.store(registers::kBeat, ++beat_); }
    }

    void touch_inputs() {
        for (unsigned n = 3; n < 8; ++n) {
            const bool high = (pins_ >> n & 1) != 0;
            if (!draw_.one_in(high ? 40 : 800)) { continue; }
            pins_ ^= 1U << n;
            bench_.plant_of_device().set_pin(n, !high);
        }
    }

    void touch_setup() {
        if (draw_.one_in(2'000)) { bench_.store(registers::kEnable, below(2)); }
        if (draw_.one_in(40)) { bench_.store(registers::kEnable, 1); }
        if (draw_.one_in(1'000)) { set_up(); }
    }
    void set_up() {
        using namespace registers;
        const std::uint64_t width = kCan.longest_time;
        bench_.store(kStepWidth, draw_.one_in(20) ? width + 1 : up_to(width));
        bench_.store(kEnableTicks, draw_.one_in(2) ? 0 : below(50));
        bench_.store(kInputsInverted, draw_.one_in(4) ? any_inputs() : 0);
        bench_.store(kLimitMinInputs, 1U | any_inputs());
        bench_.store(kLimitMaxInputs, 2U | any_inputs());
        bench_.store(kHomeInputs, any_inputs() | (draw_.one_in(30) ? 256 : 0));
        bench_.store(kStopInputs, draw_.one_in(2) ? any_inputs() : 0);
        bench_.store(kOutputsInverted, bits(8));
        bench_.store(kOutputsAtCut, bits(24) | bits(2) << 32);
        bench_.store(kOutputsAtSilence, bits(24) | bits(2) << 32 | kOutputsAtSilenceDisable.word(below(2)) |
                                            (draw_.one_in(30) ? std::uint64_t{1} << 34 : 0));
        bench_.store(kSilenceTicks, draw_.one_in(2) ? 0 : 50 + below(200));
        for (std::size_t n = 0; n < 8; ++n) {
            bench_.store(kInputTable + n * kInputTableEntryBytes, draw_.one_in(2) ? 0 : below(12));
        }
        for (std::size_t n = 0; n < 3; ++n) {
            const std::uint64_t longest = kCan.longest_pwm_period;
            const std::uint64_t period = draw_.one_in(30) ? longest + 1 : up_to(longest);
            bench_.store(kAnalogTable + n * kAnalogTableEntryBytes, n < 2 || draw_.one_in(30) ? period : 0);
        }
        bench_.store(kInputTable + 9 * kInputTableEntryBytes, draw_.one_in(30) ? 1 : 0);
        bench_.store(kSetupRequest, ++setup_);
    }

    std::uint64_t up_to(std::uint64_t longest) { return below(static_cast<std::int64_t>(longest) + 1); }

    Bench& bench_;
    static constexpr const DeviceAbilities& kCan = Bench::kAbilities;
    RegisterRing segments_{registers::kSegmentRing, kCan.segment_entries, registers::kSegmentRingEntryBytes};
    RegisterRing changes_{registers::kOutputRing, kCan.output_entries, registers::kOutputRingEntryBytes};
    RegisterRing events_{registers::kEventRing, kCan.event_entries, registers::kEventRingEntryBytes};
    RegisterRing captures_{registers::kCaptureRing, kCan.capture_entries, registers::kCaptureRingEntryBytes};
    testing::RandomSegments draw_;
    std::uint64_t run_ = 0;
    std::uint64_t frame_ = 0;
    std::uint64_t armed_ = 0;
    std::uint64_t head_ = 0;
    std::uint64_t output_head_ = 0;
    std::uint64_t request_ = 0;
    std::uint64_t captured_ = 0;
    std::uint64_t noted_ = 0;
    std::uint64_t beat_ = 0;
    std::uint64_t setup_ = 0;
    std::uint32_t pins_ = 0;
    bool is_silent_ = false;
    bool is_slow_ = false;  // it does not read the capture ring
    bool missing_ = false;
    std::int64_t frames_left_ = 0;
    Tick start_;
    Position at_;
    std::int64_t pieces_ = 0;
};

}  // namespace lockstep::rtl
