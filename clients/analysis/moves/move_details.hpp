// Peaks, times and lateness of the first moves of a job.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "clients/analysis/asked/asked_path.hpp"
#include "clients/analysis/measure/lateness.hpp"
#include "clients/analysis/measure/measured_step.hpp"
#include "clients/analysis/moves/move_log.hpp"

namespace lockstep::analysis {

class MoveDetails {
public:
    MoveDetails() = default;
    /// Of the moves of which the path has details.
    explicit MoveDetails(const AskedPath& asked);

    /// Whether the move is one of the first.
    bool has(std::size_t move) const { return move < moves_.size(); }
    /// Rates of some steps of a motor in this move.
    void add_rates(std::size_t move, MotorIndex motor, std::span<const StepRates> rates);
    /// The newest step of the lead motor.
    void set_last(std::size_t move, Tick last) { moves_[move].last = last; }
    void add_late(std::size_t move, const EquallyLate& steps);
    /// `first`: the first step of the lead motor; nullopt if there is none.
    void write(const AskedMove& asked, std::size_t move, std::optional<Tick> first, MoveLog& log) const;

private:
    struct Move {
        Tick last;  // of the lead motor's steps
        TickHistogram late;
        Ticks earliest;  // smallest lateness of its steps
        Ticks latest;
    };
    std::size_t motors_ = 0;
    std::vector<Move> moves_;
    std::vector<StepRates> peaks_;  // by move and motor
};

}  // namespace lockstep::analysis
