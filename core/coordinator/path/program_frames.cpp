#include "core/coordinator/path/program_frames.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep {

ProgramFrames::ProgramFrames(const MachineConfig& machine, std::shared_ptr<const Program> program, const Leg& leg)
    : program_(std::move(program)),
      limits_(frame_limits_of(machine)),
      leg_(leg),
      tick_s_(static_cast<double>(machine.tick_ns) * 1e-9),
      next_(leg.first),
      planner_(path_setup_of(machine)) {
    for (const AxisConfig& axis : machine.axes) { steps_per_mm_.push_back(axis.steps_per_mm); }
    for (const std::string& name : program_->axes) {
        const auto place = std::ranges::find(machine.axes, name, &AxisConfig::name);
        axes_.push_back(static_cast<std::size_t>(place - machine.axes.begin()));
    }
    std::vector<Position> from;
    for (const std::int64_t count : leg.from) {
        from.push_back(Position::steps(count));
        at_.append(static_cast<double>(count));
    }
    planner_.begin(from);
}

void ProgramFrames::resume(const PathPlace& place, std::span<const Position> at, const Overrides& overrides) {
    planner_.resume(place, at);
    if (overrides != planner_.overrides()) { (void)planner_.turn(overrides); }
}

void ProgramFrames::read() {
    for (std::size_t n = 0; n < kBlocksAtOnce && !is_finished_; ++n) {
        if (planner_.waiting() >= kReserve && planner_.is_ready()) { return; }
        read_block();
    }
}

void ProgramFrames::read_block() {
    if (next_ == leg_.end) {
        planner_.finish();
        is_finished_ = true;
        return;
    }
    const std::uint32_t number = next_++;
    const Block& block = program_->blocks[number];
    if (const auto* dwell = std::get_if<Dwell>(&block.action)) {
        const Ticks ticks = ticks_of(*dwell, tick_s_);
        if (ticks > Ticks{}) { planner_.rest(ticks, number); }
        return;
    }
    const auto& move = std::get<LinearMove>(block.action);
    for (std::size_t i = 0; i < axes_.size(); ++i) {  // what is rounded to the end of the travel is not beyond it
        const AxisLimits& axis = limits_[axes_[i]];
        at_[axes_[i]] = std::clamp(move.target_mm[i] * steps_per_mm_[axes_[i]], static_cast<double>(axis.min_steps),
                                   static_cast<double>(axis.max_steps));
    }
    planner_.line_to_steps(at_, {.feed_mm_per_tick = move.rapid ? 0 : move.feed_mm_s * tick_s_}, number);
}

bool ProgramFrames::turn(const Overrides& overrides) {
    TurnResult result = planner_.turn(overrides);
    while (result == TurnResult::LacksPath && !is_finished_) {
        for (std::size_t n = 0; n < kBlocksAtOnce && !is_finished_; ++n) { read_block(); }
        result = planner_.turn(overrides);
    }
    return result == TurnResult::Taken;
}

double ProgramFrames::seconds_from(const PathPlace& place) const { return leg_.times->seconds_from(place); }

}  // namespace lockstep
