#include "clients/analysis/stages/stage_thread.hpp"

namespace lockstep::analysis {

void StageThread::on_axis(const std::string& name) {
    work_.add([this, name] { listener_.on_axis(name); });
}

void StageThread::on_measured(std::size_t lane, const SharedSteps& steps) {
    work_.add([this, lane, steps] { listener_.on_measured(lane, steps); });
}

void StageThread::on_position(const axis_position_t& message) {
    work_.add([this, message] { listener_.on_position(message); });
}

void StageThread::on_run(std::size_t lane, const Run& run) {
    work_.add([this, lane, run] { listener_.on_run(lane, run); });
}

void StageThread::on_job(const RecordedJob& message, LogPlace place) {
    work_.add([this, message, place] { listener_.on_job(message, place); });
}

void StageThread::on_event(const program_event_t& message, const ProgramEvent& event) {
    work_.add([this, message, event] { listener_.on_event(message, event); });
}

void StageThread::on_channel(const channel_event_t& message) {
    work_.add([this, message] { listener_.on_channel(message); });
}

void StageThread::on_damage(LogPlace place, const std::string& what) {
    work_.add([this, place, what] { listener_.on_damage(place, what); });
}

void StageThread::on_late(const std::string& axis, const SharedLate& steps) {
    work_.add([this, axis, steps] { listener_.on_late(axis, steps); });
}

}  // namespace lockstep::analysis
