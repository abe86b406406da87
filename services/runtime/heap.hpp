// The heap of a process that runs for months.
#pragma once

namespace lockstep {

/// From now on a block of 128 KiB or more is mapped by itself, and freeing it returns its memory to the system. By
/// default glibc maps no more blocks of a size that was freed once: later blocks lie between small ones in the heap,
/// and their memory stays with the process. Locked memory (real_time.hpp) has no mapped blocks.
void give_back_large_blocks();

}  // namespace lockstep
