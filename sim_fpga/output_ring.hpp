// The device's side of the output ring: the changes of a frame's outputs, checked when the frame begins.
#pragma once

#include <cstdint>
#include <utility>

#include "core/hardware/device_abilities.hpp"
#include "core/hardware/output_change.hpp"
#include "core/protocol/messages.hpp"
#include "sim_fpga/register_ring.hpp"
#include "sim_fpga/register_window.hpp"

namespace lockstep {

class OutputRing {
public:
    OutputRing(RegisterWindow window, const DeviceAbilities& abilities)
        : window_(std::move(window)),
          abilities_(abilities),
          ring_(registers::kOutputRing, abilities.output_entries, registers::kOutputRingEntryBytes) {}

    /// Entries taken since power-up.
    std::uint64_t taken() const { return tail_; }
    /// Where the entries of the frame begin that was taken last.
    std::uint64_t begin_of_frame() const { return first_; }
    /// Takes the changes of this frame into `track`, and drops those of frames before it and of other runs. Returns
    /// false if one of them is malformed: `track` is empty then.
    [[nodiscard]] bool take(std::uint64_t run, FrameNumber frame, OutputTrack& track);
    /// Drops the entries of this run.
    void drop_run(std::uint64_t run);

private:
    bool is_empty() const;
    std::size_t oldest() const { return ring_.entry(tail_); }
    bool read(OutputTrack& track) const;
    bool is_possible(const OutputChange& change) const;

    RegisterWindow window_;
    DeviceAbilities abilities_;
    RegisterRing ring_;
    std::uint64_t tail_ = 0;
    std::uint64_t first_ = 0;
};

}  // namespace lockstep
