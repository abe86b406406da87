// The steps of a stretch by roots (walk_roots.hpp), as many at a time as the processor's vectors hold. Compiled for
// several instruction sets; the best that the processor has is chosen when the program runs.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/step/stretch.hpp"

namespace lockstep {

/// Writes the ticks of the steps of a stretch, packed as EdgeBuffer has them. `steps` is how many there are. Vectors
/// are written whole: up to EdgeBuffer::kSlack words from the last step on may be scribbled on.
void vector_walk(const Stretch& stretch, std::size_t steps, Tick start, std::int64_t* out);

}  // namespace lockstep
