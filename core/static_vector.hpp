// A vector with a named capacity, stored in place: the code that decides motion allocates nothing for it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <initializer_list>
#include <type_traits>

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
    StaticVector(const StaticVector& other) : size_(other.size_) { copy(other); }
    StaticVector& operator=(const StaticVector& other) {
        if (this == &other) { return *this; }
        size_ = other.size_;
        copy(other);
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
    /// Most vectors are short. Blocks of a fixed size are copied without a call, a part of which may be unused.
    void copy(const StaticVector& other) {
        constexpr std::size_t kBlock = 64;
        if constexpr (std::is_trivially_copyable_v<T> && sizeof(std::array<T, Capacity>) % kBlock == 0) {
            auto* const to = reinterpret_cast<std::byte*>(items_.data());
            const auto* const from = reinterpret_cast<const std::byte*>(other.items_.data());
            for (std::size_t at = 0; at < size_ * sizeof(T); at += kBlock) { std::memcpy(to + at, from + at, kBlock); }
        } else {
            std::copy_n(other.begin(), size_, begin());
        }
    }

    std::array<T, Capacity> items_;
    std::size_t size_ = 0;
};

}  // namespace lockstep
