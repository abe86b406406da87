#include "clients/session/measuring/measure_options.hpp"

#include "core/enumeration.hpp"

namespace lockstep {

std::string_view name_of(MeasureKind kind) {
    return pick_name({"edge", "angle", "corner", "bore", "boss", "tool", "surface"}, kind);
}

}  // namespace lockstep
