// The state of a session as the reports of report.proto: the one source of both JSON and text.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "clients/session/session.hpp"
#include "core/faults.hpp"
#include "core/program_devices.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep {

/// `axis`: name of the axis if the fault belongs to one axis, otherwise empty.
proto::FaultReport fault_report(FaultCode fault, const std::string& axis);
/// Of a motor of the machine.
proto::FaultReport motor_fault(FaultCode fault, const Kinematics& kinematics, MotorIndex motor);

/// The machine's fault; nullopt if there is none.
std::optional<proto::FaultReport> fault_of(const MachineState& state, const MachineConfig& machine);

/// "axis X: ", "motor Y2: ", or empty if the fault belongs to no motor.
std::string fault_place(const proto::FaultReport& fault);
/// "axis X: limit-hit (103): a limit switch closed", then the remedy on its own line; within 80 columns.
std::string fault_text(const proto::FaultReport& fault);

/// The devices that programs have switched; nullopt if all are off and no tool is known.
std::optional<proto::DevicesReport> devices_report(const ProgramDevices& devices);

/// Of an axis or a motor.
struct Scale {
    std::string name;
    double steps_per_mm = 1;
    double ticks_per_s = 1;
};
/// Its newest state, without whether it is present; if it was never received, only its name.
proto::AxisStatus axis_status(const Scale& scale, const AxisState* state, double steps_per_tick);

/// The way back to the place of the pause, by the newest states. Nullopt if there is no pause, the axes are there, or
/// an axis was never received.
std::optional<Program> way_back(const Session& session);
/// Nullopt without a pause.
std::optional<proto::PauseReport> pause_report(const Session& session);

proto::StatusReport status_report(const Session& session);

/// Adds the directory of incident files of this host's flight recorders; reads the directory.
void add_incidents(const MachineSetup& machine, proto::StatusReport& report);

/// The position of an axis, in mm and in steps.
proto::FinalPosition place_of(const AxisConfig& axis, std::int64_t count);

/// The name of an axis or a motor, with its unit if that is not mm.
std::string label_of(const proto::AxisStatus& row);
/// The rows of the axes, then those of the motors that are not an axis's own.
std::vector<const proto::AxisStatus*> rows_of(const proto::StatusReport& status);
/// The rows of what processes serve: the axes with a motor of their own, then the motors.
std::vector<const proto::AxisStatus*> process_rows(const proto::StatusReport& status);
/// "axis X", "motor Y2"
std::string process_label(const proto::AxisStatus& row);

}  // namespace lockstep
