// A vector that keeps its elements and their allocated memory when it is cleared. A loop that refills it allocates
// nothing once the vector has reached its greatest size.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <utility>
#include <vector>

#include "core/check.hpp"

namespace lockstep {

template <typename T>
class ReusedVector {
public:
    ReusedVector() = default;
    ReusedVector(std::initializer_list<T> values) : items_(values), size_(values.size()) {}
    ReusedVector(const ReusedVector& other) { *this = other; }
    ReusedVector& operator=(const ReusedVector& other) {
        if (this == &other) { return *this; }
        clear();
        for (const T& value : other) { push_back(value); }
        return *this;
    }
    ReusedVector(ReusedVector&& other) noexcept
        : items_(std::move(other.items_)), size_(std::exchange(other.size_, 0)) {}
    ReusedVector& operator=(ReusedVector&& other) noexcept {
        items_ = std::move(other.items_);
        size_ = std::exchange(other.size_, 0);
        return *this;
    }
    ~ReusedVector() = default;

    /// Adds a copy as the last element.
    T& push_back(const T& value) { return next() = value; }
    /// Adds what `make(old)` returns as the last element. `old` is an earlier element, whose memory it may take.
    template <typename Make>
    T& renew_back(Make&& make) {
        T& place = next();
        return place = make(std::move(place));
    }
    void clear() { size_ = 0; }

    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    T& operator[](std::size_t i) {
        check(i < size_, "an index is below the size");
        return items_.data()[i];
    }
    const T& operator[](std::size_t i) const {
        check(i < size_, "an index is below the size");
        return items_.data()[i];
    }
    T* begin() { return items_.data(); }
    T* end() { return items_.data() + size_; }
    const T* begin() const { return items_.data(); }
    const T* end() const { return items_.data() + size_; }

private:
    T& next() {
        if (items_.capacity() == 0) { items_.reserve(kLeastPlaces); }
        if (size_ == items_.size()) { items_.emplace_back(); }
        return items_[size_++];
    }

    static constexpr std::size_t kLeastPlaces = 8;  // more than most loops fill

    std::vector<T> items_;
    std::size_t size_ = 0;  // number of elements in use
};

}  // namespace lockstep
