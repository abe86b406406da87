// Estimates how long the blocks of a program take, for progress and time left. It assumes their feed as far as the axes
// allow it, and between two sharp corners acceleration from rest and deceleration to rest. Constant work for each
// block, bounded memory.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/arc_path.hpp"
#include "core/machine.hpp"
#include "core/path_place.hpp"
#include "core/program.hpp"

namespace lockstep {

class BlockTimes {
public:
    explicit BlockTimes(const MachineConfig& machine);

    // Called block by block, in order.
    /// `way_mm`: the distance of each axis. Without a `feed_mm_s` it is as fast as the axes allow.
    void add_move(std::span<const double> way_mm, std::optional<double> feed_mm_s);
    /// `plane`: the machine's axes of the arc's plane. `way_mm`: the distance of each axis, from end to end.
    void add_arc(const ArcPath& arc, std::pair<std::size_t, std::size_t> plane, std::span<const double> way_mm,
                 std::optional<double> feed_mm_s);
    void add_dwell(double seconds);
    /// The machine comes to rest. Call it after the last block, too.
    void add_rest();

    double seconds() const { return marks_.empty() ? 0 : marks_.back().end_s; }
    /// The time from a place to the end. `along` of the place is in mm.
    double seconds_from(const PathPlace& place) const;

    /// With more blocks than this a mark stands for two, four, eight ... of them.
    static constexpr std::size_t kMostMarks = 1 << 16;

private:
    struct Mark {
        double end_s = 0;
        double length_mm = 0;  // length of its block, if it has only one
    };

    struct Way {
        double length_mm = 0;
        double speed_mm_s = 0;
        double acceleration_mm_s2 = 0;
    };
    void add_way(const Way& way, const std::vector<double>& begins, std::vector<double> ends);
    void add(double seconds, double length_mm);
    void halve();
    void close_run();

    std::vector<double> max_velocity_mm_s_;
    std::vector<double> acceleration_mm_s2_;
    std::vector<Mark> marks_;
    std::uint64_t blocks_ = 0;
    std::uint64_t stride_ = 1;  // blocks for each mark
    // Since the last sharp corner:
    std::size_t run_ = 0;  // the first mark since then
    double run_begin_s_ = 0;
    double run_s_ = 0;  // time at the speeds asked for
    double run_mm_ = 0;
    double run_acceleration_ = 0;
    std::vector<double> direction_;  // of length 1, at the end of the last move
};

}  // namespace lockstep
