#include "clients/session/received/received_values.hpp"

namespace lockstep {

void ReceivedValues::take(MachineValues&& values, std::chrono::nanoseconds now) {
    const bool is_older = values_ && values.term < values_->term;
    if (is_older) { return; }
    values_ = std::move(values);
    unsaved_since_ = values_->on_disk ? std::nullopt : std::optional(unsaved_since_.value_or(now));
}

std::optional<RevisedValues> ReceivedValues::newest() const {
    if (!values_) { return std::nullopt; }
    auto values = read();
    return values ? std::optional(*std::move(values)) : std::nullopt;
}

}  // namespace lockstep
