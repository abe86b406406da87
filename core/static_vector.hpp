// A vector with a named capacity, stored in place: the code that decides motion allocates nothing for it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>

#include "core/check.hpp"

namespace lockstep {

template <typename T, std::size_t Capacity>
class StaticVector {
public:
    StaticVector() = default;
    StaticVector(std::initializer_list<T> values) {
        for (const T& value : values) { append(value); }
    }
    /// Copies only the values in use, so unused capacity costs nothing.
    StaticVector(const StaticVector& other) : size_(other.size_) { std::copy_n(other.begin(), size_, begin()); }
    StaticVector& operator=(const StaticVector& other) {
        if (this == &other) { return *this; }
        size_ = other.size_;
        std::copy_n(other.begin(), size_, begin());
        return *this;
    }
    ~StaticVector() = default;

    static constexpr std::size_t capacity() { return Capacity; }
    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    bool full() const { return size_ == Capacity; }
    void clear() { size_ = 0; }

    /// Returns false and changes nothing if the vector is full.
    [[nodiscard]] bool push_back(const T& value) {
        if (full()) { return false; }
        items_[size_++] = value;
        return true;
    }

    /// For code that cannot exceed the capacity. If it does, the check ends the process.
    void append(const T& value) { check(push_back(value), "a bounded vector has room for what is appended"); }

    void pop_back() {
        check(!empty(), "the last value of a vector exists");
        --size_;
    }
    /// Removes the first `count` values and moves the others to the front.
    void erase_front(std::size_t count) {
        check(count <= size_, "a vector holds the values that are removed");
        std::move(begin() + count, end(), begin());
        size_ -= count;
    }

    T& operator[](std::size_t i) {
        check(i < size_, "an index is below its vector's size");
        return items_[i];
    }
    const T& operator[](std::size_t i) const {
        check(i < size_, "an index is below its vector's size");
        return items_[i];
    }
    T& back() { return (*this)[size_ - 1]; }
    const T& back() const { return (*this)[size_ - 1]; }
    const T& front() const { return (*this)[0]; }
    T* begin() { return items_.data(); }
    T* end() { return items_.data() + size_; }
    const T* begin() const { return items_.data(); }
    const T* end() const { return items_.data() + size_; }

    bool operator==(const StaticVector& other) const { return std::ranges::equal(*this, other); }

private:
    std::array<T, Capacity> items_;
    std::size_t size_ = 0;
};

}  // namespace lockstep
