// A mapped part of a memory file, shared with all processes that map it. The destructor unmaps it.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <utility>

namespace lockstep {

class SharedMapping {
public:
    /// `file` is a descriptor, which may be closed afterwards. `protection` and `flags` are those of mmap. `offset` is
    /// a multiple of the page size.
    SharedMapping(int file, std::size_t bytes, int protection, int flags = 0, std::size_t offset = 0) : bytes_(bytes) {
        void* const at = mmap(nullptr, bytes, protection, MAP_SHARED | flags, file, static_cast<off_t>(offset));
        words_ = at == MAP_FAILED ? nullptr : static_cast<std::uint64_t*>(at);
    }
    SharedMapping(SharedMapping&& other) noexcept
        : words_(std::exchange(other.words_, nullptr)), bytes_(std::exchange(other.bytes_, 0)) {}
    SharedMapping& operator=(SharedMapping&&) = delete;
    ~SharedMapping() {
        if (words_ != nullptr) { munmap(words_, bytes_); }
    }

    /// Null if mapping failed; the constructor left the reason in errno.
    std::uint64_t* words() const { return words_; }
    std::size_t bytes() const { return bytes_; }

private:
    std::uint64_t* words_;
    std::size_t bytes_;
};

}  // namespace lockstep
