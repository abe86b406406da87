// Delivers one axis's steps in order, from batches that may be missing, repeated, late or of a restarted process.
//
// Missing steps are reported, never interpolated. The report names the number of missing batches, the ticks around
// them, and the change of position across them. A batch that cannot belong to the stream is reported too: the record
// contradicts itself there.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/clock/clock_view.hpp"
#include "core/step/segment.hpp"
#include "core/units.hpp"
#include "services/record/reading/content_memory.hpp"
#include "services/record/reading/step_edges.hpp"

namespace lockstep::analysis {

/// Every step of an axis since the previous batch. Ticks rise strictly; directions are +1 or -1. All ticks of a stream
/// are either device time, as recorded, or machine time (log_step.hpp).
struct StepBatch {
    std::int64_t incarnation = 0;  // of the axis's process; each process counts its batches from 0
    std::int64_t sequence = 0;     // without gaps
    std::int64_t position_before_steps = 0;
    StepEdges steps;
    Ticks ahead_first{};  // machine time minus device time, at the first step
    Ticks ahead_last{};
    Ticks clock_error{};     // of machine time, in both directions
    StepEdges device_steps;  // the same in device time; empty if `steps` has it

    /// Device time of a step. Intervals are exact only by the device's clock; across batches, machine time also
    /// contains the change of its estimate.
    Tick device_tick(std::size_t step) const { return (device_steps.empty() ? steps : device_steps).tick(step); }

    /// Converts device time to machine time. The batch must have steps.
    ClockStretch machine_time() const;
};

/// A gap between steps that do not follow each other.
struct Break {
    enum class Kind : std::uint8_t {
        Missing,  // batches are missing from the log
        Restart,  // the axis's process restarted
        Jump,     // no batch is missing, but the position changes, after zeroing or after lost step times
    };
    Kind kind = Kind::Missing;
    std::optional<Tick> from;          // the last step before; nullopt at the log's beginning
    std::optional<Tick> to;            // the first step after; nullopt at the log's end
    std::int64_t missing_batches = 0;  // from their numbers
    std::int64_t position_change = 0;  // steps, after minus before; missing steps in both directions cancel
};

/// A batch that is left out because it contradicts the others.
struct Contradiction {
    enum class Kind : std::uint8_t {
        NotAfter,      // its first step is not after the last step of the batch before it
        OtherContent,  // an earlier batch has its number, but other content
        EndedProcess,  // it is of a process that another process of the axis has replaced, and no repeat
    };
    Kind kind = Kind::NotAfter;
    std::int64_t sequence = 0;
    std::int64_t steps = 0;           // in the batch
    std::optional<Tick> first;        // its first step
    std::optional<Tick> last_before;  // NotAfter: the last step before it
};

/// "message 12 with 80 steps has a step at tick 5, but the message before it ends at tick 9"
std::string sentence(const Contradiction& what);

/// Receives a stream's steps in order.
class StepListener {
public:
    virtual ~StepListener() = default;
    virtual void on_batch(const StepBatch& batch) = 0;
    /// A break between the previous batch and the next one.
    virtual void on_break(const Break& /*what*/) {}
    virtual void on_contradiction(const Contradiction& /*what*/) {}
};

struct StreamCounts {
    std::int64_t batches = 0;        // delivered
    std::int64_t steps = 0;          // in these batches
    std::int64_t duplicates = 0;     // repeated batches, left out
    std::int64_t late = 0;           // batches that came after they were given up as missing, left out
    std::int64_t contradictory = 0;  // left out, and reported
};

class StepStream {
public:
    static constexpr std::int64_t kFirstSequence = 0;
    /// How many batches wait for a missing one before it is given up, since datagrams may overtake each other.
    static constexpr std::size_t kPatience = 16;

    explicit StepStream(std::vector<StepListener*> listeners) : listeners_(std::move(listeners)) {}

    void listen(StepListener& listener) { listeners_.push_back(&listener); }
    void take(StepBatch batch);
    /// Delivers the waiting batches. Call once, at the end of the log.
    void finish();

    const StreamCounts& counts() const { return counts_; }
    /// The position after the last delivered step; nullopt before the first batch.
    std::optional<std::int64_t> position_steps() const { return position_; }
    std::optional<Tick> last_tick() const { return last_tick_; }

private:
    struct Numbers {
        std::int64_t from = 0;
        std::int64_t end = 0;  // exclusive
    };

    bool has_passed(const StepBatch& batch);
    void note_repeat(const StepBatch& batch);
    void contradict(Contradiction::Kind kind, const StepBatch& batch);
    void begin_incarnation(std::int64_t incarnation);
    void deliver_in_order(bool wait);
    void deliver(const StepBatch& batch);
    void note_missing(std::int64_t sequence);
    void note_position(std::int64_t position_before);
    Break& open_break(Break::Kind kind);
    void close_break(std::optional<Tick> to);

    std::vector<StepListener*> listeners_;
    StreamCounts counts_;
    std::optional<std::int64_t> incarnation_;
    std::set<std::int64_t> past_incarnations_;
    std::int64_t expected_ = kFirstSequence;
    std::deque<Numbers> given_up_;               // of this incarnation, the newest few
    std::map<std::int64_t, StepBatch> waiting_;  // by sequence
    ContentMemory contents_;
    std::optional<Break> break_;  // open until the next step closes it
    std::optional<std::int64_t> position_;
    std::optional<Tick> last_tick_;
};

}  // namespace lockstep::analysis
