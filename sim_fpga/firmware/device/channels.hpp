// The inputs and outputs of a device.
//
// Outputs change in step with the frames that are run, at once by a direct request, and to a safe state when a run is
// cut or the host is silent. While the host is silent, they change in no other way.
#pragma once

#include <cstdint>

#include "sim_fpga/firmware/device/abilities.hpp"
#include "sim_fpga/firmware/device/events.hpp"
#include "sim_fpga/firmware/device/host_watch.hpp"
#include "sim_fpga/firmware/device/inputs.hpp"
#include "sim_fpga/firmware/device/output_queue.hpp"
#include "sim_fpga/firmware/device/outputs.hpp"
#include "sim_fpga/firmware/device/port.hpp"
#include "sim_fpga/firmware/device/setup.hpp"
#include "sim_fpga/firmware/device/words.hpp"

namespace lockstep::firmware {

/// Where the motor is after a tick.
struct Moment {
    std::int64_t now = 0;
    std::int64_t count = 0;
    std::uint64_t phase = 0;
};

class Channels {
public:
    /// All must outlive this object.
    Channels(Words& words, const Abilities& abilities, Port& port);
    Channels(const Channels&) = delete;
    Channels& operator=(const Channels&) = delete;

    void set(const Setup& setup, const Moment& at);
    /// Reads the host's words that take effect at once.
    void take_orders(const Moment& at);

    /// Returns false if outputs of the frame are malformed. None of them changes then.
    bool begin_frame(std::uint64_t run, std::uint64_t frame, const Moment& at);
    void begin_tail(const Moment& at);
    /// is_cut: in any other way than by its last frame.
    void end_run(bool is_cut, const Moment& at);
    void drop_run(std::uint64_t run) { queue_.drop_run(run); }

    /// The next tick at which something is due.
    Due next();
    /// Does what is due at this moment, with these levels of the input pins.
    void tend(std::uint32_t pins, const Moment& at);
    /// How many steps of a block from this count on arrive at the next place. 0: it is not among the first so many.
    std::uint32_t steps_to_place(const StepBlock& block, std::uint32_t steps, std::int64_t count) const {
        return outputs_.has_places() ? outputs_.steps_to_place(block, steps, count) : 0;
    }
    /// A step has arrived at the next place. The end of its pulse is due.
    void arrive(std::int64_t tick, std::int64_t count) {
        is_next_known_ = false;
        outputs_.arrive(tick, count);
    }

    const Setup& setup() const { return setup_; }
    /// The inputs that are closed; input n is bit n.
    std::uint32_t closed() const { return inputs_.closed(); }
    bool is_host_silent() const { return host_.is_silent(); }
    const Outputs& outputs() const { return outputs_; }
    void publish(std::int64_t now);

private:
    void note_inputs(std::uint32_t changed, const Moment& at);
    void change_directly(const Moment& at);
    std::uint64_t analog_word(std::size_t first, std::int64_t now) const;

    static constexpr std::size_t kAnalogInWord = 4;

    Words& words_;
    const Abilities& abilities_;
    Setup setup_;
    Events events_;
    OutputQueue queue_;
    Outputs outputs_;
    Inputs inputs_;
    HostWatch host_;
    OutputTrack track_;  // of the frame in progress
    std::uint64_t request_ = 0;
    std::uint32_t pins_ = 0;      // as they were looked at last
    Due next_;                    // if it is known
    bool is_next_known_ = false;  // nothing has changed since it was found
};

}  // namespace lockstep::firmware
