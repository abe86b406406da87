// The heap of a process that runs for months.
#pragma once

namespace lockstep {

/// From now on malloc maps each block of 128 KiB or more separately, and freeing it returns its memory to the system.
/// By default glibc stops mapping blocks of a size once one of them was freed. Later blocks of that size lie between
/// small ones in the heap, and the process keeps their memory. A process with locked memory (real_time.hpp) maps no
/// blocks.
void give_back_large_blocks();

}  // namespace lockstep
