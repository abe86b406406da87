// The coordinator's side of lease, arm, veto, for one epoch: makes frames in time, repeats frames that are not held
// yet, and evaluates from the axes' states how the epoch ended.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/coordinator/axes/axis_view.hpp"
#include "core/coordinator/path/frame_history.hpp"
#include "core/coordinator/path/frame_source.hpp"
#include "core/coordinator/path/output_planner.hpp"
#include "core/machine.hpp"
#include "core/path/sliding_vector.hpp"
#include "core/protocol/messages.hpp"
#include "core/protocol/rules.hpp"
#include "core/reused_queue.hpp"
#include "core/reused_vector.hpp"

namespace lockstep {

/// The place at which an epoch came to rest.
struct EpochEnd {
    enum class Kind : std::uint8_t {
        Complete,      // the path is done
        Interrupted,   // all axes ran the same frames and rest on the path, where they should
        FramesDiffer,  // the axes did not all run the same frames
        Misplaced,     // an axis is not where its frames end
    };
    Kind kind = Kind::Complete;
    std::size_t axis = 0;  // Misplaced, FramesDiffer: the axis concerned
    FrameNumber ran = 0;
    PathPlace place;           // on the program
    MotorPositions positions;  // the exact ones
    bool has_pulses = false;   // devices were told the places of the newest M69
};

/// The state of spindle, coolant and outputs by the events before a block of the program.
struct SwitchedBy {
    ProgramDevices devices;
    std::uint32_t block = 0;
};

class EpochRunner {
public:
    explicit EpochRunner(const MachineConfig& machine);

    /// Sets what the epochs to come run.
    void load(OwnedSource source) { source_ = std::move(source); }
    /// The epoch starts when its first frame can be made, as soon as the send-ahead allows. `at` is where each axis
    /// rests, exactly. `touch`: the epoch also ends at the touch of this input.
    void begin(Epoch epoch, const PathPlace& place, const MotorPositions& at, const Overrides& overrides,
               const SwitchedBy& switched, const std::optional<TouchInput>& touch = {});

    /// Returns the frames to send in this slot: new frames that are due, until an axis vetoes one, and frames that an
    /// axis lacks. The frames are valid until the next call. The caller fills in their term.
    const ReusedVector<Frame>& send(Slot now, std::span<const AxisView> axes);

    /// Reads as much of the program as the next frame takes, for callers that need not finish within a slot.
    void read_ahead() { source_->read_ahead(); }

    /// Changes the overrides from the next frame to be made, or as soon after it as the path allows. Of several changes
    /// between two frames the last one counts.
    void set_overrides(const Overrides& overrides) { wanted_ = overrides; }
    /// Set by `send` when it has planned again. The overrides hold after frame `behind`.
    struct OverrideChange {
        FrameNumber behind = 0;
        Overrides overrides;
    };
    std::optional<OverrideChange> take_override_change() { return std::exchange(taken_, std::nullopt); }

    /// Makes no more frames. Vetoes the lowest frame that no axis can have armed yet, by the state published in slot
    /// `next`.
    void stop(Slot next);

    /// Returns nullopt while an axis may still move. Axes that are not present are left out.
    std::optional<EpochEnd> evaluate(Slot now, std::span<const AxisView> axes) const;

    /// When the input of the epoch touched, if an axis reports it.
    std::optional<Tick> touched(std::span<const AxisView> axes) const;
    const std::optional<TouchInput>& touch() const { return touch_; }
    /// Where the motors were at this tick, in an epoch with a touch of which frame `ran` was the last one run.
    MotorPositions positions_at(Tick tick, FrameNumber ran) const { return history_.at(tick, ran); }

    /// All sent frames and their tails ended long ago, but the result is still open. Even a device that was silent as
    /// long as it may be, and a report that was equally late, do not explain that. Only slots with a call of `send`
    /// count, because this process receives nothing while it stalls.
    bool is_overdue() const { return slots_over_ > 2 * rules::silence_slots(timing_) + rules::kHopSlots; }

    /// Returns the events with places that the motion has reached by `now`, each once, in frames that an axis has
    /// begun. Their times are those of the motion. Valid until the next call.
    struct Happened {
        Tick tick;
        PathEvent event;
    };
    std::span<const Happened> take_events(Tick now, std::span<const AxisView> axes);

    /// Sets `rests` to where the machine rests after this frame and after each frame made later.
    void list_rests(FrameNumber frame, StaticVector<FrameRest, kMaxRests>& rests) const;

    const OwnedSource& source() const { return source_; }
    /// Where on the program the epoch begins, and with which overrides.
    struct Begin {
        PathPlace place;
        Overrides overrides;
    };
    const Begin& begun() const { return begin_; }
    /// The start of its first frame; empty while that frame cannot be made yet.
    const std::optional<Tick>& start() const { return start_; }
    /// The place on the program at `tick`, by the last frames made.
    PathPlace place_at(Tick tick) const;
    /// How long the first `frames` frames last.
    Ticks ticks_of(FrameNumber frames) const;
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
    FrameNumber sent() const { return sent_; }
    /// The lowest of the coordinator's own veto and those received, because each receiver repeats a veto.
    std::optional<FrameNumber> veto() const { return rules::merge(veto_, received_veto_); }

private:
    struct Made {                          // a frame; number 0: the epoch's begin
        Ticks end;                         // from the epoch's start
        std::array<PathPlace, 16> places;  // in equal parts of its time
        PathPlace rest;                    // where the machine rests if it is the last one run
        MotorPositions positions;
        bool complete = false;
        bool has_pulses = false;  // if the machine rests after it
    };
    static constexpr std::size_t kMadeKept = kMaxRests;

    void end(Ending why) { ending_ = ending_.value_or(why); }
    void start_when_ready(Slot now);
    FrameNumber receive(std::span<const AxisView> axes);
    void repeat_frames(Slot now, FrameNumber held_by_all);
    void make_frames(Slot now);
    const Frame* make_frame();
    void begin_outputs();
    void finish(const Frame& frame, const PathFrame& path);
    void try_overrides();
    const Made& made_frame(FrameNumber number) const { return made_[number - oldest()]; }
    FrameNumber oldest() const { return sent_ + 1 - made_.size(); }

    ProtocolTiming timing_;
    Ticks slot_;
    OwnedSource source_;
    SwitchedBy switched_;  // when the epoch began
    OutputPlanner outputs_;
    Epoch epoch_ = 0;
    Begin begin_;
    std::optional<Tick> start_;
    Ticks made_ticks_;     // duration of the frames made so far
    Tick rests_;           // by when the machine rests, for any of the frames made so far as the last one run
    Slot slots_over_ = 0;  // slots since then with a call of `send`
    MotorPositions at_;
    FrameNumber sent_ = 0;
    std::optional<Overrides> wanted_;          // not planned with yet
    std::optional<FrameNumber> tried_behind_;  // the last frame after which that was tried
    std::optional<OverrideChange> taken_;
    std::optional<Ending> ending_;
    bool lacked_blocks_ = false;                // when the frame that is due was tried last
    std::optional<FrameNumber> veto_;           // the coordinator's own
    std::optional<FrameNumber> received_veto_;  // the lowest of the axes'
    ReusedQueue<Frame> in_flight_;              // frames not begun yet
    ReusedVector<Frame> to_send_;
    struct Due {
        FrameNumber frame = 0;
        Happened event;
    };
    SlidingVector<Due> due_;  // events that have not happened
    std::vector<Happened> happened_;
    ReusedQueue<Made> made_;  // the last frames; the newest is sent_
    std::optional<TouchInput> touch_;
    FrameHistory history_;  // of an epoch with a touch
};

}  // namespace lockstep
