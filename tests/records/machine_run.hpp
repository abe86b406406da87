// A whole machine in virtual time that is recorded into memory, driven like a person drives it.
//
// A command that is not answered, or a phase that is not reached, throws std::runtime_error.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "clients/session/move_program.hpp"
#include "clients/simulation/machine_recorder.hpp"
#include "core/kinematics/motors.hpp"
#include "core/program.hpp"
#include "services/setup/machine_setup.hpp"
#include "services/virtual/virtual_machine.hpp"
#include "tests/records/record.hpp"

namespace lockstep::records {

/// A machine from deploy/examples.
MachineSetup example_machine(const std::string& name);
/// Axes X, Y and Z near their switches, so that homing is short. It has words for devices.
MachineSetup small_mill();
/// Axes X and Y of small_mill().
MachineSetup small_plotter();
/// small_plotter() with a laser at X, whose power follows the speed, and a valve at Y, output 1 of programs.
MachineSetup small_laser();
MachineSetup with_camera(MachineSetup machine);  // M69 P0: pulses at places of Y
/// The same axes, moved by two belts: motors X and Y turn by their sum and their difference. It homes in place. Z is
/// moved by a motor of its own.
MachineSetup small_core_xy();
/// Motors X and X2 move axis X of small_plotter() together.
MachineSetup small_gantry();
/// One axis of 1000 steps/mm that a clock of 10 kHz drives.
MachineSetup slow_axis_machine();
/// The machine as its file gives it, with the steps of axes that follow from those of their motors.
MachineSetup read_again(const MachineSetup& machine);
VirtualOptions options_of(const MachineSetup& machine);
/// Two boards whose clocks differ from the coordinator's.
VirtualOptions own_clocks(MachineSetup machine);

class MachineRun {
public:
    explicit MachineRun(const MachineSetup& machine) : MachineRun(options_of(machine)) {}
    explicit MachineRun(const VirtualOptions& options);

    VirtualMachine& vm() { return vm_; }
    std::size_t coordinator() const { return motor_count(vm_.machine()); }

    void home();
    /// Homes these axes only.
    void home(AxisSet axes);
    /// Runs a program of G-code from where the axes are to its end, through its pauses.
    void run(std::string_view gcode);
    void run(const Program& program);
    /// Runs a program that is sent in parts of so many blocks, each after the one before is nearly used up.
    void run_in_parts(std::string_view gcode, std::size_t blocks);
    /// Only begins the program.
    void begin(std::string_view gcode);
    void begin(const Program& program);
    /// A single move, without the program's pauses.
    void move(std::string_view gcode);
    void move(const MoveOptions& move);
    /// The axes move to a place, each on its own.
    void move_own(std::string_view gcode);
    void begin_own(std::string_view gcode);
    void jog(std::uint32_t axis, double speed_mm_s, std::int64_t ms);

    void wait_ms(std::int64_t ms);
    void reach(MachinePhase phase);
    void command(CommandKind kind, std::uint64_t program = 0, AxisSet axes = {});
    void set_overrides(const Overrides& overrides);
    void hold();
    void resume();
    /// Resumes a pause in which axes were jogged: they return.
    void return_and_resume();
    /// After a fault.
    void reset();
    /// Goes on until the machine rests without a job.
    void to_rest();
    /// Throws if the machine has a fault, or its last job has.
    void require_success(const std::string& what) const;
    /// The process ends now; a new one starts after `ms`.
    void restart(std::size_t process, std::int64_t ms);

    Program program_of(std::string_view gcode) const;
    /// Ends the recording.
    Record finish();

private:
    void begin_job(CommandKind kind);
    bool is(MachinePhase phase) const { return vm_.state() && vm_.state()->phase == phase; }
    void await(const std::function<bool()>& done, const std::string& what);
    Ticks slots(std::int64_t count) const { return vm_.machine().slot_ticks() * count; }
    std::vector<double> here_mm() const;

    MemorySink sink_;
    VirtualMachine vm_;
    MachineRecorder recorder_;
    std::uint64_t programs_ = 0;
    std::uint64_t jogs_ = 0;
};

}  // namespace lockstep::records
