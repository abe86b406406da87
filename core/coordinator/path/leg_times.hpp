// About how long the moves of a leg take, for progress and time left: at their feed as far as the axes allow it, with a
// rise from rest and a fall to rest between two sharp corners. A pass of constant work for each block.
#pragma once

#include <span>
#include <vector>

#include "core/machine.hpp"
#include "core/path/axis_vector.hpp"
#include "core/path_place.hpp"
#include "core/program.hpp"

namespace lockstep {

class LegTimes {
public:
    /// `first`: the leg's first block.
    LegTimes(const MachineConfig& machine, std::uint32_t first);

    // Block by block.
    /// `way_mm`: of each axis. `feed_mm_s` 0: as fast as the axes allow.
    void add_move(std::span<const double> way_mm, double feed_mm_s);
    void add_rest(double seconds);
    void finish();

    double seconds() const { return blocks_.empty() ? 0 : blocks_.back().end_s; }
    /// A place's way is along its block, in mm.
    double seconds_from(const PathPlace& place) const;

private:
    struct BlockTime {
        float end_s = 0;  // since the leg's begin; until finish(): how long it takes
        float length_mm = 0;
    };

    void close_run();

    std::vector<double> max_velocity_mm_s_;
    std::vector<double> acceleration_mm_s2_;
    std::uint32_t first_;
    std::vector<BlockTime> blocks_;
    // Since the last sharp corner:
    std::size_t run_ = 0;  // its first block
    double run_s_ = 0;     // at the speeds asked for
    double run_mm_ = 0;
    double run_acceleration_ = 0;
    std::vector<double> direction_;
};

}  // namespace lockstep
