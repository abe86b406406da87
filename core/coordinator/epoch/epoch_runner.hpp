// The coordinator's side of lease, arm, veto, for one epoch: makes frames in time, repeats frames that are not held
// yet, and evaluates from the axes' states how the epoch ended.
#pragma once

#include <optional>
#include <span>
#include <utility>

#include "core/coordinator/axes/axis_view.hpp"
#include "core/coordinator/epoch/due_events.hpp"
#include "core/coordinator/epoch/epoch_end.hpp"
#include "core/coordinator/epoch/frame_history.hpp"
#include "core/coordinator/epoch/frames_in_flight.hpp"
#include "core/coordinator/epoch/made_frames.hpp"
#include "core/coordinator/epoch/wanted_overrides.hpp"
#include "core/coordinator/path/frame_source.hpp"
#include "core/coordinator/path/output_planner.hpp"
#include "core/machine.hpp"
#include "core/protocol/messages.hpp"
#include "core/protocol/rules.hpp"
#include "core/reused_vector.hpp"

namespace lockstep {

/// The state of spindle, coolant and outputs by the events before a block of the program.
struct SwitchedBy {
    ProgramDevices devices;
    std::uint32_t block = 0;
};

/// The input of an epoch that touched first.
struct FirstTouch {
    Tick tick;
    TouchInput input;
};

class EpochRunner {
public:
    explicit EpochRunner(const MachineConfig& machine);

    /// Sets what the epochs to come run.
    void load(OwnedSource source) { source_ = std::move(source); }
    /// The epoch starts when its first frame can be made, as soon as the send-ahead allows. `at` is where each axis
    /// rests, exactly. `touch`: the epoch also ends at a touch of these inputs.
    void begin(Epoch epoch, const PathPlace& place, const MotorPositions& at, const Overrides& overrides,
               const SwitchedBy& switched, const TouchInputs& touch = {});

    /// Returns the frames to send in this slot: new frames that are due, until an axis vetoes one, and frames that an
    /// axis lacks. The frames are valid until the next call. The caller fills in their term.
    const ReusedVector<Frame>& send(Slot now, std::span<const AxisView> axes);

    /// The change to other overrides.
    WantedOverrides& overrides() { return overrides_; }

    /// Makes no more frames. Vetoes the lowest frame that no axis can have armed yet, by the state published in slot
    /// `next`.
    void stop(Slot next);

    /// Returns nullopt while an axis may still move. Axes that are not present are left out.
    std::optional<EpochEnd> evaluate(Slot now, std::span<const AxisView> axes) const;

    /// Which input of the epoch touched first, and when, by what the axes report so far.
    std::optional<FirstTouch> first_touch(std::span<const AxisView> axes) const;
    const TouchInputs& touch() const { return touch_; }
    /// Where the motors were at this tick, in an epoch with a touch of which frame `ran` was the last one run.
    MotorPositions positions_at(Tick tick, FrameNumber ran) const { return history_.at(tick, ran); }

    /// All sent frames and their tails ended long ago, but the result is still open. Even a device that was silent as
    /// long as it may be, and a report that was equally late, do not explain that. Only slots with a call of `send`
    /// count, because this process receives nothing while it stalls.
    bool is_overdue() const { return slots_over_ > 2 * rules::silence_slots(timing_) + rules::kHopSlots; }

    /// Returns the events with places that the motion has reached by `now`, each once, in frames that an axis has
    /// begun. Valid until the next call.
    using Happened = DueEvents::Happened;
    std::span<const Happened> take_events(Tick now, std::span<const AxisView> axes);

    const OwnedSource& source() const { return source_; }
    /// Where on the program the epoch begins, and with which overrides.
    struct Begin {
        PathPlace place;
        Overrides overrides;
    };
    const Begin& begun() const { return begin_; }
    /// Its frames so far.
    const MadeFrames& made() const { return made_; }
    /// Why no more frames will be made; empty while frames are made.
    enum class Ending : std::uint8_t {
        Whole,         // the path's last frame was made
        Empty,         // the path has no frame
        Stopped,       // by this coordinator
        Vetoed,        // by an axis: no axis may run the vetoed frame or a later one
        Late,          // the next frame was not made in time
        LacksProgram,  // the same, because too little of the program was known when the frame was due
        Stuck,         // no frame keeps the limits
    };
    const std::optional<Ending>& ending() const { return ending_; }
    Epoch epoch() const { return epoch_; }
    /// The lowest veto of its frames.
    std::optional<FrameNumber> veto() const { return in_flight_.veto(); }

private:
    void end(Ending why) { ending_ = ending_.value_or(why); }
    void make_frames(Slot now);
    const Frame* make_frame();

    ProtocolTiming timing_;
    Ticks slot_;
    OwnedSource source_;
    SwitchedBy switched_;  // when the epoch began
    OutputPlanner outputs_;
    Epoch epoch_ = 0;
    Begin begin_;
    MadeFrames made_;
    FramesInFlight in_flight_;
    ReusedVector<Frame> to_send_;
    Slot slots_over_ = 0;  // slots since all frames and their tails ended, with a call of `send`
    WantedOverrides overrides_;
    std::optional<Ending> ending_;
    bool lacked_blocks_ = false;  // when the frame that is due was tried last
    DueEvents due_;
    TouchInputs touch_;
    FrameHistory history_;  // of an epoch with a touch
};

}  // namespace lockstep
