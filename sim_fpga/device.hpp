// The simulated hardware of one axis, down to its registers. It executes frames by itself, exact to the tick.
//
// A run goes from rest to rest. The host begins one by a new number in RUN_REQUEST, which is taken at rest only. Then:
// - At the start tick of frame 1 its body runs, if ARMED >= 1 and VETO > 1. If it is vetoed until
//   then, the run ends at once. If it is found armed only after that tick, it is refused (BAD_SEGMENT).
// - At the end of frame k's body, the run is finished if k was the last. Else, if frame k+1 is loaded, ARMED >= k+1 and
//   VETO > k+1, its body runs: it must start at this tick and position, exactly. In every other case frame k's tail
//   runs and the run is finished; a frame k+1 that was armed but does not join, or is malformed, sets BAD_SEGMENT.
// - The first frame starts at the axis's position, or at rest_position(count): the same place, with its phase at rest.
// - Pulses cease at once, and the run is finished, at a closed limit switch (in its direction), at the requested home
//   level, while an input of STOP_INPUTS is closed, and on STOP.
// - No run begins before a setup was taken and the motor is enabled.
// - A device that has lost its ticks ends its run, and runs nothing more.
// The host's registers take effect at calls of advance: in real time, once in each round of the loop.
#pragma once

#include <cstdint>
#include <optional>

#include "core/hardware/device_abilities.hpp"
#include "core/step/engine.hpp"
#include "core/step/segment.hpp"
#include "sim_fpga/capture_ring.hpp"
#include "sim_fpga/channels.hpp"
#include "sim_fpga/device_identity.hpp"
#include "sim_fpga/motor_readiness.hpp"
#include "sim_fpga/plant.hpp"
#include "sim_fpga/register_window.hpp"
#include "sim_fpga/segment_ring.hpp"

namespace lockstep {

class SimulatedDevice {
public:
    /// Powers up at rest after tick `now`, and resets all registers. The window belongs to this device from then on; a
    /// driver attaches to a copy. tick_ns: the value of TICK_NS. power_up: the value of POWER_UP; different each time,
    /// if a host depends on it.
    SimulatedDevice(RegisterWindow window, Plant plant, std::int64_t tick_ns, Tick now, std::uint64_t power_up = 0,
                    const DeviceAbilities& abilities = {});

    /// Executes all ticks up to and including `until`, then publishes its state. At or before now(), it only reads the
    /// host's registers and acts on them.
    void advance(Tick until);

    /// The device could not execute ticks in time. A simulated one always can, so this is for tests.
    void lose_ticks() { has_lost_ticks_ = true; }

    /// Whether the registers are still those of this device, and the host's are valid: not if their memory was
    /// removed or overwritten. The only remedy then is to power up again.
    bool is_intact() const;

    Tick now() const { return engine_.now(); }
    const OutputUnit& outputs() const { return channels_.outputs(); }
    /// The first tick at which the motor may step, if no register and no input changes; at most `until`.
    Tick next_step(Tick until) const;
    /// A frame or a tail is in progress.
    bool in_motion() const { return phase_ == Phase::Body || phase_ == Phase::Tail; }
    const Plant& plant() const { return plant_; }
    /// For disturbances of the plant. The inputs are read again at the next call of advance.
    Plant& plant() { return plant_; }

private:
    enum class Phase : std::uint8_t { AtRest, Waiting, Body, Tail };

    void take_enable();
    void take_run();
    Tick decide(Tick until);
    Tick decide_first_frame(Tick until);
    void next_piece();
    void end_body();
    void begin_frame();
    void begin_tail();
    void finish(std::uint64_t reason);

    bool may_run(FrameNumber frame) const;
    bool rebase_to(Position from);

    bool on_step(StepEdge step);
    void tend();
    std::uint64_t reason_to_cease() const;
    DevicePlace place() const;

    std::uint64_t status_word() const;
    void publish();

    RegisterWindow window_;
    DeviceAbilities abilities_;
    DeviceIdentity identity_;
    MotorReadiness motor_;
    SegmentRing segments_;
    CaptureRing capture_;
    Channels channels_;
    Plant plant_;
    StepEngine engine_;

    Phase phase_ = Phase::AtRest;
    LoadedFrame frame_;  // the one in progress
    LoadedFrame next_;
    std::size_t piece_ = 0;  // of frame_, the one in progress

    std::uint64_t run_ = 0;
    std::uint64_t trigger_ = 0;
    std::uint64_t run_bits_ = 0;  // the bits of STATUS that a new run clears
    std::int64_t count_ = 0;
    std::int64_t trigger_count_ = 0;
    std::uint32_t pins_ = 0;   // of the plant, as they were at the last look
    int stepped_ = 0;          // the direction of a step after which pulses paused; 0: none
    bool into_limit_ = false;  // a pulse was suppressed at a limit switch

    bool has_lost_ticks_ = false;
    std::uint64_t sequence_ = 0;
};

}  // namespace lockstep
