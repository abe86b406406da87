#include "clients/verification/jobs/record_order.hpp"

#include <algorithm>

namespace lockstep::verification {

void RecordOrder::add(OrderedRecord record) {
    auto behind = records_.end();
    if (!record.is_of_event && is_late(record)) {
        const auto own = std::ranges::find(records_, record.coordinator, &OrderedRecord::coordinator);
        behind = std::find_if(own == behind ? records_.begin() : own, behind, [&](const OrderedRecord& r) {
            return r.event == "begun" && r.coordinator != record.coordinator;
        });
    }
    if (record.event == "begun") { begun_.emplace_back(record.coordinator, record.job); }
    if (begun_.size() > kJobsKept) { begun_.pop_front(); }
    records_.insert(behind, std::move(record));
}

OrderedRecord RecordOrder::take() {
    OrderedRecord first = std::move(records_.front());
    records_.pop_front();
    return first;
}

std::optional<std::size_t> RecordOrder::up_to_epoch(Epoch epoch) const {
    const auto found = std::ranges::find_if(records_, [epoch](const OrderedRecord& record) {
        return record.event == "epoch" && static_cast<Epoch>(record.epoch) == epoch;
    });
    if (found == records_.end()) { return std::nullopt; }
    return static_cast<std::size_t>(found - records_.begin()) + 1;
}

bool RecordOrder::is_late(const RecordedJob& record) const {
    const auto its = std::ranges::find(begun_, std::pair{record.coordinator, record.job});
    return record.event != "begun" && its != begun_.end() && begun_.back().first != record.coordinator;
}

}  // namespace lockstep::verification
