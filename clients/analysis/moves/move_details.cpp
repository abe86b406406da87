#include "clients/analysis/moves/move_details.hpp"

#include <algorithm>
#include <array>

#include "clients/analysis/vector/clones.hpp"
#include "clients/analysis/vector/lanes.hpp"

namespace lockstep::analysis {
namespace {

LOCKSTEP_VECTOR_CLONES
StepRates peak_of(std::span<const StepRates> rates) {
    constexpr std::size_t kTogether = 8;  // rates in FloatLanes, by turns of speed and acceleration
    static_assert(sizeof(FloatLanes) == kTogether * sizeof(StepRates));
    FloatLanes most{};
    for (; rates.size() >= kTogether; rates = rates.subspan(kTogether)) {
        FloatLanes of;
        load(of, rates.data());
        most = of > most ? of : most;
    }
    std::array<StepRates, kTogether> together;
    store(most, together.data());
    StepRates peak;
    const auto note = [&](const StepRates& at) {
        peak.steps_per_tick = std::max(peak.steps_per_tick, at.steps_per_tick);
        peak.steps_per_tick2 = std::max(peak.steps_per_tick2, at.steps_per_tick2);
    };
    std::ranges::for_each(together, note);
    std::ranges::for_each(rates, note);
    return peak;
}

}  // namespace

MoveDetails::MoveDetails(const AskedPath& asked) : motors_(asked.motors()) {
    while (asked.details(moves_.size()) != nullptr) { moves_.emplace_back(); }
    peaks_.resize(moves_.size() * motors_);
}

void MoveDetails::add_rates(std::size_t move, MotorIndex motor, std::span<const StepRates> rates) {
    StepRates& peak = peaks_[move * motors_ + motor];
    const StepRates of = rates.size() == 1 ? rates.front() : peak_of(rates);
    peak.steps_per_tick = std::max(peak.steps_per_tick, of.steps_per_tick);
    peak.steps_per_tick2 = std::max(peak.steps_per_tick2, of.steps_per_tick2);
}

void MoveDetails::add_late(std::size_t move, const EquallyLate& steps) {
    Move& of = moves_[move];
    of.earliest = of.late.empty() ? steps.late : std::min(of.earliest, steps.late);
    of.latest = of.late.empty() ? steps.late : std::max(of.latest, steps.late);
    of.late.add(steps.late, std::ssize(steps.steps));
}

void MoveDetails::write(const AskedMove& asked, std::size_t move, std::optional<Tick> first, MoveLog& log) const {
    const Move& made = moves_[move];
    log.length_mm = asked.length_mm;
    log.planned = asked.planned;
    log.late = made.late;
    log.skew = made.latest - made.earliest;
    if (first) {
        log.first = first;
        log.made = made.last - *first + asked.planned - asked.stepping;
    }
    for (MotorIndex motor{0}; motor < motors_; ++motor) {
        log.motors[motor].peak_steps_per_tick = peaks_[move * motors_ + motor].steps_per_tick;
        log.motors[motor].peak_steps_per_tick2 = peaks_[move * motors_ + motor].steps_per_tick2;
    }
}

}  // namespace lockstep::analysis
