// How a process that runs for months uses its heap.
#pragma once

namespace lockstep {

/// From now on a block of 128 KiB or more is mapped by itself, and the system has its memory again as soon as it is
/// freed. By default glibc maps no more blocks of a size that was freed once: later ones lie between small ones in the
/// heap, and what is freed there stays with the process. Locked memory (real_time.hpp) has no mapped blocks.
void give_back_large_blocks();

}  // namespace lockstep
