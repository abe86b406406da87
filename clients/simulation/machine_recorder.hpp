// Records a machine in virtual time as its processes record themselves live: every step, run, position,
// job and event.
#pragma once

#include <memory>
#include <vector>

#include "services/record/axis_recorder.hpp"
#include "services/record/job_recorder.hpp"
#include "services/virtual/virtual_machine.hpp"

namespace lockstep {

class MachineRecorder final : public VirtualObserver {
public:
    /// Observes the machine from its power-up on. The machine and the sink must outlive the recorder.
    MachineRecorder(VirtualMachine& vm, RecordSink& sink);

    void on_step(MotorIndex motor, StepEdge step) override;
    void on_channel(MotorIndex motor, const ChannelEvent& event) override;
    void on_axis(MotorIndex motor, Tick now, const AxisOutputs& out, AxisNode& node) override;
    void on_part(std::size_t process, Tick now, const ProgramPart& part) override;
    void on_coordinator(std::size_t process, Tick now, const CoordinatorOutputs& out) override;
    void on_fault(Tick now, const VirtualFault& fault, bool begins) override;

    /// Writes buffered messages. Call it at the end.
    void finish();

    std::int64_t steps() const { return steps_; }

private:
    void note_owner(MachineState state);

    MachineSetup machine_;
    RecordSink& sink_;
    std::vector<std::unique_ptr<AxisRecorder>> axes_;  // created when the axis's process publishes its identity
    std::vector<std::vector<StepEdge>> found_;         // steps found by a process before it published its identity
    std::vector<std::vector<ChannelEvent>> noted_;     // likewise, changes of inputs and outputs
    Identity owner_ = 0;                               // the coordinator of the recorded jobs
    std::size_t owning_ = 0;                           // its process
    std::unique_ptr<JobRecorder> jobs_;                // its recorder
    Tick now_;
    std::int64_t steps_ = 0;
};

}  // namespace lockstep
