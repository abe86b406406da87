#include "tests/property/firmware/random_host.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

#include "core/step/executable.hpp"

namespace lockstep::testing {

using namespace registers;

namespace {

/// Limit switches 60 steps away, so that motion often meets them.
MotorConfig narrow_motor(bool has_limits) {
    const double way_mm = has_limits ? 0.7 : 1e6;
    MotorConfig motor;
    motor.name = "X";
    motor.steps_per_mm = 80;
    motor.position_min_mm = -way_mm;
    motor.position_max_mm = way_mm;
    motor.homing.switch_position_mm = has_limits ? -0.3 : -1e6;
    motor.plant = {
        .start_position_mm = 0, .travel_margin_mm = 0.05, .max_torque_accel_mm_s2 = 1e9, .max_jump_mm_s = 1e7};
    return motor;
}

firmware::Abilities any_abilities(std::uint64_t seed) {
    return {.power_up = seed,
            .lead_ticks = seed % 200,
            .pin_ticks = seed % 2000,
            .inputs = 3 + seed % 30,
            .digital_outputs = seed / 7 % 17,
            .analog_outputs = seed / 5 % 9,
            .has_encoder = seed % 3 != 0,
            .can_enable = true,
            .can_compare = seed % 4 != 0};
}

std::uint64_t word(std::int64_t value) { return static_cast<std::uint64_t>(value); }

}  // namespace

RandomHost::RandomHost(std::uint64_t seed)
    : random_(seed),
      devices_(narrow_motor(seed % 2 == 0), any_abilities(random_()), Tick{static_cast<std::int64_t>(seed % 1000)}),
      now_{static_cast<std::int64_t>(seed % 1000)} {
    is_lazy_ = one_in(4);
    set_up();
    devices_.store(kEnable, 1);
}

std::optional<std::string> RandomHost::turn() {
    for (std::int64_t left = below(6); left > 0; --left) { act(); }
    if (one_in(60)) { write_anything(); }
    if (one_in(2000)) { devices_.lose_ticks(); }
    now_ += Ticks{below(one_in(3) ? 4 : one_in(4) ? 3000 : 200)};
    devices_.advance(now_);
    seen_ |= devices_.load(kStatus);
    return devices_.difference();
}

/// Most setups are possible. Some are beyond the device.
void RandomHost::set_up() {
    const auto all_inputs = (std::uint64_t{1} << devices_.load(kInputChannels)) - 1;
    const auto all_outputs = (std::uint64_t{1} << devices_.load(kDigitalChannels)) - 1;
    const auto inputs = [&] { return one_in(3) ? random_() & random_() & all_inputs & 0xFFFF'FFFF : 0; };
    const auto outputs = [&] { return bits(16) & all_outputs; };
    const auto safe = [&] {
        const auto analog = bits(8) & ((std::uint64_t{1} << devices_.load(kAnalogChannels)) - 1);
        return kOutputsAtCutLevels.word(bits(16)) | kOutputsAtCutMask.word(outputs()) |
               kOutputsAtCutAnalogOff.word(analog);
    };
    devices_.store(kStepWidth, one_in(20) ? bits(40) : bits(29));
    devices_.store(kEnableTicks, one_in(3) ? bits(8) : 0);
    devices_.store(kInputsInverted, one_in(8) ? inputs() : 0);
    devices_.store(kLimitMinInputs, one_in(6) ? inputs() : 1);
    devices_.store(kLimitMaxInputs, one_in(6) ? inputs() : 2);
    devices_.store(kHomeInputs, 4 & all_inputs);
    devices_.store(kStopInputs, one_in(6) ? inputs() & ~7U : 0);
    devices_.store(kOutputsInverted, outputs());
    devices_.store(kOutputsAtCut, safe());
    devices_.store(kOutputsAtSilence, safe() | kOutputsAtSilenceDisable.word(bits(1)));
    devices_.store(kSilenceTicks, one_in(3) ? 500 + bits(12) : 0);
    devices_.store(kCompareOutputs, devices_.load(kFeatures) & kFeaturesCompare ? outputs() & outputs() : 0);
    devices_.store(kCompareTicks, bits(6));
    for (std::size_t n = 0; n < 3; ++n) { devices_.store(kInputTable + 8 * n, one_in(3) ? bits(7) : 0); }
    devices_.store(kSetupRequest, ++requests_);
}

void RandomHost::act() {
    if (!is_running() && !one_in(5)) {
        begin_run();
        return;
    }
    static const std::array<std::pair<int, void (RandomHost::*)()>, 9> kActions{{{10, &RandomHost::load_frame},
                                                                                 {10, &RandomHost::arm},
                                                                                 {1, &RandomHost::veto},
                                                                                 {1, &RandomHost::begin_run},
                                                                                 {3, &RandomHost::take_records},
                                                                                 {2, &RandomHost::request_outputs},
                                                                                 {2, &RandomHost::disturb_plant},
                                                                                 {1, &RandomHost::set_up},
                                                                                 {0, nullptr}}};
    std::int64_t drawn = below(30);
    for (const auto& [weight, action] : kActions) {
        drawn -= weight;
        if (drawn < 0 && action != nullptr) {
            (this->*action)();
            return;
        }
    }
}

bool RandomHost::is_running() const {
    return run_ != 0 && (devices_.load(kRun) != run_ || (devices_.load(kStatus) & kStatusFinished) == 0);
}

void RandomHost::begin_run() {
    devices_.store(kArmed, 0);
    devices_.store(kVeto, ~std::uint64_t{0});
    devices_.store(kTrigger, one_in(4) ? kTriggerInputs.word(bits(3)) | (bits(1) != 0 ? kTriggerOpens : 0) : 0);
    devices_.store(kRunRequest, ++run_);
    devices_.store(kEnable, one_in(30) ? 0 : 1);
    frame_ = 0;
    const auto count = static_cast<std::int64_t>(devices_.load(kCount));
    at_ = one_in(3) ? Position::from_count(count, devices_.load(kPhase)) : rest_position(count, one_in(2));
    end_ = now_ + Ticks{below(300)};
    for (std::int64_t left = below(6); left > 0; --left) { load_frame(); }
    if (!one_in(8)) { arm(); }
}

Piece RandomHost::any_piece() {
    for (;;) {
        const Piece piece{Ticks{1 + below(one_in(4) ? 2000 : 200)},
                          {static_cast<std::int64_t>(random_()) >> below(9)},
                          {static_cast<std::int64_t>(random_()) >> (6 + below(20))}};
        if (executable(piece)) { return piece; }
    }
}

void RandomHost::put_entry(std::uint64_t tag, std::uint64_t second, std::uint64_t third, std::uint64_t fourth) {
    const std::size_t at = kSegmentRing + head_++ % firmware::kSegmentRoom * kSegmentRingEntryBytes;
    devices_.store(at, tag);
    devices_.store(at + 8, second);
    devices_.store(at + 16, third);
    devices_.store(at + 24, fourth);
}

void RandomHost::put_piece(const Piece& piece) {
    put_entry(kSegmentRingPieceTagTicks.word(word(piece.ticks.value)), word(piece.velocity.raw),
              word(piece.acceleration.raw), 0);
    ++pieces_;
}

/// A frame that joins the one before, unless a word of it is changed.
void RandomHost::load_frame() {
    const auto body = static_cast<std::uint64_t>(1 + below(one_in(20) ? 240 : 5));
    const auto tail = static_cast<std::uint64_t>(below(one_in(20) ? 40 : 4));
    if (head_ - devices_.load(kSegmentTail) + body + tail + 1 > firmware::kSegmentRoom) { return; }
    std::vector<Piece> pieces(body + tail);
    std::ranges::generate(pieces, [&] { return any_piece(); });
    const Ticks ticks = total_ticks(std::vector<Piece>(pieces.begin(), pieces.begin() + static_cast<long>(body)));
    ++frame_;
    load_outputs(ticks.value, false);
    load_outputs(300, true);
    put_entry(kSegmentRingHeaderTagIsHeader | (one_in(6) ? kSegmentRingHeaderTagLastFrame : 0) |
                  kSegmentRingHeaderTagRun.word(run_) |
                  kSegmentRingHeaderTagFrame.word(one_in(50) ? frame_ + 1 : frame_),
              word(end_.value) + (one_in(50) ? 1 : 0),
              kSegmentRingHeaderCountsCount.word(word(at_.count())) | kSegmentRingHeaderCountsBody.word(body) |
                  kSegmentRingHeaderCountsTail.word(tail),
              at_.phase() + (one_in(50) ? 1 : 0));
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        put_piece(pieces[k]);
        if (k < body) { at_ = at_ + pieces[k].covered(); }
    }
    end_ += ticks;
    devices_.store(kOutputHead, output_head_);
    devices_.store(kSegmentHead, one_in(40) ? head_ - 1 : head_);
}

std::uint64_t RandomHost::any_tag() {
    return kOutputRingTagRun.word(run_) | kOutputRingTagFrame.word(one_in(20) ? frame_ - 1 : frame_) |
           kOutputRingTagKind.word(static_cast<std::uint64_t>(one_in(100) ? 3 : below(3))) |
           kOutputRingTagChannel.word(bits(3));
}

void RandomHost::put_change(std::uint64_t tag, std::uint64_t at) {
    const std::size_t entry = kOutputRing + output_head_++ % firmware::kOutputRoom * kOutputRingEntryBytes;
    const bool is_compare = kOutputRingTagKind.of(tag) == 2;
    const bool is_analog = kOutputRingTagKind.of(tag) == 1;
    const auto every = word(one_in(2) ? 1 + below(4) : -1 - below(4));
    const auto near = word(at_.count() + below(9) - 4);
    const auto mask = bits(16) & ((std::uint64_t{1} << devices_.load(kDigitalChannels)) - 1);
    devices_.store(entry, tag);
    devices_.store(entry + 8, at);
    devices_.store(entry + 16, is_compare ? near : is_analog ? random_() >> below(4) : bits(16) | mask << 16);
    devices_.store(entry + 24, is_compare  ? kOutputRingSlopeEvery.word(every) | kOutputRingSlopePulses.word(bits(4))
                               : is_analog ? word(static_cast<std::int64_t>(random_()) >> below(20))
                                           : 0);
}

void RandomHost::load_outputs(std::int64_t ticks, bool is_tail) {
    std::int64_t at = 1;
    for (std::int64_t left = one_in(3) ? below(6) : 0; left > 0; --left) {
        if (output_head_ - devices_.load(kOutputTail) >= firmware::kOutputRoom) { return; }
        at += below(1 + ticks / 3);
        put_change(any_tag() | (is_tail ? kOutputRingTagTail : 0), one_in(50) ? bits(3) : word(at));
    }
}

void RandomHost::arm() { devices_.store(kArmed, frame_); }

void RandomHost::veto() {
    if (one_in(4)) {
        devices_.store(kStop, run_);
    } else {
        devices_.store(kVeto, devices_.load(kFrame) + 1 + static_cast<std::uint64_t>(below(3)));
    }
}

void RandomHost::take_records() {
    if (!is_lazy_) { devices_.store(kCaptureTail, devices_.load(kCaptureHead)); }
    if (one_in(2)) { devices_.store(kEventTail, devices_.load(kEventHead)); }
    devices_.store(kBeat, ++requests_);
}

void RandomHost::request_outputs() {
    devices_.store(kDirectOutputs, random_());
    devices_.store(kAnalogTable + kAnalogTableDirectValue + 16 * bits(3), random_() >> below(4));
    devices_.store(kDirectRequest, ++requests_);
}

void RandomHost::disturb_plant() {
    const auto input = static_cast<unsigned>(below(5)) + 3;
    const bool is_high = one_in(2);
    const std::int64_t way = below(41) - 20;
    devices_.disturb([&](Plant& plant) {
        plant.set_pin(input, is_high);
        if (is_high) { plant.push(way); }
    });
}

/// Any value in any word that the host writes.
void RandomHost::write_anything() {
    const std::size_t entry = kSegmentRing + static_cast<std::size_t>(below(40)) * kSegmentRingEntryBytes;
    const std::size_t output = kOutputRing + static_cast<std::size_t>(below(16)) * kOutputRingEntryBytes;
    const std::array<std::size_t, 4> words{
        kRunRequest + 8 * static_cast<std::size_t>(below(13)), kSetupRequest + 8 * static_cast<std::size_t>(below(17)),
        entry + 8 * static_cast<std::size_t>(below(4)), output + 8 * static_cast<std::size_t>(below(4))};
    devices_.store(words[static_cast<std::size_t>(below(4))], random_() >> below(64));
    head_ = devices_.load(kSegmentHead);
    output_head_ = devices_.load(kOutputHead);
    run_ = devices_.load(kRunRequest);
}

}  // namespace lockstep::testing
