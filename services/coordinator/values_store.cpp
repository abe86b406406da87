#include "services/coordinator/values_store.hpp"

#include <utility>

namespace lockstep {

std::expected<void, ValuesRefusal> ValuesStore::accept(const ProgramChunk& chunk, const ProgramDocument& part,
                                                       ValueKeeper::Circumstances now) {
    if (!part.values) { return {}; }
    if (chunk.index == 0) { return keeper_.accept(chunk.program, *part.values, now); }
    if (part.values->after) { keeper_.note_left(chunk.program, *part.values->after); }
    return {};
}

void ValuesStore::follow(const MachineValues& values) {
    if (values.bytes == followed_) { return; }
    followed_ = values.bytes;
    if (auto read = values_from_bytes(values.bytes)) { keeper_.follow(values.revision, std::move(read->values)); }
}

void ValuesStore::write(std::chrono::nanoseconds now) {
    const std::uint64_t change = keeper_.changes();
    const bool is_tried = change == written_ && now - written_at_ < kWriteAgainAfter;
    if (is_on_disk() || is_tried) { return; }
    written_ = change;
    written_at_ = now;
    file_.keep(change, {keeper_.revision(), keeper_.values()});
}

const MachineValues* ValuesStore::step(std::chrono::nanoseconds now, const Term& term) {
    write(now);
    const std::pair state{keeper_.changes(), is_on_disk()};
    const bool is_news = std::exchange(published_, state) != state;
    const bool is_due = !published_at_ || now - *published_at_ >= kPublishEvery;
    if (!is_news && !is_due) { return nullptr; }
    if (is_news || !published_at_) { message_.bytes = values_bytes({keeper_.revision(), keeper_.values()}); }
    published_at_ = now;
    message_.term = term;
    message_.revision = keeper_.revision();
    message_.on_disk = state.second;
    return &message_;
}

}  // namespace lockstep
