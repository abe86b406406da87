// The coordinator's side of lease, arm, veto, for one epoch: makes frames in time, repeats what is not yet held, and
// evaluates from the axes' states how the epoch ended.
#pragma once

#include <deque>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/coordinator/axes/axis_view.hpp"
#include "core/machine.hpp"
#include "core/motion/lookahead.hpp"
#include "core/protocol/messages.hpp"
#include "core/protocol/rules.hpp"

namespace lockstep {

/// Where an epoch came to rest.
struct EpochEnd {
    enum class Kind : std::uint8_t {
        Complete,      // the path is done
        Interrupted,   // all axes ran the same frames and rest on the path, where they should
        FramesDiffer,  // they did not all run the same frames
        Misplaced,     // one is not where its frames end
    };
    Kind kind = Kind::Complete;
    std::size_t axis = 0;  // Misplaced, FramesDiffer: which
    FrameNumber ran = 0;
    std::size_t move = 0;             // Interrupted: the path's move it rests in
    Displacement along;               // and how far along that
    std::vector<Position> positions;  // exactly
};

class EpochRunner {
public:
    explicit EpochRunner(const MachineConfig& machine);

    /// Starts as soon as the send-ahead allows. `at` is where each axis rests, exactly.
    void begin(Epoch epoch, Path path, std::vector<Position> at, Slot now);

    /// Returns the frames to send in this slot: new frames that are due, until an axis vetoes one, and frames that an
    /// axis lacks. The caller fills in their term.
    std::vector<Frame> send(Slot now, std::span<const AxisView> axes);

    /// From the next frame that is not made yet, or as soon after it as the path leaves a way and planning has time.
    /// Of several asked for between two frames the last one counts.
    void turn(const Overrides& overrides) { turned_ = overrides; }
    /// Set by `send` where it has planned again: the overrides that hold behind frame `behind`.
    struct Turn {
        FrameNumber behind = 0;
        Overrides overrides;
    };
    std::optional<Turn> take_turn() { return std::exchange(taken_, std::nullopt); }

    /// No more frames; the lowest frame that no axis can have armed yet is vetoed, by the state published in slot
    /// `next`.
    void stop(Slot next);

    /// Nothing while an axis may still move. Axes that are not present are left out.
    std::optional<EpochEnd> evaluate(Slot now, std::span<const AxisView> axes) const;

    /// All that was sent is long over, with its tails, and still the result is open: not even a device that was
    /// silent for as long as it may be, nor word of it that came as late, explains that. Only slots in which frames
    /// were asked for count: while this process stalls, it receives nothing.
    bool is_overdue() const { return slots_over_ > 2 * rules::silence_slots(machine_.timing) + rules::kHopSlots; }

    /// Where the machine rests behind this frame and those made after it.
    std::vector<FrameRest> rests_from(FrameNumber frame) const;

    const Path& path() const { return path_; }
    Tick start() const { return start_; }
    Epoch epoch() const { return epoch_; }
    FrameNumber sent() const { return sent_; }
    /// The lowest of the coordinator's own and those received: each receiver repeats a veto.
    std::optional<FrameNumber> veto() const { return rules::merge(veto_, received_veto_); }
    bool was_late() const { return late_; }

private:
    struct Ending {
        std::size_t move = 0;
        Displacement along;
        std::vector<Position> positions;
        bool complete = false;
    };
    static constexpr std::size_t kPlannedAtOnce = 500;  // moves: a few milliseconds
    static constexpr std::size_t kEndingsKept = 64;     // far more frames than can be in flight

    Frame make_frame();
    Ending fill_tail(Frame& frame, Ticks end) const;
    void try_turn(Slot now);

    MachineConfig machine_;
    std::vector<AxisLimits> limits_;
    Ticks slot_;
    Epoch epoch_ = 0;
    Path path_;
    Tick start_;
    Ticks made_;           // of the path, in frames so far
    Tick rests_;           // by when the machine does, whichever of the frames made so far is the last one run
    Slot slots_over_ = 0;  // in which frames were asked for since
    std::vector<Position> at_;
    FrameNumber sent_ = 0;
    std::optional<Overrides> turned_;          // to be planned with yet
    std::optional<FrameNumber> tried_behind_;  // the last frame behind which that was tried
    std::optional<Turn> taken_;
    bool ended_ = false;  // no more frames will be made
    bool late_ = false;
    std::optional<FrameNumber> veto_;           // the coordinator's own
    std::optional<FrameNumber> received_veto_;  // the lowest of the axes'
    std::deque<Frame> in_flight_;               // not begun yet
    std::deque<Ending> endings_;                // how the epoch ends if this frame is the last run; the newest is sent_
};

}  // namespace lockstep
