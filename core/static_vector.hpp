// A vector that lives where it stands and has a named bound: nothing is allocated where motion is decided.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>

namespace lockstep {

template <typename T, std::size_t Capacity>
class StaticVector {
public:
    StaticVector() = default;
    StaticVector(std::initializer_list<T> values) {
        for (const T& value : values) { (void)push_back(value); }
    }
    /// What is beyond the size is not copied: room costs nothing where it is not used.
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

    /// False, and nothing changed, when full.
    [[nodiscard]] bool push_back(const T& value) {
        if (full()) { return false; }
        items_[size_++] = value;
        return true;
    }

    void pop_back() { --size_; }
    /// The first so many; the others move up.
    void erase_front(std::size_t count) {
        std::move(begin() + count, end(), begin());
        size_ -= count;
    }

    T& operator[](std::size_t i) { return items_[i]; }
    const T& operator[](std::size_t i) const { return items_[i]; }
    T& back() { return items_[size_ - 1]; }
    const T& back() const { return items_[size_ - 1]; }
    const T& front() const { return items_[0]; }
    T* begin() { return items_.data(); }
    T* end() { return items_.data() + size_; }
    const T* begin() const { return items_.data(); }
    const T* end() const { return items_.data() + size_; }

    bool operator==(const StaticVector& other) const {
        if (size_ != other.size_) { return false; }
        for (std::size_t i = 0; i < size_; ++i) {
            if (!(items_[i] == other.items_[i])) { return false; }
        }
        return true;
    }

private:
    std::array<T, Capacity> items_;
    std::size_t size_ = 0;
};

}  // namespace lockstep
