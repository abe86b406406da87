// The inputs and outputs of a device.
//
// Outputs change in step with the frames that are run, at once by a direct request, and to a safe state when a run is
// cut or the host is silent. While the host is silent, they change in no other way.
#pragma once

#include <cstdint>
#include <optional>

#include "core/hardware/device_abilities.hpp"
#include "core/hardware/device_setup.hpp"
#include "core/protocol/messages.hpp"
#include "sim_fpga/event_ring.hpp"
#include "sim_fpga/host_watch.hpp"
#include "sim_fpga/input_filter.hpp"
#include "sim_fpga/output_ring.hpp"
#include "sim_fpga/output_unit.hpp"
#include "sim_fpga/register_window.hpp"

namespace lockstep {

/// Where the axis is after a tick.
struct DevicePlace {
    Tick now;
    std::int64_t count = 0;
    std::uint64_t phase = 0;
};

class Channels {
public:
    Channels(RegisterWindow window, const DeviceAbilities& abilities);
    Channels(const Channels&) = delete;  // its outputs point to its events
    Channels& operator=(const Channels&) = delete;

    void set(const DeviceSetup& setup, const DevicePlace& at);
    /// Reads the host's words that take effect at once.
    void take_orders(const DevicePlace& at);

    /// Returns false if outputs of the frame are malformed. None of them changes then.
    bool begin_frame(std::uint64_t run, FrameNumber frame, const DevicePlace& at);
    void begin_tail(const DevicePlace& at);
    /// is_cut: in any other way than by its last frame.
    void end_run(bool is_cut, const DevicePlace& at);
    void drop_run(std::uint64_t run) { ring_.drop_run(run); }

    /// The next tick at which something is due; nullopt if nothing is.
    std::optional<Tick> next() const;
    /// Does what is due at this place, with these levels of the input pins.
    void tend(std::uint32_t pins, const DevicePlace& at);
    /// A step that arrives at this count.
    void arrive(Tick tick, std::int64_t count) { outputs_.arrive(tick, count); }

    const DeviceSetup& setup() const { return setup_; }
    /// The inputs that are closed; input n is bit n.
    std::uint32_t closed() const { return inputs_.closed(); }
    bool is_host_silent() const { return host_.is_silent(); }
    const OutputUnit& outputs() const { return outputs_; }
    bool is_intact() const;
    /// in_motion: a frame is in progress.
    void publish(Tick now, bool in_motion);

private:
    void look(std::uint32_t pins, const DevicePlace& at);
    void note_inputs(std::uint32_t changed, const DevicePlace& at);
    void change_directly(const DevicePlace& at);

    RegisterWindow window_;
    DeviceAbilities abilities_;
    DeviceSetup setup_;
    EventRing events_;
    OutputRing ring_;
    OutputUnit outputs_;
    InputFilter inputs_;
    HostWatch host_;
    OutputTrack track_;  // of the frame in progress
    std::uint64_t request_ = 0;
};

}  // namespace lockstep
