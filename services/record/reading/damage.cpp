#include "services/record/reading/damage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/number_text.hpp"

namespace lockstep::analysis {
namespace {

std::string reason_of(LogDamage::Kind kind) {
    switch (kind) {
        case LogDamage::Kind::CutOff: return "the log ends within an event";
        case LogDamage::Kind::NoEvent: return "bytes that are not an event";
        case LogDamage::Kind::WrongLength: return "an event whose length is wrong";
    }
    return "";
}

}  // namespace

void note_damage(std::vector<Damage>& all, LogPlace place, std::string what) {
    auto known = std::ranges::find(all, what, &Damage::what);
    if (known == all.end() && all.size() == kDamagesKept) { known = all.end() - 1; }
    if (known == all.end()) {
        if (all.size() + 1 == kDamagesKept) { what = "further reasons"; }
        all.push_back({.first_byte = place.offset, .what = std::move(what)});
        known = all.end() - 1;
    }
    known->first_byte = std::min(known->first_byte, place.offset);
    known->last_byte = std::max(known->last_byte, place.offset + std::max<std::uint64_t>(1, place.bytes) - 1);
    known->bytes += place.bytes;
    ++known->places;
}

void report_damages(const LogReader& reader, const std::function<void(LogPlace, std::string)>& on_damage) {
    std::uint64_t bytes = 0;
    for (const LogDamage& damage : reader.damages()) {
        on_damage({damage.offset, damage.bytes}, reason_of(damage.kind));
        bytes += damage.bytes;
    }
    if (reader.damaged_stretches() == reader.damages().size()) { return; }
    const std::uint64_t more = reader.damaged_stretches() - reader.damages().size();
    on_damage({reader.damages().back().offset, reader.damaged_bytes() - bytes},
              fmt::format("{} more damaged places after these", more));
}

std::string damage_sentence(const Damage& damage) {
    const auto bytes = plural(static_cast<std::int64_t>(damage.bytes), "byte");
    if (damage.places == 1) { return fmt::format("damaged at byte {}: {}, {}", damage.first_byte, damage.what, bytes); }
    return fmt::format("damaged in {} places from byte {} to {}: {}, {}", damage.places, damage.first_byte,
                       damage.last_byte, damage.what, bytes);
}

}  // namespace lockstep::analysis
