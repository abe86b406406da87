// The device of one motor behind the register map's words, for a processor of 32 bits. It executes frames by itself.
//
// Its words equal those of the simulated device (sim_fpga/device.hpp, which states when frames run, run their tails and
// end) after every call of advance() with the same words of the host and the same pins.
#pragma once

#include <cstdint>

#include "sim_fpga/firmware/device/abilities.hpp"
#include "sim_fpga/firmware/device/capture.hpp"
#include "sim_fpga/firmware/device/channels.hpp"
#include "sim_fpga/firmware/device/engine.hpp"
#include "sim_fpga/firmware/device/port.hpp"
#include "sim_fpga/firmware/device/segment_queue.hpp"
#include "sim_fpga/firmware/device/words.hpp"

namespace lockstep::firmware {

class Device {
public:
    /// Powers up at rest after tick `now`. `port` must outlive this object.
    Device(Port& port, const Abilities& abilities, std::int64_t now);
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    Words& words() { return words_; }

    /// Takes the host's words, executes all ticks up to and including `until`, and publishes its state.
    void advance(std::int64_t until);
    /// The parts of advance(), for a board that executes ticks more often than it exchanges words with the host.
    void take_orders();
    /// Checks what the host has written: what takes long. It may run while ticks are executed.
    void prepare_orders();
    void execute(std::int64_t until);
    void publish();

    /// The board could not show ticks at their time. The motor runs nothing more.
    void lose_ticks() { has_lost_ticks_ = true; }

    std::int64_t now() const { return engine_.now(); }
    bool is_enabled() const { return enabled_.is_set; }
    const Channels& channels() const { return channels_; }

private:
    enum class Phase : std::uint8_t { AtRest, Waiting, Body, Tail };

    void store_abilities();
    void take_setup();
    void take_enable();
    void take_run();
    std::int64_t decide(std::int64_t until);
    std::int64_t decide_first_frame(std::int64_t until);
    void start(const FrameHeader& first);
    void next_piece();
    void end_body();
    void begin_body();
    void begin_tail();
    void finish(std::uint64_t reason);

    bool is_in_motion() const { return phase_ == Phase::Body || phase_ == Phase::Tail; }
    bool may_run(std::uint64_t frame) const;
    bool may_move() const;
    bool is_vetoed(std::uint64_t frame) const;
    bool is_stop_asked() const;
    bool joins(const FrameHeader& frame) const;
    bool rebase_to(Place from);
    bool runs_into_limit(int direction) const;
    bool is_triggered() const;
    bool is_closed(std::uint32_t inputs) const { return (channels_.closed() & inputs) != 0; }
    const Setup& setup() const { return channels_.setup(); }

    std::int64_t next_due(std::int64_t until);
    TakenSteps take_steps(const StepBlock& block);
    void tend();
    std::uint64_t reason_to_cease() const;
    Moment moment() const;
    std::uint64_t status_word() const;

    Port& port_;
    Abilities abilities_;
    Words words_;
    SegmentQueue segments_;
    Capture capture_;
    Channels channels_;
    Engine engine_;

    Phase phase_ = Phase::AtRest;
    LoadedFrame frame_;      // the one in progress
    std::size_t piece_ = 0;  // of frame_, the one in progress

    std::uint64_t run_ = 0;
    std::uint64_t trigger_ = 0;
    std::uint64_t run_bits_ = 0;  // the bits of STATUS that a new run clears
    std::int64_t count_ = 0;
    std::int64_t trigger_count_ = 0;
    std::uint32_t pins_ = 0;   // as the channels saw them last
    int stepped_ = 0;          // the direction of the last step since the inputs were looked at; 0: none
    bool into_limit_ = false;  // a pulse was suppressed at a limit switch

    Setup prepared_;
    bool is_prepared_possible_ = false;
    std::uint64_t setup_prepared_ = 0;  // its number
    std::uint64_t setup_taken_ = 0;     // its number
    std::uint64_t setup_refused_ = 0;   // the number of one that is beyond the abilities
    Due enabled_;                       // since when
    bool has_lost_ticks_ = false;
    std::uint64_t sequence_ = 0;
};

}  // namespace lockstep::firmware
