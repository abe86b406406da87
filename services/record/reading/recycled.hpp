// Vectors that are used again: to allocate and to clear the memory of a message costs as much as to fill it.
#pragma once

#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

namespace lockstep::analysis {

/// Any thread may take and give.
template <typename Element>
class Recycled {
public:
    static constexpr std::size_t kMostKept = 1024;      // vectors
    static constexpr std::size_t kMostElements = 4096;  // of a vector that is kept

    /// A vector of this size. Its elements have any values.
    static std::vector<Element> take(std::size_t size) {
        std::vector<Element> vector;
        {
            const std::scoped_lock lock(kept().mutex);
            if (!kept().vectors.empty()) {
                vector = std::move(kept().vectors.back());
                kept().vectors.pop_back();
            }
        }
        vector.resize(size);
        return vector;
    }
    /// Keeps a vector that is no longer used.
    static void give(std::vector<Element> vector) {
        if (vector.capacity() == 0 || vector.capacity() > kMostElements) { return; }
        const std::scoped_lock lock(kept().mutex);
        if (kept().vectors.size() < kMostKept) { kept().vectors.push_back(std::move(vector)); }
    }

private:
    struct Kept {
        std::mutex mutex;
        std::vector<std::vector<Element>> vectors;
    };
    static Kept& kept() {
        static Kept all;
        return all;
    }
};

}  // namespace lockstep::analysis
