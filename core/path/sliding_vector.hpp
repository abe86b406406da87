// A vector that grows at its end and shrinks at its front, for a window over a stream. It reuses memory.
#pragma once

#include <cstddef>
#include <vector>

namespace lockstep {

template <typename T>
class SlidingVector {
public:
    std::size_t size() const { return items_.size() - first_; }
    bool empty() const { return size() == 0; }
    T& operator[](std::size_t i) { return items_[first_ + i]; }
    const T& operator[](std::size_t i) const { return items_[first_ + i]; }
    T& front() { return items_[first_]; }
    const T& front() const { return items_[first_]; }
    T& back() { return items_.back(); }
    const T& back() const { return items_.back(); }
    void push_back(const T& value) { items_.push_back(value); }
    void pop_back() { items_.pop_back(); }
    void pop_front() { drop_front(1); }
    void insert(std::size_t at, const T& value) { items_.insert(items_.begin() + place(at), value); }
    /// Drops all elements behind the first `size`.
    void truncate(std::size_t size) { items_.erase(items_.begin() + place(size), items_.end()); }

    /// Moves the remaining elements only when half of the memory is unused: amortized constant work for each element.
    void drop_front(std::size_t count) {
        first_ += count;
        if (2 * first_ < items_.size()) { return; }
        items_.erase(items_.begin(), items_.begin() + static_cast<std::ptrdiff_t>(first_));
        first_ = 0;
    }
    void clear() {
        items_.clear();
        first_ = 0;
    }
    const T* begin() const { return items_.data() + first_; }
    const T* end() const { return items_.data() + items_.size(); }

private:
    std::ptrdiff_t place(std::size_t i) const { return static_cast<std::ptrdiff_t>(first_ + i); }

    std::vector<T> items_;
    std::size_t first_ = 0;
};

}  // namespace lockstep
