#include "services/record/sinks.hpp"

#include "services/record/own_log.hpp"
#include "services/runtime/log.hpp"

namespace lockstep {

std::unique_ptr<RecordSink> open_record(const MachineSetup& machine, const std::string& axis, bool published) {
    std::vector<std::unique_ptr<RecordSink>> sinks;
    if (published) {
        auto publisher = LcmPublisher::open(machine.network);
        if (publisher) {
            sinks.push_back(std::make_unique<LcmSink>(std::move(*publisher), watch_route(machine.network)));
        } else {
            log_warning("the record is not published: " + publisher.error());
        }
    }
    if (machine.record.own_logs) {
        auto log = open_own_log(machine, axis);
        if (log) {
            sinks.push_back(std::move(*log));
        } else {
            log_warning("this process writes no log of its own: " + log.error());
        }
    }
    return std::make_unique<AllSinks>(std::move(sinks));
}

}  // namespace lockstep
