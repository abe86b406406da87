// The device's side of the output ring: the changes of a frame's outputs, checked when the frame begins.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim_fpga/firmware/device/abilities.hpp"
#include "sim_fpga/firmware/device/words.hpp"

namespace lockstep::firmware {

enum class ChangeKind : std::uint8_t { Digital, Analog, Compare };

/// An entry of the output ring.
struct OutputChange {
    std::int64_t at = 0;  // ticks after the start of the frame's body or tail
    ChangeKind kind = ChangeKind::Digital;
    std::uint8_t channel = 0;  // of an analog output
    std::uint64_t value = 0;
    std::uint64_t slope = 0;

    std::uint16_t levels() const { return static_cast<std::uint16_t>(registers::kOutputRingValueLevels.of(value)); }
    std::uint16_t mask() const { return static_cast<std::uint16_t>(registers::kOutputRingValueMask.of(value)); }
    std::int32_t every() const {
        return static_cast<std::int32_t>(static_cast<std::uint32_t>(registers::kOutputRingSlopeEvery.of(slope)));
    }
    std::uint32_t pulses() const { return static_cast<std::uint32_t>(registers::kOutputRingSlopePulses.of(slope)); }
};

/// No more changes wait in the ring than it has entries.
template <std::size_t Most>
struct ChangeList {
    static constexpr std::size_t kRoom = Most < kOutputRoom ? Most : kOutputRoom;
    OutputChange changes[kRoom]{};
    std::size_t size = 0;
};

struct OutputTrack {
    ChangeList<kMostBodyChanges> body;
    ChangeList<kMostTailChanges> tail;
    void clear() { body.size = tail.size = 0; }
};

class OutputQueue {
public:
    OutputQueue(const Words& words, const Abilities& abilities) : words_(words), abilities_(abilities) {}

    /// Entries taken since power-up.
    std::uint64_t taken() const { return tail_; }
    /// Takes the changes of this frame into `track`, and drops those of frames before it and of other runs. Returns
    /// false if one of them is malformed: `track` is empty then.
    [[nodiscard]] bool take(std::uint64_t run, std::uint64_t frame, OutputTrack& track);
    void drop_run(std::uint64_t run);

private:
    bool is_empty() const;
    std::uint64_t oldest_tag() const;
    bool read(OutputTrack& track) const;
    bool is_possible(const OutputChange& change) const;

    const Words& words_;
    const Abilities& abilities_;
    std::uint64_t tail_ = 0;
};

}  // namespace lockstep::firmware
