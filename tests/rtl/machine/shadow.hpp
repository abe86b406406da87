// A device in Verilog that gets every word that a machine's host writes to its simulated device, at the same tick.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "Vaxis_of_machine.h"
#include "core/step/segment.hpp"
#include "sim_fpga/plant.hpp"
#include "sim_fpga/register_window.hpp"
#include "tests/rtl/axis/verilog_device.hpp"

namespace lockstep::rtl {

class Shadow {
public:
    /// window: the simulated device's. plant: as it is at `now`.
    Shadow(const RegisterWindow& window, const Plant& plant, Tick now)
        : window_(window), plant_(plant), now_(now), device_(now) {}

    /// Executes all ticks up to `until` with the words that the host had written before, then takes those that it has
    /// written since.
    void follow(Tick until) {
        while (now_ < until) { tick(); }
        take(registers::kSegmentRing, kEndOfSegments);
        take(kHostWords, kEndOfHostWords);
        take(kTables, kEndOfTables);
    }
    const std::vector<StepEdge>& steps() const { return steps_; }
    std::uint64_t load(std::size_t offset) { return device_.read(offset); }

private:
    static constexpr std::size_t kEndOfSegments =
        registers::kSegmentRing + std::size_t{2048} * registers::kSegmentRingEntryBytes;
    static constexpr std::size_t kHostWords = registers::kRunRequest;
    static constexpr std::size_t kEndOfHostWords = registers::kCompareTicks + 8;
    static constexpr std::size_t kTables = registers::kAnalogTable;
    static constexpr std::size_t kEndOfTables = registers::kInputTable + 32 * registers::kInputTableEntryBytes;

    void tick() {
        now_ += Ticks{1};
        (void)device_.tick(plant_.pins(), [this](int direction) {
            steps_.push_back({now_, static_cast<std::int8_t>(direction)});
            plant_.step(steps_.back());
            return plant_.pins();
        });
    }
    /// The words that differ from those that the device has.
    void take(std::size_t begin, std::size_t end) {
        for (std::size_t offset = begin; offset < end; offset += sizeof(std::uint64_t)) {
            const std::uint64_t word = window_.load(offset);
            std::uint64_t& own = words_[offset / sizeof(std::uint64_t)];
            if (own == word) { continue; }
            own = word;
            device_.write(offset, word);
        }
    }

    RegisterWindow window_;
    Plant plant_;
    Tick now_;
    VerilogDevice<Vaxis_of_machine> device_;
    std::vector<std::uint64_t> words_ = std::vector<std::uint64_t>(registers::kWindowBytes / sizeof(std::uint64_t));
    std::vector<StepEdge> steps_;
};

}  // namespace lockstep::rtl
