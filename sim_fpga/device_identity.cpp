#include "sim_fpga/device_identity.hpp"

namespace lockstep {

using namespace registers;

void DeviceIdentity::store(const DeviceAbilities& abilities) {
    for (const std::size_t word :
         {kMagic, kSequence, kRunRequest, kTrigger, kArmed, kVeto, kStop, kSegmentHead, kCaptureTail, kOutputHead,
          kEventTail, kBeat, kEnable, kDirectRequest, kSetupRequest}) {
        window_.store(word, 0);
    }
    window_.store(kVersion, kVersionValue);
    window_.store(kMapChecksum, kMapChecksumValue);
    window_.store(kTickNs, tick_ns_);
    window_.store(kPowerUp, power_up_);
    window_.store(kSegmentEntries, abilities.segment_entries);
    window_.store(kCaptureEntries, abilities.capture_entries);
    window_.store(kLeastStepTicks, static_cast<std::uint64_t>(abilities.least_step.value));
    window_.store(kTimeUnitPs, abilities.time_unit_ps);
    window_.store(kLongestTime, abilities.longest_time);
    window_.store(kLongestPwmPeriod, abilities.longest_pwm_period);
    window_.store(kLongestPieceTicks, static_cast<std::uint64_t>(abilities.longest_piece.value));
    window_.store(kLeadTicks, static_cast<std::uint64_t>(abilities.lead.value));
    window_.store(kPinTicks, static_cast<std::uint64_t>(abilities.behind.value));
    window_.store(kInputChannels, abilities.inputs);
    window_.store(kDigitalChannels, abilities.digital_outputs);
    window_.store(kAnalogChannels, abilities.analog_outputs);
    window_.store(kOutputEntries, abilities.output_entries);
    window_.store(kEventEntries, abilities.event_entries);
    window_.store(kFeatures, (abilities.has_encoder ? kFeaturesEncoder : 0) |
                                 (abilities.can_enable ? kFeaturesEnable : 0) |
                                 (abilities.can_compare ? kFeaturesCompare : 0) |
                                 (abilities.frames_stay ? kFeaturesFramesStay : 0));
}

bool DeviceIdentity::is_intact() const {
    return window_.load(kMagic) == kMagicValue && window_.load(kVersion) == kVersionValue &&
           window_.load(kMapChecksum) == kMapChecksumValue && window_.load(kTickNs) == tick_ns_ &&
           window_.load(kPowerUp) == power_up_;
}

}  // namespace lockstep
