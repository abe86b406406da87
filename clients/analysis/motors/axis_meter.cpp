#include "clients/analysis/motors/axis_meter.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep::analysis {
namespace {

/// The lengths of a run's pieces as commanded, in machine time.
std::vector<Ticks> lengths_of(const Run& run) {
    if (!run.commanded_ticks.empty()) { return run.commanded_ticks; }
    std::vector<Ticks> lengths;
    for (const Piece& piece : run.pieces) { lengths.push_back(piece.ticks); }
    return lengths;
}

/// The place of a motor in its piece: it has covered a share of it.
Position at_share(Position from, const Piece& piece, double share) {
    const double ticks = share * static_cast<double>(piece.ticks.value);
    const double covered = ticks * static_cast<double>(piece.velocity.raw) +
                           ticks * (ticks + 1) / 2 * static_cast<double>(piece.acceleration.raw);
    return from + Displacement{static_cast<Int128>(covered)};
}

}  // namespace

AxisMeter::AxisMeter(const MachineConfig& machine, std::shared_ptr<const Kinematics> kinematics, bool keeps_curves)
    : kinematics_(std::move(kinematics)), keeps_curves_(keeps_curves) {
    for (const AxisConfig& axis : machine.axes) {
        axes_.push_back({.figures = {.name = axis.name}, .mm_per_step = 1 / axis.steps_per_mm});
    }
}

void AxisMeter::take(MotorIndex motor, Run run) {
    const std::size_t motors = kinematics_->motors().size();
    if (run.epoch == 0 || motor >= motors) { return; }
    const auto frame = frames_.try_emplace({run.commanded_start(), run.epoch}, motors).first;
    frame->second[motor] = std::make_shared<const Run>(std::move(run));
    const auto is_whole = [](const Frame& runs) { return std::ranges::find(runs, nullptr) == runs.end(); };
    while (!frames_.empty() && (frames_.size() > kFramesWaiting || is_whole(frames_.begin()->second))) {
        measure(frames_.begin()->second);
        frames_.erase(frames_.begin());
    }
}

/// The pieces of all motors begin and end together.
void AxisMeter::measure(const Frame& frame) {
    const auto is_alike = [&](const auto& run) {
        return run != nullptr && run->pieces.size() >= lengths_of(*run).size() &&
               lengths_of(*run) == lengths_of(*frame.front());
    };
    if (frame.front() == nullptr || !std::ranges::all_of(frame, is_alike)) { return; }
    std::vector<Position> first;
    for (const auto& run : frame) { first.push_back(run->from); }
    std::vector<Position> middle = first;
    std::vector<Position> last = first;
    Tick begin = frame.front()->commanded_start();
    const std::vector<Ticks> lengths = lengths_of(*frame.front());
    for (std::size_t i = 0; i < lengths.size(); ++i) {
        for (std::size_t m = 0; m < frame.size(); ++m) {
            const Piece& piece = frame[m]->pieces[i];
            middle[m] = at_share(first[m], piece, 0.5);
            last[m] = first[m] + piece.covered();
        }
        for (const AxisIndex a : axis_indices(axes_.size())) {
            note(axes_[a], {begin, lengths[i], kinematics_->axis_steps(a, first), kinematics_->axis_steps(a, middle),
                            kinematics_->axis_steps(a, last)});
        }
        begin += lengths[i];
        first = last;
    }
}

/// The axis's place is a quadratic of time through the three places, or as good as that.
void AxisMeter::note(Axis& axis, const PieceOfAxis& piece) const {
    const auto ticks = static_cast<double>(piece.ticks.value);
    if (ticks <= 0) { return; }
    const double first = piece.first * axis.mm_per_step;
    const double middle = piece.middle * axis.mm_per_step;
    const double last = piece.last * axis.mm_per_step;
    const double speed_first = (4 * middle - 3 * first - last) / ticks;
    const double speed_last = (3 * last - 4 * middle + first) / ticks;
    const double acceleration = 4 * (first - 2 * middle + last) / (ticks * ticks);
    AxisFigures& figures = axis.figures;
    if (!std::exchange(axis.is_known, true)) { figures.start_mm = first; }
    figures.end_mm = last;
    figures.peak_mm_per_tick = std::max({figures.peak_mm_per_tick, std::abs(speed_first), std::abs(speed_last)});
    figures.peak_mm_per_tick2 = std::max(figures.peak_mm_per_tick2, std::abs(acceleration));
    if (!keeps_curves_) { return; }
    const Tick end = piece.begin + piece.ticks;
    for (const auto& [at, place, speed] : {std::tuple{piece.begin, first, speed_first}, {end, last, speed_last}}) {
        axis.position.add({at, place});
        axis.speed.add({at, speed});
        axis.acceleration.add({at, acceleration});
    }
}

/// Without the rounding of the map.
double AxisMeter::rounded(double mm) {
    constexpr double kPerMm = 1e9;
    return std::round(mm * kPerMm) / kPerMm + 0.0;
}

std::vector<AxisFigures> AxisMeter::finish() {
    for (const auto& [key, frame] : frames_) { measure(frame); }
    frames_.clear();
    std::vector<AxisFigures> all;
    for (Axis& axis : axes_) {
        if (!axis.is_known) { continue; }
        axis.figures.start_mm = rounded(axis.figures.start_mm);
        axis.figures.end_mm = rounded(axis.figures.end_mm);
        axis.figures.position = axis.position.samples();
        axis.figures.speed = axis.speed.samples();
        axis.figures.acceleration = axis.acceleration.samples();
        all.push_back(std::move(axis.figures));
    }
    return all;
}

}  // namespace lockstep::analysis
