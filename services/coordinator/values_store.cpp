#include "services/coordinator/values_store.hpp"

#include <utility>

namespace lockstep {

std::expected<void, std::string> ValuesStore::accept(std::uint64_t id, const ProgramDocument& document,
                                                     ValueKeeper::Circumstances now) {
    if (!document.values) { return {}; }
    return keeper_.accept(id, *document.values, now);
}

void ValuesStore::follow(const MachineValues& values) {
    if (values.revision == keeper_.revision()) { return; }
    if (auto read = values_from_bytes(values.bytes)) { keeper_.follow(values.revision, std::move(read->values)); }
}

void ValuesStore::write(std::chrono::nanoseconds now) {
    const std::uint64_t revision = keeper_.revision();
    const bool is_tried = revision == written_ && now - written_at_ < kWriteAgainAfter;
    if (revision == kept() || is_tried) { return; }
    written_ = revision;
    written_at_ = now;
    file_.keep(revision, [values = RevisedValues{revision, keeper_.values()}] { return values_text(values); });
}

std::optional<MachineValues> ValuesStore::step(std::chrono::nanoseconds now, const Term& term) {
    write(now);
    const bool is_news = std::exchange(published_kept_, kept()) != kept();
    const bool is_due = !published_at_ || now - *published_at_ >= kPublishEvery;
    if (!is_news && !is_due) { return std::nullopt; }
    published_at_ = now;
    const RevisedValues values{keeper_.revision(), keeper_.values()};
    return MachineValues{.term = term, .revision = values.revision, .kept = kept(), .bytes = values_bytes(values)};
}

}  // namespace lockstep
