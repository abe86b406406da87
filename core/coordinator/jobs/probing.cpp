#include "core/coordinator/jobs/probing.hpp"

#include "core/check.hpp"
#include "core/kinematics/motors.hpp"

namespace lockstep {
namespace {

MotorPositions positions_of(const LoopView& loop) {
    MotorPositions at;
    for (std::size_t i = 0; i < loop.axes.size(); ++i) { at.append(loop.axes.state(i)->position); }
    return at;
}

}  // namespace

std::optional<Probed> Probing::end_at_begin(const PathTask& task, const TouchInput& input, bool moves,
                                            const LoopView& loop) {
    rested_.reset();
    const auto& state = loop.axes.state(input.motor);
    const bool touches = state && input.is_touched(state->inputs);
    if (!touches && moves) { return std::nullopt; }
    note(task, touches ? std::optional(loop.now) : std::nullopt, positions_of(loop), loop);
    if (!task.probe->must_touch) { return Probed{}; }
    return Probed{touches ? FaultCode::ProbeTouchedEarly : FaultCode::ProbeNotTouched};
}

bool Probing::may_touch_yet(const PathTask& task, const EpochEnd& end, const EpochRunner& runner,
                            const LoopView& loop) {
    const bool rests_on_path = end.kind == EpochEnd::Kind::Complete || end.kind == EpochEnd::Kind::Interrupted;
    const auto& input = runner.touch();
    if (!input || !rests_on_path || runner.touched(loop.axes.views())) { return false; }
    rested_ = rested_.value_or(loop.slot);
    const InputConfig* const config = touch_input_numbered(loop.machine.inputs, task.probe->input);
    return loop.axes.is_present(input->motor, loop.slot) &&
           loop.axes.state(input->motor)->stamp < *rested_ + slots_until_known(*config, loop.machine);
}

std::optional<Probed> Probing::end(const PathTask& task, const EpochEnd& end, const EpochRunner& runner,
                                   const LoopView& loop) {
    const auto touched = runner.touched(loop.axes.views());
    rested_.reset();
    if (!touched && end.kind != EpochEnd::Kind::Complete) { return std::nullopt; }
    note(task, touched, touched ? runner.positions_at(*touched, end.ran) : end.positions, loop);
    if (!task.probe->must_touch) { return Probed{}; }
    if (!touched) { return Probed{FaultCode::ProbeNotTouched}; }
    const bool is_early = !runner.made().start() || *touched <= *runner.made().start();
    return Probed{is_early ? FaultCode::ProbeTouchedEarly : FaultCode::None};
}

void Probing::note(const PathTask& task, std::optional<Tick> touched, const MotorPositions& at, const LoopView& loop) {
    result_ = ProbeResult{task.job.number, touched.has_value(), touched.value_or(Tick{}), {}};
    for (std::size_t i = 0; i < loop.machine.axes.size(); ++i) {
        result_->places_mm.append(loop.kinematics.axis_steps(i, at) / loop.machine.axes[i].steps_per_mm);
    }
}

}  // namespace lockstep
