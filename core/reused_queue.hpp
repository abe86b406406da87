// A queue that keeps removed elements and their allocated memory for reuse. Once it has reached its greatest size it
// allocates nothing. An element keeps its address while others are added and removed.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/check.hpp"

namespace lockstep {

template <typename T>
class ReusedQueue {
public:
    ReusedQueue() = default;
    ReusedQueue(const ReusedQueue& other) { *this = other; }
    ReusedQueue& operator=(const ReusedQueue& other) {
        if (this == &other) { return *this; }
        clear();
        for (std::size_t i = 0; i < other.size(); ++i) { push_back(other[i]); }
        return *this;
    }
    ReusedQueue(ReusedQueue&& other) noexcept
        : items_(std::move(other.items_)),
          first_(std::exchange(other.first_, 0)),
          size_(std::exchange(other.size_, 0)) {}
    ReusedQueue& operator=(ReusedQueue&& other) noexcept {
        items_ = std::move(other.items_);
        first_ = std::exchange(other.first_, 0);
        size_ = std::exchange(other.size_, 0);
        return *this;
    }
    ~ReusedQueue() = default;

    /// Adds a copy as the last element.
    T& push_back(const T& value) { return next() = value; }
    /// Adds what `make(old)` returns as the last element. `old` is an earlier element, whose memory it may take.
    template <typename Make>
    T& renew_back(Make&& make) {
        T& place = next();
        return place = make(std::move(place));
    }
    /// Adds what `make()` returns as the last element, made in its place. For types that allocate no memory.
    template <typename Make>
    T& make_back(Make&& make) {
        static_assert(std::is_trivially_destructible_v<T>);
        return *::new (static_cast<void*>(&next())) T(make());
    }
    void pop_front() {
        check(!empty(), "an element that is removed is there");
        first_ = place(1);
        --size_;
    }
    void pop_back() {
        check(!empty(), "an element that is removed is there");
        --size_;
    }
    void clear() { first_ = size_ = 0; }

    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    T& operator[](std::size_t i) {
        check(i < size_, "an index is below the size");
        return *items_[place(i)];
    }
    const T& operator[](std::size_t i) const {
        check(i < size_, "an index is below the size");
        return *items_[place(i)];
    }
    T& front() { return (*this)[0]; }
    const T& front() const { return (*this)[0]; }
    T& back() { return (*this)[size_ - 1]; }
    const T& back() const { return (*this)[size_ - 1]; }

private:
    T& next() {
        if (size_ == items_.size()) { grow(); }
        return *items_[place(size_++)];
    }
    std::size_t place(std::size_t i) const {
        const std::size_t behind = first_ + i;
        return behind < items_.size() ? behind : behind - items_.size();
    }
    /// Adds one unused element behind the last one in the ring.
    void grow() {
        if (first_ == 0) { return items_.push_back(std::make_unique<T>()); }
        items_.insert(items_.begin() + static_cast<std::ptrdiff_t>(first_), std::make_unique<T>());
        ++first_;
    }

    std::vector<std::unique_ptr<T>> items_;  // a ring
    std::size_t first_ = 0;
    std::size_t size_ = 0;  // number of elements in use
};

}  // namespace lockstep
