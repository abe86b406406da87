#include "sim_fpga/firmware/device/setup.hpp"

namespace lockstep::firmware {

using namespace registers;

namespace {

std::int64_t ticks_of(std::uint64_t word) {
    const auto most = static_cast<std::uint64_t>(kLongestPiece);
    return static_cast<std::int64_t>(word < most ? word : most);
}

std::uint64_t greater(std::uint64_t one, std::uint64_t other) { return one > other ? one : other; }

SafeOutputs safe_in(std::uint64_t word) {
    return {.levels = static_cast<std::uint16_t>(kOutputsAtCutLevels.of(word)),
            .mask = static_cast<std::uint16_t>(kOutputsAtCutMask.of(word)),
            .analog_off = static_cast<std::uint8_t>(kOutputsAtCutAnalogOff.of(word))};
}

/// Whether all of these are among so many channels.
bool are_there(std::uint64_t used, std::uint64_t channels) { return used >> channels == 0; }

void load_inputs(const Words& words, Setup& setup) {
    const auto inputs = [&](std::size_t word) { return static_cast<std::uint32_t>(words.load(word)); };
    setup.inputs_inverted = inputs(kInputsInverted);
    setup.limit_min = inputs(kLimitMinInputs);
    setup.limit_max = inputs(kLimitMaxInputs);
    setup.home = inputs(kHomeInputs);
    setup.stop = inputs(kStopInputs);
    for (std::size_t n = 0; n < kMostInputs; ++n) {
        const std::size_t at = kInputTable + n * kInputTableEntryBytes;
        setup.debounce[n] = ticks_of(words.load(at + kInputTableDebounce));
        setup.debounced |= setup.debounce[n] > 0 ? std::uint32_t{1} << n : 0;
    }
}

void load_outputs(const Words& words, Setup& setup) {
    setup.outputs_inverted = static_cast<std::uint16_t>(words.load(kOutputsInverted));
    setup.at_cut = safe_in(words.load(kOutputsAtCut));
    setup.at_silence = safe_in(words.load(kOutputsAtSilence));
    setup.is_disabled_at_silence = kOutputsAtSilenceDisable.of(words.load(kOutputsAtSilence)) != 0;
    setup.silence_ticks = ticks_of(words.load(kSilenceTicks));
    setup.compare_outputs = static_cast<std::uint16_t>(words.load(kCompareOutputs));
    setup.compare_ticks = ticks_of(words.load(kCompareTicks));
    for (std::size_t n = 0; n < kMostAnalog; ++n) {
        const std::uint64_t period = words.load(kAnalogTable + n * kAnalogTableEntryBytes + kAnalogTablePwmPeriod);
        setup.pwm_period[n] = period;
        setup.longest_pwm_period = greater(setup.longest_pwm_period, period);
        setup.pwm_channels |= static_cast<std::uint16_t>(period > 0 ? 1U << n : 0U);
    }
}

}  // namespace

Setup load_setup(const Words& words) {
    Setup setup;
    setup.step_width = words.load(kStepWidth);
    setup.direction_setup = words.load(kDirectionSetup);
    setup.direction_hold = words.load(kDirectionHold);
    setup.enable_ticks = ticks_of(words.load(kEnableTicks));
    setup.inverted = words.load(kInverted);
    load_inputs(words, setup);
    load_outputs(words, setup);
    return setup;
}

bool is_within(const Abilities& abilities, const Setup& setup) {
    const std::uint64_t longest_time = greater(setup.step_width, greater(setup.direction_setup, setup.direction_hold));
    const std::uint32_t inputs =
        setup.inputs_inverted | setup.limit_min | setup.limit_max | setup.home | setup.stop | setup.debounced;
    const auto digital = static_cast<std::uint16_t>(setup.outputs_inverted | setup.at_cut.mask | setup.at_silence.mask |
                                                    setup.compare_outputs);
    const auto analog =
        static_cast<std::uint16_t>(setup.at_cut.analog_off | setup.at_silence.analog_off | setup.pwm_channels);
    return are_there(inputs, abilities.inputs) && are_there(digital, abilities.digital_outputs) &&
           are_there(analog, abilities.analog_outputs) && (setup.compare_outputs == 0 || abilities.can_compare) &&
           longest_time <= abilities.longest_time && setup.longest_pwm_period <= abilities.longest_pwm_period;
}

}  // namespace lockstep::firmware
