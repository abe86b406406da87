#include "services/runtime/heap.hpp"

#include <malloc.h>

namespace lockstep {

void give_back_large_blocks() {
    constexpr int kLargeBlock_bytes = 128 << 10;  // glibc's initial value
    mallopt(M_MMAP_THRESHOLD, kLargeBlock_bytes);
}

}  // namespace lockstep
