// The sorted content of a log: all messages of the analyzed machine, with each axis's steps in order and measured.
// Every evaluation of several axes or of jobs uses it.
#pragma once

#include <cstddef>
#include <lockstep/axis_position_t.hpp>
#include <lockstep/channel_event_t.hpp>
#include <lockstep/program_event_t.hpp>
#include <string>

#include "clients/analysis/measure/lateness.hpp"
#include "clients/analysis/measure/measured_step.hpp"
#include "core/program.hpp"
#include "services/record/reading/damage.hpp"
#include "services/record/reading/program_parts.hpp"
#include "services/record/reading/run.hpp"

namespace lockstep::analysis {

/// Called in the order of the log. A lane is the number of an axis, from 0.
class SortedListener : public MeasuredListener {
public:
    /// Announces the next lane, before its first message.
    virtual void on_axis(const std::string& name) = 0;
    virtual void on_position(const axis_position_t& message) = 0;
    virtual void on_run(std::size_t lane, const Run& run) = 0;
    virtual void on_job(const RecordedJob& message, LogPlace place) = 0;
    /// `event`: the decoded content of the message.
    virtual void on_event(const program_event_t& message, const ProgramEvent& event) = 0;
    virtual void on_channel(const channel_event_t& message) = 0;
    /// A part of the log that cannot be read or decoded.
    virtual void on_damage(LogPlace place, const std::string& what) = 0;
    /// The lateness of the steps of a run. LateMeter sends it and passes on everything else.
    virtual void on_late(const std::string& /*axis*/, const SharedLate& /*steps*/) {}
};

}  // namespace lockstep::analysis
