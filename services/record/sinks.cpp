#include "services/record/sinks.hpp"

#include "services/runtime/log.hpp"

namespace lockstep {

std::unique_ptr<RecordSink> open_record(const NetworkConfig& network, bool wanted) {
    if (!wanted) { return std::make_unique<NoSink>(); }
    auto publisher = LcmPublisher::open(network);
    if (publisher) { return std::make_unique<LcmSink>(std::move(*publisher)); }
    log_warning("nothing is recorded: " + publisher.error());
    return std::make_unique<NoSink>();
}

}  // namespace lockstep
