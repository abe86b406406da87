// The content of a log written by lcm-logger or by the simulator, for each axis and each job.
//
// The log is read once, in memory that does not grow with its length. Damaged or missing messages are reported, and the
// rest is read.
#pragma once

#include <algorithm>
#include <cstdint>
#include <expected>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "clients/analysis/axis_log.hpp"
#include "clients/analysis/channels/channel_log.hpp"
#include "clients/analysis/event_log.hpp"
#include "clients/analysis/measure/skew.hpp"
#include "clients/analysis/motors/axis_meter.hpp"
#include "clients/analysis/motors/motor_skew.hpp"
#include "clients/analysis/moves/job_moves.hpp"
#include "clients/analysis/power/power_map.hpp"
#include "clients/drawing/svg.hpp"
#include "clients/verification/findings.hpp"
#include "core/kinematics/kinematics.hpp"
#include "core/machine.hpp"
#include "core/program.hpp"
#include "services/record/reading/damage.hpp"
#include "services/record/reading/program_events.hpp"
#include "services/record/reading/record_end.hpp"

namespace lockstep::analysis {

/// A job as the coordinator recorded it. Times are microseconds of machine time.
struct JobLog {
    std::int64_t coordinator = 0;
    std::uint64_t job = 0;
    std::string kind;     // home, move, run, own-move, jog, return
    std::string outcome;  // done, stopped, failed; empty: the log ends before the job does
    std::optional<std::int64_t> begun_us;
    std::optional<std::int64_t> ended_us;
    std::optional<std::size_t> is_in_pause_of;  // place in Analysis::jobs of the job in whose pause it takes place
    std::string name;                           // of the program; empty for homing
    std::int64_t epochs = 0;                    // motions from rest to rest that its axes ran together
    std::int64_t legs = 0;                   // motions from rest to rest as planned; further epochs are interruptions
    std::optional<std::string> unplannable;  // why the commanded motion is not known
    std::int64_t move_count = 0;
    std::int64_t dwells = 0;       // of move_count
    std::vector<MoveLog> moves;    // the first ones, as many as are kept
    std::optional<Ticks> planned;  // as programmed
    bool is_touched = false;       // it ended at the touch of a probe
    bool overridden = false;       // it ran with feeds or rapids other than programmed
    std::int64_t asked_steps = 0;  // of all motors in all moves, kept or not
    std::int64_t made_steps = 0;
    std::int64_t unasked_steps = 0;  // that belong to no move
    std::int64_t moves_not_whole = 0;
    std::optional<double> largest_distance_mm;  // from the commanded line, if known
    std::int64_t moves_without_distance = 0;    // because steps are missing from the log or come too late in it
    std::vector<std::string> axes_not_known;    // the log lacks steps of these motors
    TickHistogram late;                         // of its steps

    bool is_on_a_line() const { return kind != "own-move" && kind != "jog"; }  // its axes move together
    /// 0 if its plan is not known.
    std::int64_t interruptions() const { return planned ? std::max<std::int64_t>(0, epochs - legs) : 0; }
    bool is_whole() const { return moves_not_whole == 0 && unasked_steps == 0; }
};

/// Whether the program commands no motion there, but a pause.
bool is_dwell(const MoveLog& move);

struct Analysis {
    static constexpr std::size_t kJobsKept = 10'000;
    static constexpr std::size_t kMovesKept = 5000;           // of all jobs
    static constexpr std::size_t kAskedPointsKept = 200'000;  // of all jobs' paths

    static constexpr Int128 kEnd = Int128{1} << 60;

    std::filesystem::path log;
    std::string machine;
    verification::Findings verified;               // the comparison of all steps with their frames and programs
    std::optional<MachineConfig> config;           // of the last job that has one
    std::shared_ptr<const Kinematics> kinematics;  // of config; null without it
    std::vector<std::unique_ptr<AxisLog>> axes;    // of the motors, in the configuration's order; by name without one
    std::vector<AxisFigures> axis_figures;         // unless the motors are the axes
    std::vector<MotorSkew> motor_skew;             // of axes with several motors, in all jobs
    std::vector<JobLog> jobs;                      // in the order they began, the first kJobsKept
    std::uint64_t jobs_not_kept = 0;
    std::int64_t missing_job_events = 0;           // between the first and the last event of each coordinator
    RecordEnd end;                                 // messages missing after the last ones in the log
    std::uint64_t events = 0;                      // read, of every kind
    std::map<std::string, std::uint64_t> foreign;  // events of other channels and machines, by name
    std::int64_t steps_of_no_job = 0;              // made before any job begins in the log
    std::uint64_t runs = 0;                        // frames and tails begun, as recorded for verification
    std::vector<Damage> damages;                   // by reason; the last of kDamagesKept collects all further reasons
    std::vector<Event> happened;                   // in the order of time
    std::uint64_t events_not_kept = 0;
    std::vector<HappenedEvent> program_events;  // the first of the log, in the order of time
    std::uint64_t program_events_not_kept = 0;
    std::vector<ChannelChange> channel_changes;  // of inputs and outputs, the first of the log, in the order of time
    std::uint64_t channel_changes_not_kept = 0;
    std::vector<ChannelCourse> channel_courses;              // of each input and output that changed, by motors
    std::vector<PowerMap> power_maps;                        // of analog outputs with power, with axes X and Y
    double tolerance_mm = 0;                                 // of joined moves, the greatest of any program
    std::vector<PairSkew> step_skew;                         // between motors that ran frames together
    std::optional<double> largest_distance_mm;               // of any step from the commanded line, all axes together
    std::vector<std::vector<drawing::Point>> asked_ways_mm;  // X-Y, of each program that differs from the previous one
    std::vector<std::vector<drawing::Point>> stepped_ways;   // X-Y, steps as in MoveMeter::plane

    std::int64_t tick_ns() const { return config ? config->tick_ns : MachineConfig{}.tick_ns; }
    /// Each axis is moved by a motor of its own, as far as is known: then a motor is called an axis.
    bool has_motors_as_axes() const { return kinematics == nullptr || kinematics->is_direct(); }
    std::span<const MotorConfig> motors() const;
    /// Null if the configuration is not known, or lacks the motor.
    const MotorConfig* motor_config(const std::string& name) const;
    /// A device without a motor.
    bool is_board(const std::string& name) const;
    /// Null if the configuration is not known, or lacks the axis.
    const AxisConfig* axis_config(const std::string& name) const;
    /// "axis X", "motor Y2"
    std::string label_of(const std::string& motor) const;
    /// mm or deg.
    std::string_view unit_of(const std::string& motor) const;
    /// From the configuration, else from the axis's own messages; nullopt if neither contains it.
    std::optional<double> steps_per_mm(const AxisLog& axis) const;
    /// Whether the log has the frames of steps, as logs of all but early versions have.
    bool is_verified() const { return runs > 0; }
    bool is_exact() const { return is_verified() && verified.verdict() == verification::Verdict::Exact; }
    /// Configured motors without any message in the log.
    std::vector<std::string> absent_axes() const;
    /// The first and the last step of any motor; nullopt without steps.
    std::optional<Tick> first_tick() const;
    std::optional<Tick> last_tick() const;
    double seconds(Ticks ticks) const {
        return static_cast<double>(ticks.value) * static_cast<double>(tick_ns()) * 1e-9;
    }
    /// Converts microseconds of machine time to ticks, and back. The result is limited to +-kEnd, so any number is
    /// valid.
    Tick tick_at(std::int64_t microseconds) const {
        return {static_cast<std::int64_t>(std::clamp(Int128{microseconds} * 1000 / tick_ns(), -kEnd, kEnd))};
    }
    std::int64_t microseconds_at(Tick tick) const {
        return static_cast<std::int64_t>(std::clamp(Int128{tick.value} * tick_ns() / 1000, -kEnd, kEnd));
    }
    double microseconds(Ticks ticks) const { return seconds(ticks) * 1e6; }
    /// Seconds after the log's first step.
    double seconds_at(Tick tick) const { return seconds(tick - first_tick().value_or(tick)); }
};

struct AnalysisOptions {
    std::optional<std::filesystem::path> csv_dir;  // created if missing
    std::optional<std::filesystem::path> svg_dir;
    bool curves = true;                    // whether to keep them, for the report page; pictures always have them
    std::optional<std::string> machine;    // the machine to analyze if the log has several; else the first one
    std::function<void(double)> progress;  // called with 0 ... 1 from time to time

    bool keeps_curves() const { return curves || svg_dir; }
};

/// The error is a sentence for the user. The log is missing, a directory, empty or not a log, or a file or directory
/// cannot be written.
std::expected<Analysis, std::string> analyze_log(const std::filesystem::path& log, const AnalysisOptions& options = {});

}  // namespace lockstep::analysis
