// The source of an epoch's frames: a path from one rest to the next rest that the program asks for.
#pragma once

#include <expected>
#include <memory>
#include <span>
#include <vector>

#include "core/coordinator/path/event_queue.hpp"
#include "core/motion/path.hpp"
#include "core/overrides.hpp"
#include "core/path/frame_planner.hpp"
#include "core/program_blocks.hpp"

namespace lockstep {

/// The place of the program at which a path ends.
struct LegEnd {
    enum class Kind : std::uint8_t { Program, Settle, Pause, Probe };
    Kind kind = Kind::Program;
    std::uint32_t block = 0;  // the first block after the path; at the program's end there is no such block
    AxisCounts to;            // of all axes of the machine, whole steps
    Pause pause;              // of Kind::Pause
    Probe probe;              // of Kind::Probe: ends the next leg
};

class FrameSource {
public:
    virtual ~FrameSource() = default;
    /// A copy that continues in the same way.
    virtual std::unique_ptr<FrameSource> clone() const = 0;

    /// Begins another path in the same memory, from block `first` of a program on. `axes`: the machine's axes that the
    /// program names. `from`: where all axes stand. Returns false and changes nothing if the source cannot do that.
    virtual bool begin(const std::shared_ptr<const ProgramBlocks>& /*program*/, std::span<const AxisIndex> /*axes*/,
                       std::uint32_t /*first*/, const AxisCounts& /*from*/) {
        return false;
    }
    /// The axes rest at `at`: where the path begins, or where one of the last frames rests. The next frame continues
    /// from there.
    virtual void resume(const PathPlace& place, std::span<const Position> at, const Overrides& overrides) = 0;
    /// Reads a bounded amount of the program. Called once a slot. Returns false if nothing could be read.
    virtual bool read() { return false; }
    /// Reads until the next frame can be made, no frame is left, or no more blocks are known.
    void read_ahead() {
        while (!is_ready() && !is_done() && read()) {}
    }
    /// It cannot make a frame before more of the program is known.
    virtual bool lacks_blocks() { return false; }
    /// The next frame can be made.
    virtual bool is_ready() = 0;
    /// The path has no further frame.
    virtual bool is_done() const = 0;
    /// Makes the next frame, valid until the next call. Returns null if it is not ready.
    virtual std::expected<const PathFrame*, PathStuck> next() = 0;
    /// The moves that begin in the last frame. Only valid directly after next().
    virtual const std::vector<MoveBegin>& begins() const = 0;
    /// Sets new overrides, from the next frame on or soon after. Returns false if they cannot begin there, and the old
    /// ones still hold.
    virtual bool set_overrides(const Overrides& overrides) = 0;
    /// The end of a path that is done.
    virtual LegEnd end() const = 0;
    /// The events with places in the last frame. Only valid directly after next().
    virtual std::span<const FrameEvent> events() const { return {}; }
    /// Those with places in its tail.
    virtual std::span<const FrameEvent> tail_events() const { return {}; }
    /// Events before this block have happened. Call it before any block is read.
    virtual void begin_events_from(std::uint32_t /*block*/) {}
    /// The events before a block that were read and not forgotten.
    virtual std::span<const PathEvent> events_before(std::uint32_t /*block*/) const { return {}; }
    /// The line of a block in which one of the last frames is.
    virtual std::optional<std::int32_t> line_of(std::uint32_t block) const = 0;
    /// An estimate of how long the program takes from a place of the path on, without overrides.
    virtual double seconds_from(const PathPlace& place) const = 0;
};

/// Owns a source; a copy has a source of its own.
class OwnedSource {
public:
    OwnedSource() = default;
    OwnedSource(std::unique_ptr<FrameSource> source) : source_(std::move(source)) {}
    OwnedSource(const OwnedSource& other) : source_(other.source_ ? other.source_->clone() : nullptr) {}
    OwnedSource(OwnedSource&&) = default;
    OwnedSource& operator=(OwnedSource other) {
        source_ = std::move(other.source_);
        return *this;
    }
    ~OwnedSource() = default;

    explicit operator bool() const { return source_ != nullptr; }
    FrameSource* operator->() const { return source_.get(); }
    FrameSource& operator*() const { return *source_; }

private:
    std::unique_ptr<FrameSource> source_;
};

}  // namespace lockstep
