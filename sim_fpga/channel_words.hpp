// Setup, changes of outputs and events as words of the register map: written by one side, read by the other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/hardware/device_abilities.hpp"
#include "core/hardware/device_setup.hpp"
#include "core/hardware/output_change.hpp"
#include "core/protocol/messages.hpp"
#include "sim_fpga/register_window.hpp"

namespace lockstep {

/// The setup with its times in the device's units. Times that are too long for a word become the longest.
void store_setup(RegisterWindow& window, const DeviceSetup& setup, std::uint64_t time_unit_ps);
DeviceSetup load_setup(const RegisterWindow& window, std::uint64_t time_unit_ps);

/// A place in the output ring: the frame to which an entry belongs.
struct OutputPlace {
    std::uint64_t run = 0;
    FrameNumber frame = 0;
    bool is_tail = false;
};
/// at: the byte at which the entry begins.
void store_change(RegisterWindow& window, std::size_t at, const OutputPlace& place, const OutputChange& change);
/// Whether the entry belongs to this run. Only low bits are compared.
bool is_of_run(const RegisterWindow& window, std::size_t at, std::uint64_t run);
/// By how many frames the entry's is after this one; below 0: before it. Only low bits are compared.
std::int32_t frames_after(const RegisterWindow& window, std::size_t at, FrameNumber frame);
bool is_of_tail(const RegisterWindow& window, std::size_t at);
/// Returns nullopt if the entry is of an unknown kind.
std::optional<OutputChange> load_change(const RegisterWindow& window, std::size_t at);

/// What the analog outputs show now.
void store_analog(RegisterWindow& window, const AnalogLevels& levels);
AnalogLevels load_analog(const RegisterWindow& window);

void store_event(RegisterWindow& window, std::size_t at, const ChannelEvent& event);
/// Returns nullopt if the entry is of an unknown kind.
std::optional<ChannelEvent> load_event(const RegisterWindow& window, std::size_t at);

}  // namespace lockstep
