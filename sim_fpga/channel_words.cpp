#include "sim_fpga/channel_words.hpp"

#include <algorithm>

#include "core/step/executable.hpp"
#include "sim_fpga/register_ring.hpp"

namespace lockstep {

using namespace registers;

namespace {

constexpr RegisterRing kInputRows(kInputTable, kMostInputs, kInputTableEntryBytes);
constexpr RegisterRing kAnalogRows(kAnalogTable, kMostAnalogOutputs, kAnalogTableEntryBytes);
constexpr std::uint64_t kPicosecondsPerNs = 1000;

std::uint64_t signed_word(std::int64_t value) { return static_cast<std::uint64_t>(value); }

/// Rounds up: a pulse is never shorter than asked for.
std::uint64_t in_units(std::int64_t ns, std::uint64_t unit_ps) {
    return (signed_word(ns) * kPicosecondsPerNs + unit_ps - 1) / unit_ps;
}
std::int64_t in_ns(std::uint64_t units, std::uint64_t unit_ps) {
    return static_cast<std::int64_t>(units * unit_ps / kPicosecondsPerNs);
}

/// LEVELS and MASK are at the same place in all words that have them.
std::uint64_t word_of(const SetDigital& digital) {
    return kOutputRingValueLevels.word(digital.levels) | kOutputRingValueMask.word(digital.mask);
}
SetDigital digital_in(std::uint64_t word) {
    return {.levels = static_cast<std::uint16_t>(kOutputRingValueLevels.of(word)),
            .mask = static_cast<std::uint16_t>(kOutputRingValueMask.of(word))};
}

std::uint64_t word_of(const SafeOutputs& safe) {
    return word_of(safe.digital) | kOutputsAtCutAnalogOff.word(safe.analog_off);
}
SafeOutputs safe_in(std::uint64_t word) {
    return {.digital = digital_in(word), .analog_off = static_cast<std::uint8_t>(kOutputsAtCutAnalogOff.of(word))};
}

enum class ChangeKind : std::uint8_t { Digital, Analog, Compare };

struct ChangeWords {
    ChangeKind kind = ChangeKind::Digital;
    std::uint8_t channel = 0;
    std::uint64_t value = 0;
    std::uint64_t slope = 0;
};
/// The word and the field in it that show an analog output.
constexpr std::size_t kAnalogInWord = 4;
constexpr std::size_t analog_word(std::size_t channel) { return kAnalogLower + channel / kAnalogInWord * 8; }
constexpr RegisterField analog_field(std::size_t channel) {
    return {static_cast<unsigned>(channel % kAnalogInWord) * 16, 16};
}
static_assert(analog_word(7) == kAnalogUpper && analog_field(7).low == kAnalogUpperOutput7.low);

ChangeWords words_of(const SetDigital& change) { return {ChangeKind::Digital, 0, word_of(change), 0}; }
ChangeWords words_of(const RampAnalog& change) {
    return {ChangeKind::Analog, change.channel, signed_word(change.value), signed_word(change.slope)};
}
ChangeWords words_of(const ComparePosition& change) {
    return {ChangeKind::Compare, 0, signed_word(change.next),
            kOutputRingSlopeEvery.word(signed_word(change.every)) | kOutputRingSlopePulses.word(change.pulses)};
}

}  // namespace

void store_setup(RegisterWindow& window, const DeviceSetup& setup, std::uint64_t unit_ps) {
    window.store(kStepWidth, in_units(setup.step_width_ns, unit_ps));
    window.store(kDirectionSetup, in_units(setup.direction_setup_ns, unit_ps));
    window.store(kDirectionHold, in_units(setup.direction_hold_ns, unit_ps));
    window.store(kEnableTicks, signed_word(setup.enable_wait.value));
    window.store(kInverted, (setup.step_inverted ? kInvertedStep : 0) |
                                (setup.direction_inverted ? kInvertedDirection : 0) |
                                (setup.enable_inverted ? kInvertedEnable : 0));
    window.store(kInputsInverted, setup.inputs_inverted);
    window.store(kLimitMinInputs, setup.limit_min);
    window.store(kLimitMaxInputs, setup.limit_max);
    window.store(kHomeInputs, setup.home);
    window.store(kStopInputs, setup.stop);
    window.store(kOutputsInverted, setup.outputs_inverted);
    window.store(kOutputsAtCut, word_of(setup.at_cut));
    window.store(kOutputsAtSilence,
                 word_of(setup.at_silence) | kOutputsAtSilenceDisable.word(setup.disable_at_silence ? 1 : 0));
    window.store(kSilenceTicks, signed_word(setup.silence.value));
    window.store(kCompareOutputs, setup.compare_outputs);
    window.store(kCompareTicks, signed_word(setup.compare_pulse.value));
    for (std::size_t n = 0; n < kMostInputs; ++n) {
        window.store(kInputRows.entry(n) + kInputTableDebounce, signed_word(setup.debounce[n].value));
    }
    for (std::size_t n = 0; n < kMostAnalogOutputs; ++n) {
        window.store(kAnalogRows.entry(n) + kAnalogTablePwmPeriod, in_units(setup.pwm_period_ns[n], unit_ps));
    }
}

DeviceSetup load_setup(const RegisterWindow& window, std::uint64_t unit_ps) {
    const auto ticks = [&](std::size_t word) {
        return Ticks{static_cast<std::int64_t>(std::min(window.load(word), signed_word(kMaxPieceTicks.value)))};
    };
    const auto inputs = [&](std::size_t word) { return static_cast<std::uint32_t>(window.load(word)); };
    const auto outputs = [&](std::size_t word) { return static_cast<std::uint16_t>(window.load(word)); };
    const auto inverted = [&](std::uint64_t bit) { return (window.load(kInverted) & bit) != 0; };
    DeviceSetup setup{.step_width_ns = in_ns(window.load(kStepWidth), unit_ps),
                      .direction_setup_ns = in_ns(window.load(kDirectionSetup), unit_ps),
                      .direction_hold_ns = in_ns(window.load(kDirectionHold), unit_ps),
                      .enable_wait = ticks(kEnableTicks),
                      .step_inverted = inverted(kInvertedStep),
                      .direction_inverted = inverted(kInvertedDirection),
                      .enable_inverted = inverted(kInvertedEnable),
                      .inputs_inverted = inputs(kInputsInverted),
                      .limit_min = inputs(kLimitMinInputs),
                      .limit_max = inputs(kLimitMaxInputs),
                      .home = inputs(kHomeInputs),
                      .stop = inputs(kStopInputs),
                      .debounce = {},
                      .outputs_inverted = outputs(kOutputsInverted),
                      .at_cut = safe_in(window.load(kOutputsAtCut)),
                      .at_silence = safe_in(window.load(kOutputsAtSilence)),
                      .disable_at_silence = kOutputsAtSilenceDisable.of(window.load(kOutputsAtSilence)) != 0,
                      .silence = ticks(kSilenceTicks),
                      .compare_outputs = outputs(kCompareOutputs),
                      .compare_pulse = ticks(kCompareTicks),
                      .pwm_period_ns = {}};
    for (std::size_t n = 0; n < kMostInputs; ++n) {
        setup.debounce[n] = ticks(kInputRows.entry(n) + kInputTableDebounce);
    }
    for (std::size_t n = 0; n < kMostAnalogOutputs; ++n) {
        setup.pwm_period_ns[n] = in_ns(window.load(kAnalogRows.entry(n) + kAnalogTablePwmPeriod), unit_ps);
    }
    return setup;
}

void store_change(RegisterWindow& window, std::size_t at, const OutputPlace& place, const OutputChange& change) {
    const ChangeWords words = std::visit([](const auto& one) { return words_of(one); }, change.what);
    window.store(at + kOutputRingTag, (place.is_tail ? kOutputRingTagTail : 0) |
                                          kOutputRingTagKind.word(static_cast<std::uint64_t>(words.kind)) |
                                          kOutputRingTagChannel.word(words.channel) |
                                          kOutputRingTagRun.word(place.run) | kOutputRingTagFrame.word(place.frame));
    window.store(at + kOutputRingAt, signed_word(change.at.value));
    window.store(at + kOutputRingValue, words.value);
    window.store(at + kOutputRingSlope, words.slope);
}

bool is_of_run(const RegisterWindow& window, std::size_t at, std::uint64_t run) {
    return kOutputRingTagRun.shows(window.load(at + kOutputRingTag), run);
}
std::int32_t frames_after(const RegisterWindow& window, std::size_t at, FrameNumber frame) {
    const std::uint64_t its = kOutputRingTagFrame.of(window.load(at + kOutputRingTag));
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(its - frame));
}
bool is_of_tail(const RegisterWindow& window, std::size_t at) {
    return (window.load(at + kOutputRingTag) & kOutputRingTagTail) != 0;
}

std::optional<OutputChange> load_change(const RegisterWindow& window, std::size_t at) {
    const std::uint64_t tag = window.load(at + kOutputRingTag);
    const std::uint64_t value = window.load(at + kOutputRingValue);
    const std::uint64_t slope = window.load(at + kOutputRingSlope);
    OutputChange change{.at = {static_cast<std::int64_t>(window.load(at + kOutputRingAt))}, .what = {}};
    switch (static_cast<ChangeKind>(kOutputRingTagKind.of(tag))) {
        case ChangeKind::Digital: change.what = digital_in(value); return change;
        case ChangeKind::Analog:
            change.what = RampAnalog{.channel = static_cast<std::uint8_t>(kOutputRingTagChannel.of(tag)),
                                     .value = static_cast<std::int64_t>(value),
                                     .slope = static_cast<std::int64_t>(slope)};
            return change;
        case ChangeKind::Compare:
            change.what = ComparePosition{
                .next = static_cast<std::int64_t>(value),
                .every = static_cast<std::int32_t>(static_cast<std::uint32_t>(kOutputRingSlopeEvery.of(slope))),
                .pulses = static_cast<std::uint32_t>(kOutputRingSlopePulses.of(slope))};
            return change;
    }
    return std::nullopt;
}

void store_analog(RegisterWindow& window, const AnalogLevels& levels) {
    for (std::size_t n = 0; n < levels.size(); n += kAnalogInWord) {
        std::uint64_t word = 0;
        for (std::size_t i = n; i < n + kAnalogInWord; ++i) { word |= analog_field(i).word(levels[i]); }
        window.store(analog_word(n), word);
    }
}

AnalogLevels load_analog(const RegisterWindow& window) {
    AnalogLevels levels;
    for (std::size_t n = 0; n < levels.size(); ++n) {
        levels[n] = static_cast<std::uint16_t>(analog_field(n).of(window.load(analog_word(n))));
    }
    return levels;
}

void store_event(RegisterWindow& window, std::size_t at, const ChannelEvent& event) {
    const std::uint64_t levels = event.kind == ChannelEvent::Kind::Input ? (event.closed ? 1 : 0) : event.levels;
    window.store(at + kEventRingTick, signed_word(event.tick.value));
    window.store(at + kEventRingWhat, kEventRingWhatKind.word(static_cast<std::uint64_t>(event.kind)) |
                                          kEventRingWhatChannel.word(event.channel) |
                                          kEventRingWhatLevels.word(levels));
    window.store(at + kEventRingValue, signed_word(event.value));
    window.store(at + kEventRingDetail, signed_word(event.detail));
}

std::optional<ChannelEvent> load_event(const RegisterWindow& window, std::size_t at) {
    const std::uint64_t what = window.load(at + kEventRingWhat);
    const std::uint64_t kind = kEventRingWhatKind.of(what);
    const std::uint64_t levels = kEventRingWhatLevels.of(what);
    if (kind > static_cast<std::uint64_t>(ChannelEvent::Kind::CompareEnds)) { return std::nullopt; }
    ChannelEvent event{.tick = {static_cast<std::int64_t>(window.load(at + kEventRingTick))},
                       .kind = static_cast<ChannelEvent::Kind>(kind),
                       .channel = static_cast<std::uint8_t>(kEventRingWhatChannel.of(what)),
                       .value = static_cast<std::int64_t>(window.load(at + kEventRingValue)),
                       .detail = static_cast<std::int64_t>(window.load(at + kEventRingDetail))};
    if (event.kind == ChannelEvent::Kind::Input) {
        event.closed = levels != 0;
    } else {
        event.levels = static_cast<std::uint16_t>(levels);
    }
    return event;
}

}  // namespace lockstep
