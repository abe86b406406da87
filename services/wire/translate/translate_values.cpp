#include "services/wire/translate/checks.hpp"
#include "services/wire/translate/translate.hpp"

namespace lockstep {

lockstep_wire_MachineValues to_wire(const MachineValues& values) {
    const auto size = static_cast<std::uint32_t>(values.bytes.size());
    return {.term = values.term.number,
            .coordinator = values.term.coordinator,
            .revision = values.revision,
            .on_disk = values.on_disk,
            .bytes = {._maximum = size,
                      ._length = size,
                      ._buffer = const_cast<std::uint8_t*>(values.bytes.data()),  // DDS only reads it
                      ._release = false}};
}

FromWire<MachineValues> from_wire(const lockstep_wire_MachineValues& wire) {
    Checks check("machine values");
    check.within<std::size_t>("the number of bytes", wire.bytes._length, 0, kMaxValuesBytes);
    if (!check.passed()) { return std::unexpected(check.refusal()); }
    return MachineValues{.term = {wire.term, wire.coordinator},
                         .revision = wire.revision,
                         .on_disk = wire.on_disk,
                         .bytes = {wire.bytes._buffer, wire.bytes._buffer + wire.bytes._length}};
}

}  // namespace lockstep
