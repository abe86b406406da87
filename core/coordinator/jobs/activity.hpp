// The machine's activity. At any time it is exactly one of these, each with the data that exists only during it.
#pragma once

#include <optional>
#include <variant>

#include "core/coordinator/homing/homing_sequence.hpp"
#include "core/coordinator/homing/skew_watch.hpp"
#include "core/coordinator/homing/touch_homing.hpp"
#include "core/coordinator/jobs/input_watch.hpp"
#include "core/coordinator/jobs/own_targets.hpp"
#include "core/coordinator/jobs/path_task.hpp"
#include "core/coordinator/jogs/jogs.hpp"
#include "core/coordinator/jogs/path_jog.hpp"
#include "core/coordinator/state/machine_phases.hpp"
#include "core/faults.hpp"

namespace lockstep {

/// The first fault since the last reset.
struct MachineFault {
    FaultCode code = FaultCode::None;
    MotorIndex motor;

    /// The motor of the fault, if it is of one.
    std::optional<MotorIndex> faulty_motor() const { return is_of_an_axis(code) ? std::optional(motor) : std::nullopt; }
};

namespace activity {

/// Another coordinator owns the machine, or it is not known yet which one does.
struct Standby {
    std::optional<Slot> interrupted;  // a client has asked another owner to hold or stop
};
/// Not all axes are present, follow this coordinator, have done their orders and rest.
struct Waiting {
    std::optional<MachineState> inherited;  // the newest state of the last owner, with a job to continue
};
struct Idle {};
/// A job between two legs of its program.
struct Paused {
    PathTask task;
    Pause why;
    std::optional<InputWatch> watch;  // it goes on by itself when an input is as wanted
};
/// A job within a leg. All axes rest on the path.
struct Holding {
    PathTask task;
    PathPlace place;
    MotorPositions positions;
};
struct InFault {
    MachineFault fault;
};

/// Axes move. They come to rest, and the job does not go on, once `intent` says so.
struct Motion {
    Intent intent = Intent::GoOn;
    MachineFault fault;  // Intent::Abort
};
/// Axes home, each by itself, or one after the other by touch.
struct Homing : Motion {
    MachineJob job;
    HomingSequence sequence;
    SkewWatch skew;
    MotorSet approaching;  // those that wait for each other at their switches before they home
    AxisSet by_touch;      // axes of the group in progress that are still to home by touch
    std::optional<TouchHoming> touch;
    bool has_assumed = false;  // all motors that were not homed assume places
    bool has_parked = false;   // all axes that home by touch, together
};
/// Axes move to their places, each by itself.
struct OwnMoves : Motion {
    MachineJob job;
    OwnTargets targets;
    std::optional<Paused> pause = {};  // the job that goes on, after these moves have made up lost steps
};
/// Clients jog axes.
struct Jogging : Motion {
    MachineJob job;
    Jogs jogs;
    std::optional<Paused> pause;  // the job in whose pause this takes place
};
/// Axes move together, in an epoch of frames.
struct OnPath : Motion {
    PathTask task;
    std::optional<Paused> pause;        // the job to whose place the axes return, or in whose pause they are jogged
    std::optional<PathJog> jog;         // the task is a jog
    std::optional<Homing> homing = {};  // the task is a move of an axis that homes by touch
};

}  // namespace activity

using Activity =
    std::variant<activity::Standby, activity::Waiting, activity::Idle, activity::Homing, activity::OwnMoves,
                 activity::Jogging, activity::OnPath, activity::Paused, activity::Holding, activity::InFault>;

/// Holds the activity. Every change names its event, and must be a row of kMachineTransitions.
class MachineActivity {
public:
    MachinePhase phase() const;
    /// The fault that the machine reports, at rest or while it comes to rest.
    MachineFault fault() const;
    bool has_fault() const { return fault().code != FaultCode::None; }
    /// A job is held or paused.
    bool is_held() const { return is<activity::Holding>() || is<activity::Paused>(); }
    bool is_jogging() const;
    bool in_motion() const;
    /// GoOn if nothing moves.
    Intent intent() const;

    template <typename Kind>
    bool is() const {
        return std::holds_alternative<Kind>(activity_);
    }
    template <typename Kind>
    Kind* as() {
        return std::get_if<Kind>(&activity_);
    }
    template <typename Kind>
    const Kind* as() const {
        return std::get_if<Kind>(&activity_);
    }
    /// The newest state of the last owner, if its job is to be continued; otherwise null.
    const MachineState* inherited() const;
    /// The innermost job, which may take place in the pause of another; or null.
    const MachineJob* job() const;
    MachineJob* job();
    /// A job is in motion, held, or inherited by a takeover.
    bool has_job() const { return job() != nullptr || inherited() != nullptr; }
    /// The job in whose pause job() takes place, or null.
    const activity::Paused* pause() const;
    activity::Paused* pause();

    void become(MachineEvent event, Activity next, CoordinatorOutputs& out);
    /// The motion in progress comes to rest. Intents of less priority change nothing.
    void bring_to_rest(Intent intent, CoordinatorOutputs& out);
    void abort(const MachineFault& fault, CoordinatorOutputs& out);

private:
    void note(MachineEvent event, MachinePhase from, CoordinatorOutputs& out);

    Activity activity_;
};

/// Motors make up lost steps before a job goes on.
inline bool is_correcting(const MachineActivity& activity) {
    return activity.is<activity::OwnMoves>() && activity.pause() != nullptr;
}

}  // namespace lockstep
