// The words by which a device in Verilog is compared with the simulated device, and the plant of both.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "sim_fpga/plant.hpp"
#include "sim_fpga/registers.hpp"

namespace lockstep::rtl {

using NamedWord = std::pair<const char*, std::size_t>;
inline constexpr std::array<NamedWord, 9> kWordsOfEachTick{{{"TICK", registers::kTick},
                                                            {"STATUS", registers::kStatus},
                                                            {"COUNT", registers::kCount},
                                                            {"PHASE", registers::kPhase},
                                                            {"VELOCITY", registers::kVelocity},
                                                            {"RUN", registers::kRun},
                                                            {"FRAME", registers::kFrame},
                                                            {"OUTPUTS", registers::kOutputs},
                                                            {"ANALOG_LOWER", registers::kAnalogLower}}};
inline constexpr std::array<NamedWord, 13> kOtherWords{{{"TRIGGER_COUNT", registers::kTriggerCount},
                                                        {"CAPTURE_HEAD", registers::kCaptureHead},
                                                        {"CAPTURE_LOST", registers::kCaptureLost},
                                                        {"CAPTURE_SUM", registers::kCaptureSum},
                                                        {"CAPTURE_SUMS", registers::kCaptureSums},
                                                        {"SETUP", registers::kSetup},
                                                        {"INPUTS", registers::kInputs},
                                                        {"EVENT_HEAD", registers::kEventHead},
                                                        {"EVENT_LOST", registers::kEventLost},
                                                        {"ENCODER", registers::kEncoder},
                                                        {"SEGMENT_TAIL", registers::kSegmentTail},
                                                        {"OUTPUT_TAIL", registers::kOutputTail},
                                                        {"ANALOG_UPPER", registers::kAnalogUpper}}};

/// A plant whose switches are far away.
inline Plant far_plant() {
    MotorConfig motor;
    motor.steps_per_mm = 100;
    motor.position_min_mm = -1e9;
    motor.position_max_mm = 1e9;
    motor.homing.switch_position_mm = -1e9;
    motor.homing.toward_min = true;
    return Plant(motor, 1000);
}

}  // namespace lockstep::rtl
